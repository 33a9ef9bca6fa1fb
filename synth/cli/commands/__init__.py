"""The subcommands: each reads, calls one function, and prints."""
