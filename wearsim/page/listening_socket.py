"""The place that browsers connect to."""

import os
import socket

from wearsim.errors import OutputError

ADDRESS = "127.0.0.1"
"""Only programs of this machine reach it."""


def loopback_socket(port: int) -> socket.socket:
    """Return a socket that browsers of this machine can connect to.

    Examples
    --------
    >>> with loopback_socket(0) as listener:
    ...     listener.getsockname()[0]
    '127.0.0.1'
    """
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        if os.name == "posix":  # elsewhere it would share a port that is in use
            found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        found.bind((ADDRESS, port))
        found.listen()
    except OSError as error:
        found.close()
        reason = error.strerror or str(error)
        raise OutputError(
            f"--port {port}: must be free, but: {reason}: choose another, or leave it out"
        ) from None
    return found
