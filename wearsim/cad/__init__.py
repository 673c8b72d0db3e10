"""Wheels and gauges for CAD and on paper."""
