"""What was read in service: rows with dates, relubrications, readings of a chain and what they exclude."""
