"""Pages of the browser view: only this user's browser gets them, and only from our own page."""

from __future__ import annotations

import http.client
import stat
import webbrowser
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mujoco
import pytest

pytest.importorskip("viser", reason="needs the extra `view`")

import viser
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from robocomp_dsl.runtime.private_folder import read_page_token, read_token, user_folder
from robocomp_dsl.simulation.models.model_file import load_model
from robocomp_dsl.simulation.view import open_browser, page_guard
from robocomp_dsl.simulation.view.browser import LOOPBACK, BrowserPage
from robocomp_dsl.simulation.view.page_guard import PageGuard, Unprotected

CRANE = Path(__file__).parents[1] / "models" / "files" / "crane.xml"
PATIENCE = 120.0
PROTOCOL: Any = f"viser-v{viser.__version__}"


@pytest.fixture(scope="module")
def page() -> Iterator[BrowserPage]:
    model = load_model(CRANE).model
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    result = BrowserPage("crane", model, data)
    yield result
    result.close()


def ask(page: BrowserPage, path: str, **headers: str) -> tuple[int, str]:
    """Status and text of an HTTP answer; `TOKEN` in the path is the real one."""
    connection = http.client.HTTPConnection(LOOPBACK, page.port, timeout=PATIENCE)
    try:
        path = path.replace("TOKEN", read_page_token())
        names = {name.replace("_", "-"): value for name, value in headers.items()}
        names = {name: value.replace("PORT", str(page.port)) for name, value in names.items()}
        connection.request("GET", path, headers=names)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()
    finally:
        connection.close()


ALLOWED = [
    ("/TOKEN/", {}),
    ("/TOKEN", {}),
    ("/TOKEN/index.html?darkMode", {}),
    ("/TOKEN/", {"Host": "localhost:PORT"}),
    ("/TOKEN/", {"Host": "LOCALHOST:9000"}),  # through a tunnel
    ("/TOKEN/", {"Host": "[::1]:PORT"}),
    ("/TOKEN/", {"Host": "localhost:PORT", "Origin": "http://localhost:PORT"}),
]
REFUSED = [
    ("/", {}, "needs its token"),
    ("/index.html", {}, "needs its token"),
    ("/?token=TOKEN", {}, "needs its token"),
    ("/x/TOKEN/", {}, "needs its token"),
    ("//TOKEN/", {}, "needs its token"),
    ("/TOKEN0/", {}, "needs its token"),
    ("/" + "0" * 32 + "/", {}, "needs its token"),
    ("/%C3%BC/", {}, "needs its token"),
    ("/TOKEN/", {"Host": "evil.example:PORT"}, "open it as 127.0.0.1"),
    ("/TOKEN/", {"Host": "127.0.0.1.evil.example"}, "open it as 127.0.0.1"),
    ("/TOKEN/", {"Host": "evil@127.0.0.1@evil.example"}, "open it as 127.0.0.1"),
    ("/TOKEN/", {"Host": "[::1"}, "open it as 127.0.0.1"),
    ("/TOKEN/", {"Host": ""}, "open it as 127.0.0.1"),
    ("/TOKEN/", {"Origin": "http://evil.example"}, "Another page may not"),
    ("/TOKEN/", {"Origin": "null"}, "Another page may not"),
    ("/TOKEN/", {"Origin": "http://127.0.0.1:1"}, "Another page may not"),
    ("/TOKEN/", {"Origin": "https://127.0.0.1:PORT"}, "Another page may not"),
]


@pytest.mark.parametrize(("path", "headers"), ALLOWED)
def test_page_guard_serves_the_page_with_its_token(
    page: BrowserPage, path: str, headers: dict[str, str]
) -> None:
    status, text = ask(page, path, **headers)
    assert (status, "<html" in text[:2000].lower()) == (200, True)


@pytest.mark.parametrize(("path", "headers", "reason"), REFUSED)
def test_page_guard_refuses_requests(
    page: BrowserPage, path: str, headers: dict[str, str], reason: str
) -> None:
    status, text = ask(page, path, **headers)
    assert status == 403
    assert reason in text
    assert read_page_token() not in text


@pytest.mark.parametrize("own_origin", [True, False])
def test_page_guard_opens_websockets_with_the_token(page: BrowserPage, own_origin: bool) -> None:
    host = f"{LOOPBACK}:{page.port}"
    origin: Any = f"http://{host}" if own_origin else None
    url = f"ws://{host}/{read_page_token()}"
    with connect(url, subprotocols=[PROTOCOL], origin=origin, max_size=None) as connection:
        assert connection.recv(timeout=PATIENCE)


@pytest.mark.parametrize("path", ["/", "/" + "0" * 32])
def test_page_guard_refuses_websockets_without_the_token(page: BrowserPage, path: str) -> None:
    with (
        pytest.raises(InvalidStatus, match="403"),
        connect(f"ws://{LOOPBACK}:{page.port}{path}", subprotocols=[PROTOCOL]),
    ):
        pass


def test_page_guard_refuses_websockets_of_other_pages(page: BrowserPage) -> None:
    url = f"ws://{LOOPBACK}:{page.port}/{read_page_token()}"
    with (
        pytest.raises(InvalidStatus, match="403"),
        connect(url, subprotocols=[PROTOCOL], origin="http://evil.example"),  # type: ignore[arg-type]
    ):
        pass


def test_page_guard_reports_a_server_that_it_cannot_guard() -> None:
    with pytest.raises(Unprotected, match="viser"), PageGuard("x").install():
        pass
    assert page_guard.websocket_server.serve.__name__ == "serve"


def test_page_token_is_not_the_token_of_ports(page: BrowserPage) -> None:
    assert page.url == f"http://{LOOPBACK}:{page.port}/{read_page_token()}/"
    assert read_page_token() != read_token(user_folder())
    assert len(read_page_token()) == 32


def test_opened_in_browser_hides_the_url_from_other_users(
    page: BrowserPage, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    with open_browser.opened_in_browser(page.url, opens=True):
        (address,) = opened
        path = Path(address.removeprefix("file://"))
        assert read_page_token() not in address
        assert f"url={page.url}" in path.read_text()
        assert stat.S_IMODE(path.stat().st_mode) == 0o600
        assert path.parent == user_folder()
    assert not path.exists()
    with open_browser.opened_in_browser(page.url, opens=False):
        assert len(opened) == 1
