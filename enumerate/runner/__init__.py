"""The runner of every enumerator: units of work, worker processes, sinks and stores."""
