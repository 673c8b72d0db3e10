"""When to replace the chain, and what that costs."""
