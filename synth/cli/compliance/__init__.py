"""Subcommands about members that bend or come to their limit: what a mechanism is then."""
