"""A roller chain around a sprocket."""
