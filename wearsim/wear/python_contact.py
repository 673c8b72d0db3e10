"""A contact in Python, called by the machine code of the wear loops as if it were a kernel."""

import ctypes
from collections.abc import Callable
from functools import cached_property
from types import FunctionType
from typing import Any

import numpy as np

from wearsim.errors import WearsimError
from wearsim.jit.compiled import Kernel
from wearsim.jit.machine_code import MachineCode, parameters
from wearsim.jit.signatures import CONTACT

_KINDS: dict[str, Any] = {"d": ctypes.c_double, "i": ctypes.c_int64, "p": ctypes.c_void_p}

_VECTOR, _DATA, _SIZE = len("ppiipii"), 4, 5
"""Fields of an array of one dimension, and which of them are the address of its numbers and their count."""


class PythonContact(Kernel):
    """A function of Python with the arguments of a contact.

    Machine code knows no exceptions: an error of the function is kept in `failed`, and the slip becomes no
    number, so that a step is tried again shorter or the run ends.
    """

    def __init__(self, function: Callable[..., None]) -> None:
        super().__init__(function, CONTACT, quick=False)
        self.failed: BaseException | None = None

    def __call__(self, *arguments: Any) -> None:
        """Call the function, whose errors go to the caller."""
        self.function(*arguments)

    def handed_to(self, form: type) -> Any:
        """Return what a kernel in a form takes as its argument for this one."""
        if form is FunctionType:
            return self.function
        if form is not MachineCode:
            raise WearsimError(
                "a contact in Python must be called by machine code that wearsim keeps, but numba's own runs "
                "here (on Windows, or without the libraries of C): take a law of the catalogue"
            )
        return ctypes.cast(self._callback, ctypes.c_void_p).value

    @cached_property
    def _callback(self) -> Any:
        kinds = [_KINDS[kind] for kind in f"pp{parameters(CONTACT)}"]
        return ctypes.CFUNCTYPE(ctypes.c_int32, *kinds)(self._called)

    def _called(self, result: int, error: int, *fields: Any) -> int:
        arrays, place = [], 0
        for argument in CONTACT.arguments:
            rows = argument.count(",") + 1
            address, shape = fields[place + _DATA], fields[place + _SIZE : place + _SIZE + rows]
            arrays.append(_array(address, shape))
            place += _VECTOR + 2 * (rows - 1)
        try:
            self.function(*arrays)
        except BaseException as reason:  # Ctrl-C too, which machine code would swallow
            self.failed = reason
            arrays[-3][:] = np.nan
        return 0


def _array(address: int, shape: tuple[int, ...]) -> Any:
    """Return the numbers at an address; no copy."""
    size = 1
    for length in shape:
        size *= length
    if size == 0:
        return np.empty(shape)
    return np.ctypeslib.as_array((ctypes.c_double * size).from_address(address)).reshape(shape)
