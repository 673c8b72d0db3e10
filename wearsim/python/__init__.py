"""What the commands answer, as functions of Python with plain values, tables and pictures."""
