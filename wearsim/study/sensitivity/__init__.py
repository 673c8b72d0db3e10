"""What of the input matters to a life."""
