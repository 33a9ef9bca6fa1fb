"""All SC graphs."""
