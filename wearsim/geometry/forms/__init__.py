"""Forms of sprocket teeth."""
