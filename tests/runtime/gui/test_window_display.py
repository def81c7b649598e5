"""A window on a real X server, which a program clicks: `install.sh` installs both."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.runtime.gui.test_window_program import DEADLINE_S, FORM, PROGRAM
from tests.support.waiting import wait_until

pytestmark = pytest.mark.skipif(
    not (shutil.which("Xvfb") and shutil.which("xdotool")) and not os.environ.get("CI"),
    reason="Xvfb and xdotool are not installed",
)


@pytest.fixture
def display() -> Iterator[str]:
    """The display of an X server without a screen."""
    read_end, write_end = os.pipe()
    command = [
        "Xvfb",
        "-displayfd",
        str(write_end),
        "-screen",
        "0",
        "400x300x24",
        "-nolisten",
        "tcp",
        "-noreset",  # otherwise it restarts whenever its last client has gone
    ]
    with subprocess.Popen(command, pass_fds=[write_end], stderr=subprocess.DEVNULL) as server:
        os.close(write_end)
        with os.fdopen(read_end) as stream:
            number = stream.readline().strip()
        assert number
        yield f":{number}"
        server.terminate()


def test_window_on_display_receives_clicks_and_is_closed(display: str, tmp_path: Path) -> None:
    (tmp_path / "mainUI.ui").write_text(FORM.read_text())
    code = PROGRAM.replace("ON_CLICK", 'self.log.info("clicked"); self.close()')
    code = code.replace("WATCHDOG", "0").replace("QtCore.QTimer.singleShot", "len")
    code = code.replace("len(0, self.ui.pushButton.click)", 'self.log.info("shown")')
    (tmp_path / "program.py").write_text(code)
    environment = {**os.environ, "DISPLAY": display, "QT_QPA_PLATFORM": "xcb"}
    with subprocess.Popen(
        [sys.executable, "program.py", "--domain", f"test-{uuid.uuid4().hex[:8]}"],
        cwd=tmp_path,
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:

            def window() -> str:
                command = ["xdotool", "search", "--name", "^counter$"]
                found = subprocess.run(
                    command, env=environment, capture_output=True, text=True, check=False
                )
                return found.stdout.strip()

            wait_until(lambda: window() or process.poll() is not None, timeout=DEADLINE_S)
            handle = window()
            assert handle, process.communicate()[1]
            click = ["xdotool", "mousemove", "--window", handle, "30", "20", "click", "1"]
            wait_until(
                lambda: (
                    subprocess.run(click, env=environment, check=False).returncode
                    or process.poll() is not None
                )
            )
            _, err = process.communicate(timeout=DEADLINE_S)
        finally:
            process.kill()
    assert process.returncode == 0, err
    assert "clicked" in err
    assert "finalized" in err
