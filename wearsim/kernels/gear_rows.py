"""Rows of the columns of a gear pair's contact, and its constants."""

(
    ARC,
    MATE_ARC,
    CURVATURE,
    SLIP,
    SPEED,
    NORMAL_X,
    NORMAL_Y,
    MATE_DEPTH,
    SHARE,
    PLACE,
    NEXT_GAP,
    LAST_GAP,
    LEVER,
    NEXT_LEVER,
    LAST_LEVER,
) = range(15)
COLUMNS = 15

TORQUE, STIFFNESS, PITCH, LEAST_CURVATURE = range(4)
"""The torque and the stiffness of a pair of teeth are those per face width."""
