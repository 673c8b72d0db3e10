"""Machine code of kernels: kept as object files, loaded by LLVM alone and called by their addresses.

numba takes longer to load than a life takes to run, and none of it is needed to call what it once compiled.
A file holds a hash of its code and of its own name, then the code. The name carries the kernel, the processor
and all settings of numba, that of the folder the sources: code runs only as what it was made for.
"""

import contextlib
import ctypes
import hashlib
import os
import sys
import tempfile
from functools import cache
from operator import index
from pathlib import Path
from typing import Any

from wearsim.jit.signatures import Signature

_HASH = 32
"""Bytes of a hash."""

_MOST_BYTES = 100_000_000
"""Of a sealed file."""

FROM_PYTHON = (
    *("acos", "asin", "atan", "atan2", "ceil", "cos", "exp", "expm1", "floor", "fmod", "log", "log1p"),
    *("memcpy", "memmove", "memset", "pow", "sin", "sqrt", "tan", "tanh", "trunc"),
)
"""What machine code may call beyond itself, of the libraries of C that Python has loaded."""

_KINDS: dict[str, Any] = {"d": ctypes.c_double, "i": ctypes.c_int64, "p": ctypes.c_void_p}
_RESULTS: dict[str, Any] = {"float64": ctypes.c_double, "int64": ctypes.c_int64, "void": ctypes.c_void_p}


def parameters(signature: Signature) -> str:
    """Return what stands for the arguments in machine code: d a float, i an integer, p an address."""
    return "".join(map(_parameters, signature.arguments))


def _parameters(argument: Signature) -> str:
    dimensions = _dimensions(argument)
    if dimensions:
        return "ppiip" + "ii" * dimensions
    return {"float64": "d", "int64": "i"}.get(argument, "ppp")


def _dimensions(argument: Signature) -> int:
    return argument.count(",") + 1 if argument.startswith("float64[") else 0


@cache
def _engine() -> Any:
    from llvmlite import binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_triple(llvm.get_process_triple()).create_target_machine()
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)


@cache
def usable() -> bool:
    """Tell whether machine code can run without numba, which finds the libraries of C on Windows."""
    from llvmlite import binding as llvm

    _engine()  # which has LLVM look through all that the process has loaded
    return sys.platform != "win32" and all(map(llvm.address_of_symbol, FROM_PYTHON))


@cache
def file_ending() -> str:
    """Return how the names of the object files end that this process may run."""
    import llvmlite
    from llvmlite import binding as llvm

    features = llvm.get_host_cpu_features().flatten()
    settings = [f"{name}={value}" for name, value in sorted(os.environ.items()) if _matters(name)]
    parts = [llvmlite.__version__, llvm.get_process_triple(), llvm.get_host_cpu_name(), features, *settings]
    return f"-{hashlib.sha256(' '.join(parts).encode()).hexdigest()[:12]}.o"


def _matters(setting: str) -> bool:
    return setting.startswith("NUMBA_") and setting not in ("NUMBA_CACHE_DIR", "NUMBA_DISABLE_JIT")


def keep(code: bytes, path: Path) -> None:
    """Write an object file, or none on a full disk; renamed, so that others never see a part of it."""
    with contextlib.suppress(OSError), tempfile.TemporaryDirectory(dir=path.parent) as folder:
        beside = Path(folder) / path.name
        beside.write_bytes(sealed(code, _label(path)))
        os.replace(beside, path)


def _label(path: Path) -> str:
    return f"{path.parent.name}/{path.name}"


def sealed(content: bytes, label: str) -> bytes:
    """Return what a file holds that `unsealed` knows to be whole and its own: the content after a hash."""
    return hashlib.sha256(label.encode() + b"\0" + content).digest() + content


def unsealed(path: Path, label: str) -> bytes | None:
    """Return the content of a file sealed under a label; nothing where there is none, or another."""
    try:
        # A pipe would be waited for, and another's file may have any size.
        whole = path.read_bytes() if path.is_file() and path.stat().st_size <= _MOST_BYTES else b""
    except OSError:
        return None
    content = whole[_HASH:]
    return content if sealed(content, label) == whole else None


def kept(path: Path) -> bytes | None:
    """Return the machine code that `keep` has written into this very file, or nothing."""
    return unsealed(path, _label(path))


class MachineCode:
    """A kernel in machine code."""

    def __init__(self, name: str, signature: Signature, code: bytes) -> None:
        from llvmlite import binding as llvm

        engine = _engine()
        engine.add_object_file(llvm.ObjectFileRef.from_data(code))
        engine.finalize_object()
        self.address: int = engine.get_function_address(name)
        self._name, self._result = name, _RESULTS[signature.result]
        self._takes = [_dimensions(one) or one for one in signature.arguments]
        kinds = [_KINDS[kind] for kind in "pp" + parameters(signature)]
        self._function = ctypes.CFUNCTYPE(ctypes.c_int32, *kinds)(self.address)

    def __call__(self, *arguments: Any) -> Any:
        """Return what the kernel does."""
        values: list[Any] = []
        for taken, argument in zip(self._takes, arguments, strict=True):
            if taken == "float64":
                values.append(argument)
            elif taken == "int64":
                values.append(index(argument))
            elif isinstance(taken, int):
                values += self._array(argument, taken)
            else:
                values += (None, None, argument)
        result, error = self._result(), ctypes.c_void_p()
        status = self._function(ctypes.addressof(result), ctypes.addressof(error), *values)
        if status:
            raise RuntimeError(f"kernel {self._name}: must return, but raised an exception ({status})")
        return result.value

    def _array(self, array: Any, dimensions: int) -> tuple[Any, ...]:
        """Return what stands for an array: no owner, size, bytes of a number, address, shape, strides."""
        interface = array.__array_interface__
        address, read_only = interface["data"]
        shape, strided = interface["shape"], interface["strides"]
        if interface["typestr"] != "<f8" or len(shape) != dimensions or strided or read_only:
            raise TypeError(
                f"kernel {self._name}: an array must be of float64, without gaps, writable and of dimension "
                f"{dimensions}, but is {interface}"
            )
        return None, None, array.size, array.itemsize, address, *shape, *array.strides
