"""Nobody but the page itself talks to the server: other sites in the same browser are refused."""

import os
import socket
from collections.abc import Awaitable, Callable, Mapping, MutableMapping
from typing import Any

from wearsim.errors import OutputError

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Scope, Receive, Send], Awaitable[None]]

MOST_BYTES = 64_000_000
"""Size of the largest request, which is the upload of a photograph."""

_NAMES = ("127.0.0.1", "localhost", "[::1]")
_OWN_SITES = ("same-origin", "none")


def loopback_socket(port: int) -> socket.socket:
    """Return a socket that browsers of this machine can connect to.

    Examples
    --------
    >>> with loopback_socket(0) as server_socket:
    ...     server_socket.getsockname()[0]
    '127.0.0.1'
    """
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        if os.name == "posix":  # elsewhere it would share a port that is in use
            found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        found.bind((_NAMES[0], port))
        found.listen()
    except OSError as error:
        found.close()
        reason = error.strerror or str(error)
        raise OutputError(
            f"--port {port}: must be free, but: {reason}: choose another, or leave it out"
        ) from None
    return found


class Guard:
    """An application that answers requests of its own page only.

    A page of another site can send requests to this machine, and by a name that it lets point
    here even read the answers. Its browser then names that site in ``Origin`` or ``Host``.
    """

    def __init__(self, app: Application, port: int) -> None:
        self.app = app
        names = [f"{name}:{port}" for name in _NAMES]
        self._hosts = {*names, *(_NAMES if port == 80 else ())}
        self._origins = {f"http://{host}" for host in self._hosts}
        self._headers = [(b"content-security-policy", _policy(names).encode()), *_HEADERS]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it: with status 403, or 411 or 413 for its size."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        refusal, status = self._refusal(scope), 403
        if not refusal and scope["type"] == "http":
            refusal, status = _size_refusal(_headers(scope))
        if not refusal:
            await self.app(scope, receive, self._with_headers(send))
        elif scope["type"] == "websocket":
            # Closed before it is accepted: the server answers the handshake with 403.
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": refusal})
        else:
            headers = [(b"content-type", b"text/plain; charset=utf-8"), *self._headers]
            await send({"type": "http.response.start", "status": status, "headers": headers})
            await send({"type": "http.response.body", "body": f"{refusal}\n".encode()})

    def _refusal(self, scope: Scope) -> str:
        """Why a request is not answered; empty where it is."""
        given = _headers(scope)
        hosts, origins = given.get("host", []), given.get("origin", [])
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            return "wearsim ui: the request must be to the loopback address that it printed"
        if any(origin.lower() not in self._origins for origin in origins):
            return "wearsim ui: the request must come from its own page"
        site, mode = given.get("sec-fetch-site", ["none"]), given.get("sec-fetch-mode", [""])
        if site[0] not in _OWN_SITES and mode[0] != "navigate":
            return "wearsim ui: the request must come from its own page"
        return ""

    def _with_headers(self, send: Send) -> Send:
        async def _send(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", ()), *self._headers]
            await send(message)

        return _send


_HEADERS = [
    (b"x-frame-options", b"DENY"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-resource-policy", b"same-origin"),
]


def _headers(scope: Scope) -> Mapping[str, list[str]]:
    found: dict[str, list[str]] = {}
    for name, value in scope["headers"]:
        found.setdefault(name.decode("latin-1").lower(), []).append(value.decode("latin-1"))
    return found


def _size_refusal(given: Mapping[str, list[str]]) -> tuple[str, int]:
    """Why a request is not answered for its size, with the status; empty where it is answered."""
    if "transfer-encoding" in given:
        return "wearsim ui: the request must say its length in Content-Length", 411
    length = given.get("content-length", ["0"])[0]
    if not length.isdecimal() or int(length) > MOST_BYTES:
        return f"wearsim ui: the request must have at most {MOST_BYTES // 1_000_000} MB", 413
    return "", 0


def _policy(names: list[str]) -> str:
    """What the page may load: only what this server gives."""
    sockets = " ".join(f"ws://{name}" for name in names if not name.startswith("["))
    return (
        "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; "
        "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
        f"connect-src 'self' {sockets}; worker-src 'self' blob:; object-src 'none'; "
        "frame-ancestors 'none'; base-uri 'self'; form-action 'none'"
    )
