"""Pages for a browser: one for each drive, and one that compares them."""
