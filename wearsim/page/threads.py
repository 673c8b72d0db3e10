"""Work beside the event loop, so that the page stays alive."""

import asyncio
import threading
from collections.abc import Callable
from typing import TypeVar

Found = TypeVar("Found")


async def in_thread(work: Callable[[], Found]) -> Found:
    """Wait for work that runs in a thread of its own."""
    loop = asyncio.get_running_loop()
    done: asyncio.Future[Found] = loop.create_future()

    def _settle(found: Found | None, error: BaseException | None) -> None:
        if done.cancelled():
            return
        if error is None:
            done.set_result(found)  # type: ignore[arg-type]
        else:
            done.set_exception(error)

    def _run() -> None:
        found, failed = None, None
        try:
            found = work()
        except BaseException as error:
            failed = error
        if not loop.is_closed():
            loop.call_soon_threadsafe(_settle, found, failed)

    # Not of a pool: the end of the program would wait for its threads.
    threading.Thread(target=_run, daemon=True).start()
    return await done
