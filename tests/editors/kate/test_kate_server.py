"""A real Kate with the configuration that we ship: it starts the server and receives findings.

Kate cannot be scripted, so a wrapper records the messages between Kate and the server.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.support.real_editor import DEADLINE_S, EDITORS, Project, need
from tests.support.samples import MISTAKES, Mistake
from tests.support.waiting import wait_until

pytestmark = pytest.mark.editors

RECORDING = """#!/bin/sh
echo $$ >> '{pids}'
tee '{requests}' | '{python}' -m robocomp_dsl.cli.rcgen "$@" | tee '{responses}'
"""
ALLOWED = """[lspclient]
AllowedServerCommandLines={server} lsp
[Kate Plugins]
lspclientplugin=true
kateprojectplugin=true
"""
_HEAD = re.compile(
    rb"(?:[\w-]+: [^\r\n]*\r\n)*Content-Length: (\d+)\r\n(?:[\w-]+: [^\r\n]*\r\n)*\r\n"
)


def messages(file: Path) -> Iterator[dict[str, Any]]:
    """The complete messages so far."""
    data = file.read_bytes() if file.exists() else b""
    at = 0
    while head := _HEAD.match(data, at):
        at = head.end() + int(head[1])
        if at > len(data):
            return
        yield json.loads(data[head.end() : at])


def configure(home: Path, server: Path) -> dict[str, str]:
    """Configure Kate in the folder `home` as a user does; returns the environment."""
    settings = home / ".config" / "kate" / "lspclient" / "settings.json"
    settings.parent.mkdir(parents=True)
    shutil.copy(EDITORS / "kate" / "lspclient.json", settings)
    (home / ".config" / "katerc").write_text(ALLOWED.format(server=server))
    colours = home / ".local" / "share" / "org.kde.syntax-highlighting" / "syntax"
    shutil.copytree(EDITORS / "kate" / "syntax", colours)
    (home / "run").mkdir(mode=0o700)
    return {
        **os.environ,
        "PATH": "/usr/bin:/bin",  # a server found there would go before the project's
        "HOME": str(home),
        "XDG_CONFIG_HOME": str(home / ".config"),
        "XDG_DATA_HOME": str(home / ".local" / "share"),
        "XDG_CACHE_HOME": str(home / ".cache"),
        "XDG_RUNTIME_DIR": str(home / "run"),
        "QT_QPA_PLATFORM": "offscreen",
    }


@pytest.mark.parametrize(
    "mistake", [item for item in MISTAKES if "xml" not in item.file], ids=lambda item: item.file
)
def test_kate_receives_findings(mistake: Mistake, tmp_path: Path) -> None:
    kate, bus = need("kate"), need("dbus-run-session")
    (tmp_path / "project").mkdir()
    project = Project(tmp_path / "project")
    project.path(".kateproject").write_text('{"name": "robot"}')
    requests, responses = tmp_path / "requests", tmp_path / "responses"
    server = project.path(".venv/bin/rcgen")
    server.write_text(
        RECORDING.format(
            pids=project.pids, requests=requests, responses=responses, python=sys.executable
        )
    )
    process = subprocess.Popen(
        [bus, "--", kate, "--new", "--block", project.path(mistake.file)],
        cwd=project.folder,
        env=configure(tmp_path / "home", server),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        (finding,) = findings(responses, process)
    finally:
        with suppress(ProcessLookupError):  # Kate itself would ask what to do with the session
            os.killpg(process.pid, signal.SIGKILL)
        process.wait(DEADLINE_S)
    assert finding["range"]["start"] == {"line": mistake.line, "character": mistake.column}
    assert mistake.message in finding["message"]
    opened = next(
        message for message in messages(requests) if message.get("method") == "textDocument/didOpen"
    )
    assert opened["params"]["textDocument"]["languageId"] == mistake.file.partition(".")[2]
    assert not [message for message in messages(responses) if "error" in message]
    project.assert_no_server_left()


def findings(responses: Path, process: subprocess.Popen[bytes]) -> list[dict[str, Any]]:
    """The first findings that the server sent to Kate."""

    def published() -> list[dict[str, Any]]:
        assert process.poll() is None, f"Kate ended with {process.returncode}"
        return [
            message
            for message in messages(responses)
            if message.get("method") == "textDocument/publishDiagnostics"
        ]

    message = wait_until(published, "Kate received no findings", DEADLINE_S)[0]
    diagnostics: list[dict[str, Any]] = message["params"]["diagnostics"]
    return diagnostics
