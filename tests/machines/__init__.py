"""Other machines, as far as one machine can be them: `make test-machines`."""
