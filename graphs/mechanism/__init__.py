"""What a mechanism is: SC and SCD graphs, polyhedron models, vertex-edge graphs, sheets."""
