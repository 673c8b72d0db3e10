"""Lubrication of a case: its keys, what they mean, how a lubricant ages and what a chain asks for."""
