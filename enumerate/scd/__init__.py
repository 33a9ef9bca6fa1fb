"""All SCD graphs."""
