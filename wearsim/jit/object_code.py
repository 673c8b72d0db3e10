"""Kernels as numba makes them: object code that runs without it or, in doubt, numba's own function.

numba compiles each function on its own: it optimises the code once more with what the function calls, makes
machine code of it, and wraps that for Python. Here all that a kernel calls is only lowered, then linked,
optimised and turned into machine code once, and nothing of it needs numba or Python to run.
"""

import contextlib
import gc
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numba
from llvmlite import ir
from numba import types
from numba.core import codegen, cpu, errors
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher, CPUTarget
from numba.core.typing.context import Context
from numba.extending import typeof_impl

from wearsim.jit.machine_code import FROM_PYTHON, parameters

if TYPE_CHECKING:
    from wearsim.jit.compiled import Kernel

_NJIT: Any = numba.njit

_STRICT = {"error_model": "numpy", "nogil": True}
"""Options of every kernel: no exceptions, no fast arithmetic, other threads run on."""

_BARE = {**_STRICT, "_nrt": False, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""No arrays of their own, nothing that Python could call."""

_ARRAY = ("meminfo", "parent", "nitems", "itemsize", "data", "shape", "strides")
_FUNCTION = ("c_addr", "py_addr", "jit_addr")
"""Fields by which numba passes an array, and a function."""

_PROCEDURE = ir.FunctionType(ir.VoidType(), ())


class _Part(codegen.JITCodeLibrary):
    """A function that is lowered but neither optimised nor turned into machine code."""

    def add_ir_module(self, module: ir.Module) -> None:
        """Add code; the way through Python to a function whose address is missing is cut off."""
        for function in module.functions:
            if function.name == "numba_gil_ensure" and function.is_declaration:
                builder = ir.IRBuilder(function.append_basic_block())
                builder.call(module.declare_intrinsic("llvm.trap", (), _PROCEDURE), ())
                builder.unreachable()
                function.linkage = "internal"
        super().add_ir_module(module)

    def finalize(self) -> None:
        """Leave the code as it is."""
        self._finalized = True

    def link(self, entry: str, name: str) -> bytes:
        """Return the object code of a function with all that it calls, or nothing where it takes more."""
        whole = self.codegen.create_library(name)
        module = whole._final_module
        for part in self._with_all_below({}):
            # What numba has compiled in full, for a function of its own, holds all below it.
            below = part._final_module if isinstance(part, _Part) else part._get_module_for_linking()
            module.link_in(below, preserve=True)
        for function in module.functions:
            if not function.is_declaration:
                function.linkage = "external" if function.name == entry else "internal"
        module.get_function(entry).name = name
        whole._optimize_final_module()
        module.verify()
        called = {one.name for one in module.functions if one.is_declaration}
        if not all(one in FROM_PYTHON or one.startswith("llvm.") for one in called):
            return b""
        code: bytes = self.codegen._tm.emit_object(module)
        return code

    def _with_all_below(self, found: dict[Any, None]) -> dict[Any, None]:
        if self not in found:
            found[self] = None
            for library in self._linking_libraries:
                if isinstance(library, _Part):
                    library._with_all_below(found)
                else:
                    found[library] = None
        return found


class _Codegen(codegen.JITCPUCodegen):
    _library_class = _Part

    def set_env(self, env_name: str, env: object) -> None:
        """Leave out the objects of Python that belong to a function: there are none."""


class _Context(cpu.CPUContext):
    def init(self) -> None:
        """Compile to parts."""
        super().init()
        self._internal_codegen = _Codegen("wearsim")


class _Target(CPUTarget):
    """The processor, for functions that are lowered only."""

    def __init__(self) -> None:
        super().__init__("cpu")
        self._typing = Context()
        self._context = _Context(self._typing, "cpu")

    @property
    def typing_context(self) -> Any:
        """Types of these functions alone: others are compiled in full."""
        return self._typing

    @property
    def target_context(self) -> Any:
        """How these functions are lowered."""
        return self._context


@cache
def _target() -> _Target:
    return _Target()


def object_code(kernel: "Kernel") -> bytes:
    """Return the object code of a kernel with all that it calls; none where it is left to numba."""
    with global_compiler_lock, _in_parts(), _without_collecting():
        try:
            compiled = next(iter(_part(kernel).overloads.values()))
        except (
            errors.NumbaError
        ):  # it takes memory of numba's, or is wrong, which numba's own function will say
            return b""
        module, entry = compiled.library._final_module, compiled.fndesc.llvm_func_name
        passed = [_kind(str(one.type)) for one in module.get_function(entry).arguments]
        if passed != [*"pp", *parameters(kernel.signature)] or not all(map(_known, compiled.signature.args)):
            return b""
        code: bytes = compiled.library.link(entry, kernel.name)
        return code


def _kind(type_name: str) -> str:
    return "p" if type_name.endswith(("*", "ptr")) else type_name[0]


def _known(argument: types.Type) -> bool:
    fields = {types.Array: _ARRAY, types.FunctionType: _FUNCTION}.get(type(argument))
    model = _target().target_context.data_model_manager[argument]
    return fields is None or tuple(model._fields) == fields


@contextlib.contextmanager
def _in_parts() -> Iterator[None]:
    """Have all that numba compiles meanwhile lowered only."""
    before = CPUDispatcher.targetdescr
    CPUDispatcher.targetdescr = _target()
    try:
        yield
    finally:
        CPUDispatcher.targetdescr = before


@contextlib.contextmanager
def _without_collecting() -> Iterator[None]:
    """Spare the tenth of the time that goes into looking through objects that all are still needed."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


@cache
def _part(kernel: "Kernel") -> Any:
    typeof_impl.register(type(kernel), _type_of)
    return _NJIT(kernel.signature, **_BARE)(kernel.function)


def numba_function(kernel: "Kernel", folder: Path | None) -> Any:
    """Return numba's own function of a kernel, with its own cache in a folder."""
    typeof_impl.register(type(kernel), _type_of)
    config: Any = numba.config
    before = config.CACHE_DIR
    config.CACHE_DIR = str(folder) if folder else before
    try:
        with _without_collecting():
            return _NJIT(kernel.signature, cache=folder is not None, **_STRICT)(kernel.function)
    finally:
        config.CACHE_DIR = before


def address(function: Any) -> int:
    """Return where the machine code of a function of numba's stands that has one signature."""
    compiled = next(iter(function.overloads.values()))
    place: int = compiled.library.get_pointer_to_function(compiled.fndesc.llvm_func_name)
    return place


def _type_of(kernel: "Kernel", context: Any) -> Any:
    """Have numba find, where a kernel calls another one, that one's compiled form."""
    in_parts = CPUDispatcher.targetdescr is _target()
    return typeof_impl(_part(kernel) if in_parts else kernel.left_to_numba, context)
