"""Rows of the columns of a gear pair's contact, and its constants."""

(
    ARC, MATE_ARC, CURVATURE, SLIP, SPEED, NORMAL_X, NORMAL_Y, MATE_DEPTH, SHARE, PLACE,
    NEXT_GAP, LAST_GAP,
) = range(12)  # fmt: skip
COLUMNS = 12

LINE_LOAD, STIFFNESS, BASE_PITCH, LEAST_CURVATURE = range(4)
