"""When to lubricate again, and which lubricant pays."""
