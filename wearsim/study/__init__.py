"""Many runs: what to do with a drive, and what a reading in service says about it."""
