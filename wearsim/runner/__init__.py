"""The one way in which studies run many cases: in threads, processes or on a cluster, to resume."""
