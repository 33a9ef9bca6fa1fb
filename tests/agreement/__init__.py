"""All verbs agree about one mechanism at one configuration: `python -m tests.agreement --help`."""
