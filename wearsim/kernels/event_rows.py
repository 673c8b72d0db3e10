"""Rows of the table of contact events that a mechanism hands to the wear engine."""

(
    EVENT_CENTRE_X,
    EVENT_CENTRE_Y,
    EVENT_NORMAL_X,
    EVENT_NORMAL_Y,
    EVENT_TOUCHED,
    EVENT_LOAD,
    EVENT_SLIP,
    EVENT_SPEED,
    EVENT_COUNT,
    EVENT_BODY,
) = range(10)
EVENT_ROWS = 10
