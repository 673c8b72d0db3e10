"""``wearsim warm``: every kernel compiled ahead, so that no run waits for it."""

import click

from wearsim.command.options import common_options
from wearsim.errors import OutputError


@click.command(short_help="Compile all kernels now, so that no later run has to wait.")
@common_options
def warm() -> None:
    """Compile everything that the cache lacks, after an installation or while an image is built.

    The cache belongs to this version of wearsim, numba and Python, and holds separate machine code
    for each kind of processor. Without this command, each run compiles what it needs the first time.
    """
    from wearsim.command.compile_ahead import compile_with_bar
    from wearsim.jit.compiled import all_kernels, cache_folder, not_in_cache

    folder, kernels = cache_folder(), all_kernels()
    if folder is None:
        raise OutputError(
            "cache of kernels: must have a folder that can be written, but has none: set NUMBA_CACHE_DIR"
        )
    missing = not_in_cache(kernels)
    if missing:
        compile_with_bar(click.get_current_context(), missing)
    click.echo(f"{len(missing)} of {len(kernels)} kernels compiled, all are in {folder}")
