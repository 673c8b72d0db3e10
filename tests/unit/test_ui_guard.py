"""Who the server of ``wearsim ui`` answers: a bare application behind the guard."""

import asyncio

import pytest

from wearsim.page.request_guard import Guard

PORT = 8123
OWN = f"127.0.0.1:{PORT}"


async def application(scope, receive, send):
    if scope["type"] == "http":
        await send({"type": "http.response.start", "status": 200, "headers": [(b"x-own", b"1")]})
        await send({"type": "http.response.body", "body": b"answered"})
    else:
        await send({"type": "websocket.accept" if scope["type"] == "websocket" else "ready"})


def messages(kind="http", port=PORT, **headers):
    """Messages that a request is answered with."""
    given = {"host": f"127.0.0.1:{port}"} | {k.replace("_", "-"): v for k, v in headers.items()}
    pairs = [(k.encode(), v.encode()) for k, v in given.items() if v is not None]
    sent = []

    async def receive():
        return {"type": "websocket.connect"}

    async def send(message):
        sent.append(message)

    asyncio.run(Guard(application, port)({"type": kind, "headers": pairs}, receive, send))
    return sent


def answered(**headers):
    """Whether both an HTTP request and a websocket are let through; they never differ."""
    (start, *_), (first, *_) = messages(**headers), messages("websocket", **headers)
    through = start["status"] == 200
    assert through == (first["type"] == "websocket.accept")
    assert through or (start["status"] == 403 and first["type"] == "websocket.close")
    return through


@pytest.mark.parametrize("host", [OWN, f"localhost:{PORT}", f"[::1]:{PORT}", f"LocalHost:{PORT}"])
def test_own_hosts_are_answered(host):
    assert answered(host=host)
    assert answered(host=host, origin=f"http://{host}")


@pytest.mark.parametrize(
    "host",
    [
        None,
        "",
        "127.0.0.1",
        "localhost",
        "127.0.0.1:1",
        "evil.example",
        f"evil.example:{PORT}",
        f"127.0.0.1.evil.example:{PORT}",
        f"{OWN}.evil.example",
        f"localhost:{PORT}0",
        f"0.0.0.0:{PORT}",
        f"x@{OWN}",
        f"{OWN}/",
        f"{OWN}, evil.example",
    ],
)
def test_foreign_hosts_are_refused(host):
    assert not answered(host=host)


@pytest.mark.parametrize(
    "origin",
    [
        "",
        "null",
        "http://evil.example",
        f"http://evil.example:{PORT}",
        f"https://{OWN}",
        "http://127.0.0.1",
        "http://127.0.0.1:1",
        f"http://{OWN}.evil.example",
        f"file://{OWN}",
        OWN,
    ],
)
def test_foreign_origins_are_refused(origin):
    assert not answered(origin=origin)


def test_two_hosts_are_refused():
    sent = []

    async def send(message):
        sent.append(message)

    pairs = [(b"host", OWN.encode()), (b"host", b"evil.example")]
    asyncio.run(Guard(application, PORT)({"type": "http", "headers": pairs}, None, send))
    assert sent[0]["status"] == 403


@pytest.mark.parametrize(
    ("site", "mode", "through"),
    [
        ("same-origin", "cors", True),
        ("none", "navigate", True),
        ("cross-site", "navigate", True),
        ("cross-site", "no-cors", False),
        ("same-site", "no-cors", False),
        ("cross-site", "websocket", False),
    ],
)
def test_requests_that_a_browser_tells_to_be_of_another_site(site, mode, through):
    assert answered(sec_fetch_site=site, sec_fetch_mode=mode) is through


def test_port_80_is_left_out_by_browsers():
    assert messages(port=80, host="localhost", origin="http://localhost")[0]["status"] == 200
    assert messages(port=80, host="evil.example")[0]["status"] == 403


def test_lifespan_is_passed_on():
    assert messages("lifespan") == [{"type": "ready"}]


@pytest.mark.parametrize("headers", [{}, {"origin": "null"}])
def test_answers_forbid_frames_and_what_is_not_their_own(headers):
    found = dict(messages(**headers)[0]["headers"])
    assert found[b"x-frame-options"] == b"DENY"
    policy = found[b"content-security-policy"].decode()
    assert "default-src 'self'" in policy and "frame-ancestors 'none'" in policy
    assert "*" not in policy and "https:" not in policy
    assert (b"x-own" in found) == (not headers)


def test_a_refusal_says_why():
    body = messages(host="evil.example")[1]["body"].decode()
    assert body == "wearsim ui: the request must be to the loopback address that it printed\n"


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 200),
        ({"content_length": "64000000"}, 200),
        ({"content_length": "64000001"}, 413),
        ({"content_length": "-1"}, 413),
        ({"content_length": ""}, 413),
        ({"transfer_encoding": "chunked"}, 411),
        ({"content_length": "64000001", "origin": "null"}, 403),
    ],
)
def test_large_requests_are_refused(headers, status):
    assert messages(**headers)[0]["status"] == status
