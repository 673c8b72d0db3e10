"""The one decorator of every kernel, with a disk cache that cannot go stale.

numba's own cache looks only at the file that holds a function: an edited helper
in another file leaves the old machine code in use, and a read-only install
without a writable home fails at import. Here the cache folder carries a hash of
all kernel sources, and a private temporary folder stands in where no cache
folder can be written.
"""

import hashlib
import os
import platform
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numba
import platformdirs

_CONFIG: Any = numba.config

Function = TypeVar("Function", bound=Callable[..., Any])


def source_hash() -> str:
    """Return the hash of every kernel source, numba and Python that the machine code depends on."""
    digest = hashlib.sha256(f"{numba.__version__} {platform.python_version()}".encode())
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.name.encode())
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


def cache_folder() -> Path | None:
    """Return the folder that holds the machine code of these sources.

    ``NUMBA_CACHE_DIR`` is the parent where it is set, else the user's cache folder,
    else a private folder under the temporary directory.
    """
    name = f"numba-{source_hash()}"
    chosen = os.environ.get("NUMBA_CACHE_DIR") or platformdirs.user_cache_dir("wearsim")
    folder = Path(chosen) / name
    if _writable(folder):
        return folder
    shared = _temporary_folder()
    return shared / name if shared and _writable(shared / name) else None


def _temporary_folder() -> Path | None:
    try:
        folder = Path(tempfile.gettempdir()) / f"wearsim-{os.getuid()}"
    except (AttributeError, OSError):  # no user numbers on this system; no temporary folder at all
        return None
    return folder if _private(folder) else None


_FOLDER = cache_folder()


def kernel(signature: Any) -> Callable[[Function], Function]:
    """Compile a function for one signature: strict arithmetic, no exceptions, safe cache."""

    def compile_function(function: Function) -> Function:
        before = _CONFIG.CACHE_DIR
        _CONFIG.CACHE_DIR = str(_FOLDER) if _FOLDER else before
        try:
            compiled: Function = numba.njit(
                signature, cache=_FOLDER is not None, error_model="numpy", nogil=True
            )(function)
        finally:
            _CONFIG.CACHE_DIR = before
        return compiled

    return compile_function
