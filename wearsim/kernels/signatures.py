"""Types shared by the kernels; CONTACT is the seam between a mechanism and the wear loops."""

from typing import TYPE_CHECKING

from numba import float64, int64, types, void

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Vector = NDArray[np.float64]

VECTOR = float64[::1]
TABLE = float64[:, ::1]
CUBE = float64[:, :, ::1]

# x, y, normal_x, normal_y, curvature, depth, constants, columns
#   -> load_per_width, slip, sliding_speed, relative_curvature
# A mechanism may also overwrite the normals: they are the direction a point recedes in.
CONTACT = void(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, TABLE, VECTOR, VECTOR, VECTOR, VECTOR)
CONTACT_FUNCTION = types.FunctionType(CONTACT)

# contact, state of the path, constants, columns, modulus, law, diffusion, whether the ends bend,
# length of the step, work -> state after it, with the greatest error of a depth; work
STEP = float64(
    CONTACT_FUNCTION, TABLE, VECTOR, TABLE, float64, VECTOR, float64, int64, float64, TABLE, TABLE, TABLE
)
STEP_FUNCTION = types.FunctionType(STEP)

__all__ = [
    "CONTACT",
    "CONTACT_FUNCTION",
    "CUBE",
    "STEP",
    "STEP_FUNCTION",
    "TABLE",
    "VECTOR",
    "float64",
    "int64",
    "void",
]
