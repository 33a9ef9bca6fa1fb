"""Four-bars: when they close, and their positions."""
