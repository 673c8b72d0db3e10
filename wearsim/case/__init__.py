"""The input file: schema, units, messages, defaults; a Case is complete when it exists."""
