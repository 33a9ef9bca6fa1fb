"""A body guided through orientations: order, dyads, four-bars."""
