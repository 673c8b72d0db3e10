"""``wearsim ui`` in a process of its own, and what tests do with its page."""

import os
import signal
import subprocess
import sys
import time

COMMAND = [sys.executable, "-c", "import wearsim.cli; wearsim.cli.main()"]


class Server:
    """``wearsim ui`` in a process of its own."""

    def __init__(self, folder, *arguments, browser=None):
        quiet = [] if browser else ["--no-browser"]
        self.process = subprocess.Popen(
            [*COMMAND, "ui", *quiet, *map(str, arguments)],
            cwd=folder,
            env={**os.environ, "BROWSER": str(browser)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.url = self.process.stdout.readline().strip()
        assert self.url, self.process.stderr.read()
        self.port = int(self.url.rstrip("/").rpartition(":")[2])

    def stop(self):
        """Exit code and what it said on stderr."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            _, said = self.process.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        return self.process.returncode, said


def settled(page, seconds=60):
    page.wait_for_selector('.ws-state[data-state="current"]', timeout=1000 * seconds)


REMEMBERED = """
window.states = [];
new MutationObserver(() => {
  const state = document.querySelector('.ws-state')?.dataset.state;
  if (state && states.at(-1) !== state) states.push(state);
}).observe(document, {subtree: true, childList: true, attributes: true, attributeFilter: ['data-state']});
"""
"""Keeps the states that a page has shown: one may be gone before a browser draws it."""


def forget_states(page):
    page.evaluate("states.length = 0")


def comes_to(page, state, seconds=60):
    page.wait_for_function("state => states.includes(state)", arg=state, timeout=1000 * seconds)


def opened(page, server):
    page.goto(server.url)
    settled(page)
    return page


def field(page, key):
    return page.locator(f'[data-key="{key}"]')


def shown_hours(page):
    return page.locator(".ws-now-hours").inner_text()


def eventually(look, right, seconds=20.0):
    end = time.monotonic() + seconds
    while not right(found := look()):
        assert time.monotonic() < end, found
        time.sleep(0.05)
    return found


def source(page):
    """What the TOML tab holds."""
    page.get_by_role("tab", name="TOML").click()
    text = page.locator(".cm-content").inner_text()
    page.get_by_role("tab", name="Form").click()
    return text
