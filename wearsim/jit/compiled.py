"""The one decorator of every kernel: compiled at its first call, with a disk cache that cannot go stale.

numba's own cache looks only at the file that holds a function: an edited helper
in another file leaves the old machine code in use, and a read-only install
without a writable home fails at import. Here the cache folder carries a hash of
all kernel sources, and a private temporary folder stands in where no cache
folder can be written.

Nothing here or in the modules of the kernels imports numba before a kernel has to be compiled, which is how a
command starts at once. A program may have the kernels that a run is going to call compiled
together, before the first of them is called: `expect` names them, `compile_by` says how.
"""

import contextlib
import hashlib
import os
import platform
import sys
import tempfile
import threading
from collections.abc import Callable, Iterable
from functools import cache, cached_property, update_wrapper
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from types import FunctionType
from typing import Any, ClassVar, TypeVar, cast

import platformdirs

from wearsim.jit.machine_code import MachineCode, file_ending, keep, kept, usable

Function = TypeVar("Function", bound=Callable[..., Any])

_HERE = Path(__file__).parent
_KERNELS, _PACKAGE = _HERE.with_name("kernels"), "wearsim.kernels"
"""Folder and package of all kernels of wearsim."""


def source_hash() -> str:
    """Return the hash of every kernel source, numba and Python that the machine code depends on."""
    from importlib.metadata import version

    digest = hashlib.sha256(f"{version('numba')} {platform.python_version()}".encode())
    sources = (source for folder in (_HERE, _KERNELS) for source in folder.glob("*.py"))
    for source in sorted(sources):
        digest.update(f"{source.parent.name}/{source.name}".encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def _private(folder: Path) -> bool:
    """Tell whether a folder of a shared temporary place is ours alone (cached code is executed)."""
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        status = folder.lstat()
    except OSError:
        return False
    return status.st_uid == os.getuid() and not status.st_mode & 0o077


def user_cache() -> Path | None:
    """Return the user's cache folder of wearsim; None for a user without a home."""
    try:
        return Path(platformdirs.user_cache_dir("wearsim"))
    except RuntimeError:
        return None


def cache_folder() -> Path | None:
    """Return the folder that holds the machine code of these sources.

    ``NUMBA_CACHE_DIR`` is the parent where it is set, else the user's cache folder,
    else a private folder under the temporary directory.
    """
    name = f"numba-{source_hash()}"
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    parent = Path(chosen) if chosen else user_cache()
    if parent and _writable(parent / name):
        return parent / name
    shared = _temporary_folder()
    return shared / name if shared and _writable(shared / name) else None


def _temporary_folder() -> Path | None:
    try:
        folder = Path(tempfile.gettempdir()) / f"wearsim-{os.getuid()}"
    except (AttributeError, OSError):  # no user numbers on this system; no temporary folder at all
        return None
    return folder if _private(folder) else None


@cache
def _folder() -> Path | None:
    """Return the folder of this process, which stays where it is."""
    return cache_folder()


_COMPILING = threading.RLock()


class Kernel:
    """A function that is compiled, or read from the cache, when it is first called.

    One that is quick runs in Python until machine code has been loaded for something else: to the same
    bits, in a tenth of the time that loading takes.
    """

    def __init__(self, function: Callable[..., Any], signature: Any, quick: bool) -> None:
        update_wrapper(self, function)
        self.function, self.signature, self._quick = function, signature, quick
        self._takes_kernels = "FunctionType" in str(signature)

    def __call__(self, *arguments: Any) -> Any:
        """Return what the function does."""
        if self._quick and "llvmlite" not in sys.modules:
            # Compiled code goes on with inf and nan where Python, and numpy where it is asked to, raise.
            with contextlib.suppress(ArithmeticError):
                return self.function(*arguments)
        if "compiled" not in self.__dict__:
            compile_expected(self)
        if self._takes_kernels:
            form = type(self.compiled)
            arguments = tuple(one.handed_to(form) if isinstance(one, Kernel) else one for one in arguments)
        return self.compiled(*arguments)

    def __reduce__(self) -> str:
        return self.function.__qualname__

    @cached_property
    def compiled(self) -> Callable[..., Any]:
        """The function in machine code, strict in its arithmetic, or in the form that stands in for that.

        That is the function itself where numba is told to compile nothing, and numba's own where
        object code would not do, and for kernels of other packages.
        """
        with _COMPILING:
            if _interpreted():
                return self.function
            code = self._code() if self.ours and usable() else b""
            return MachineCode(self.name, self.signature, code) if code else self.left_to_numba

    def _code(self) -> bytes:
        path = self.object_file
        code = kept(path) if path else None
        if code is None:
            from wearsim.jit.object_code import object_code

            code = object_code(self)
            if path:
                keep(code, path)
        return code

    @cached_property
    def left_to_numba(self) -> Any:
        """What numba itself makes of the function."""
        from wearsim.jit.object_code import numba_function

        return numba_function(self, _folder())

    def handed_to(self, form: type) -> Any:
        """Return what a kernel in a form takes as its argument for this one."""
        if form is FunctionType:
            return self.function
        if form is not MachineCode:
            return self.left_to_numba
        if isinstance(self.compiled, MachineCode):
            return self.compiled.address
        from wearsim.jit.object_code import address

        return address(self.compiled)

    @property
    def name(self) -> str:
        """Module and name, as in the files of the cache."""
        return f"{Path(self.function.__code__.co_filename).stem}.{self.function.__qualname__}"

    @property
    def ours(self) -> bool:
        """Whether it is of this package."""
        return self.function.__module__.startswith(f"{_PACKAGE}.")

    @property
    def object_file(self) -> Path | None:
        """File of the cache that holds its machine code; it is empty where the kernel is left to numba."""
        folder = _folder()
        return folder / f"{self.name}{file_ending()}" if folder else None

    @cached_property
    def tree(self) -> "set[Kernel]":
        """The kernel and all that it calls, however far down."""
        code, known = self.function.__code__, self.function.__globals__
        called = [known[name] for name in code.co_names if isinstance(known.get(name), Kernel)]
        return {self}.union(*(one.tree for one in called))


def _interpreted() -> bool:
    """Tell whether numba is told to compile nothing."""
    if "numba" in sys.modules:
        config: Any = sys.modules["numba"].config
        return bool(config.DISABLE_JIT)
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")


def kernel(signature: Any, quick: bool = False) -> Callable[[Function], Function]:
    """Make a function a kernel of one signature."""

    def make_kernel(function: Function) -> Function:
        return cast("Function", Kernel(function, signature, quick))

    return make_kernel


def kernel_of(name: str) -> Kernel:
    """Return the kernel of a name such as ``strand.strand_contact``."""
    module, _, function = name.partition(".")
    found: Kernel = getattr(import_module(f"{_PACKAGE}.{module}"), function)
    return found


def all_kernels() -> list[Kernel]:
    """Return every kernel of wearsim."""
    places = iter_modules([str(_KERNELS)], f"{_PACKAGE}.")
    modules = [import_module(place.name) for place in places]
    found = {one for module in modules for one in vars(module).values() if isinstance(one, Kernel)}
    return sorted(found, key=lambda one: one.name)


def not_in_cache(kernels: Iterable[Kernel]) -> list[Kernel]:
    """Return the kernels that have to be compiled before they can be called.

    There are none where nothing is compiled at all or nothing can be kept. Kernels of other packages
    are left out.
    """
    if _interpreted() or _folder() is None or not usable():
        return []
    files = {one: one.object_file for one in kernels if one.ours}
    return [one for one, path in files.items() if path and not path.exists()]


class _Ahead:
    """What is compiled together before the first kernel is called, and by what."""

    expected: ClassVar[set[str]] = set()
    compile_together: Callable[[list[Kernel]], None] | None = None


def expect(names: Iterable[str]) -> None:
    """Name kernels that are going to be called."""
    _Ahead.expected.update(names)


def compile_by(compile_together: Callable[[list[Kernel]], None] | None) -> None:
    """Say what compiles kernels that the cache does not hold; without it each is at its first call."""
    _Ahead.compile_together = compile_together


def compile_expected(*others: Kernel) -> None:
    """Compile the kernels that are expected, and others, unless the cache holds them."""
    if _Ahead.compile_together is None or threading.current_thread() is not threading.main_thread():
        return
    names = sorted(_Ahead.expected)
    _Ahead.expected.clear()
    missing = not_in_cache([*map(kernel_of, names), *others])
    if missing:
        _Ahead.compile_together(missing)
