"""All kinematic chains."""
