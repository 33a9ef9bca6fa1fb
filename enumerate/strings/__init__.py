"""All R/- strings: chains of panels between two bodies."""
