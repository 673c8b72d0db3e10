"""Types shared by the kernels; CONTACT is the seam between a mechanism and the wear loops."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Vector = NDArray[np.float64]


class Signature(str):
    """A type by numba's name; called with those of arguments, a function that returns it."""

    __slots__ = ("arguments", "result")
    arguments: "tuple[Signature, ...]"
    result: "Signature"

    def __call__(self, *arguments: "Signature") -> "Signature":
        """Return the type of a function."""
        made = Signature(f"{self}({', '.join(arguments)})")
        made.result, made.arguments = self, arguments
        return made


float64, int64, void = Signature("float64"), Signature("int64"), Signature("void")

VECTOR = Signature("float64[::1]")
TABLE = Signature("float64[:, ::1]")
CUBE = Signature("float64[:, :, ::1]")
_FUNCTION = Signature("FunctionType")

# x, y, normal_x, normal_y, curvature, depth, constants, columns
#   -> load_per_width, slip, sliding_speed, relative_curvature
# A mechanism may also overwrite the normals: they are the direction a point recedes in.
CONTACT = void(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, TABLE, VECTOR, VECTOR, VECTOR, VECTOR)
CONTACT_FUNCTION = _FUNCTION(CONTACT)

# contact, state of the path, constants, columns, modulus, law, diffusion, whether the ends bend,
# length of the step, work -> state after it, with the greatest error of a depth; work
STEP = float64(
    CONTACT_FUNCTION, TABLE, VECTOR, TABLE, float64, VECTOR, float64, int64, float64, TABLE, TABLE, TABLE
)
STEP_FUNCTION = _FUNCTION(STEP)

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
