"""Results made to be read: text, tables, pictures."""
