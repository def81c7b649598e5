"""One tab of a real browser, without a screen, for tests of pages.

In: Chromium, if it is installed (`CHROMIUM`). Out: what the page says and shows, and which
addresses it asks for.
"""

from __future__ import annotations

import base64
import io
import json
import os
import shutil
import signal
import subprocess
import tempfile
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from websockets.sync.client import connect

from tests.support.waiting import TIMEOUT_S, wait_until

LOOPBACK = "127.0.0.1"
URL_LINE = r"view at (http://127\.0\.0\.1:\d+/[0-9a-f]{32}/);"
"""What `rcgen view` prints first."""


CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
needs_chromium = pytest.mark.skipif(
    not CHROMIUM, reason="chromium is not installed: `make test-tools` installs it"
)
SWITCHES = (
    "--headless=new",
    "--no-sandbox",
    "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",  # no other host
    "--remote-debugging-port=0",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-dev-shm-usage",
    "--ignore-gpu-blocklist",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)


class Tab:
    """One tab of Chromium, over its own protocol."""

    def __init__(self, port: int) -> None:
        with urllib.request.urlopen(f"http://{LOOPBACK}:{port}/json/list", timeout=10) as answer:
            tabs = json.load(answer)
        url = next(tab["webSocketDebuggerUrl"] for tab in tabs if tab["type"] == "page")
        self._link = connect(url, max_size=None)
        self._number = 0
        self.asked: list[str] = []

    def __call__(self, method: str, **parameters: object) -> dict:  # type: ignore[type-arg]
        self._number += 1
        order = {"id": self._number, "method": method, "params": parameters}
        self._link.send(json.dumps(order))
        while True:
            messages = json.loads(self._link.recv(timeout=TIMEOUT_S))
            if messages.get("method") == "Network.requestWillBeSent":
                self.asked.append(messages["params"]["request"]["url"])
            elif messages.get("method") == "Network.webSocketCreated":
                self.asked.append(messages["params"]["url"])
            elif messages.get("id") == self._number:
                return messages.get("result", {})

    def value(self, script: str) -> object:
        return self("Runtime.evaluate", expression=script)["result"].get("value")

    def shows(self, *words: str) -> bool:
        text = str(self.value("document.body ? document.body.innerText : ''"))
        return all(word in text for word in words)

    def open_panel(self, name: str) -> None:
        tab = (
            f"[...document.querySelectorAll('[role=tab]')].find(t => /{name}/.test(t.textContent))"
        )
        middle = "r => `${r.x + r.width / 2} ${r.y + r.height / 2}`"
        where = f"({middle})({tab}.getBoundingClientRect())"
        x, y = (float(number) for number in str(self.value(where)).split())
        for kind in ("mousePressed", "mouseReleased"):
            self("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def picture(self) -> np.ndarray:
        data = base64.b64decode(self("Page.captureScreenshot")["data"])
        return imread(io.BytesIO(data))[:, :, :3]

    def close(self) -> None:
        self._link.close()


def red(picture: np.ndarray) -> float:
    """The red share of a picture, values from 0 to 1."""
    return float(((picture[:, :, 0] > 0.6) & (picture[:, :, 1:].max(axis=2) < 0.35)).mean())


@contextmanager
def opened_tab() -> Iterator[Tab]:
    """A tab of a browser; the browser ends with the block."""
    assert CHROMIUM
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = subprocess.Popen(
            [CHROMIUM, *SWITCHES, f"--user-data-dir={profile}", "about:blank"],
            env=os.environ | {"HOME": profile, "TMPDIR": profile},  # what it leaves goes with it
            stderr=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            messages = Path(profile) / "DevToolsActivePort"
            wait_until(lambda: messages.is_file() and messages.read_text().count("\n"))
            result = Tab(int(messages.read_text().splitlines()[0]))
            yield result
            result.close()
        finally:
            os.killpg(browser.pid, signal.SIGKILL)
            browser.wait()
