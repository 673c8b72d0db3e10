"""Tables that come with wearsim; every number has its source beside it."""
