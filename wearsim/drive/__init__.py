"""A drive: its chain and all of its sprockets, what they live, and what is replaced when."""
