"""What is left of a life after a reading in service."""
