"""The first process of a container: readiness, hangs, signals; and a deployment that it runs."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
import yaml

from tests.deploy.export.conftest import Export
from tests.deploy.laser_app import ARM, EYE
from tests.deploy.network.secured_deployment import free_ports
from tests.deploy.rcdeploy_process import RunningProcess
from tests.support.waiting import wait_until

INIT = (sys.executable, "-m", "robocomp_dsl.deploy.container.init")
NOTIFY = """
import os, signal, socket, sys, time
def tell(text):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sender:
        sender.sendto(text.encode(), os.environ["NOTIFY_SOCKET"])
"""


@contextmanager
def start_init(tmp_path: Path, body: str, *options: str) -> Iterator[RunningProcess]:
    script = tmp_path / "program.py"
    script.write_text(NOTIFY + textwrap.dedent(body))
    command = [*INIT, "--state", str(tmp_path), *options, "--", sys.executable, str(script)]
    with RunningProcess(*command) as process:
        try:
            yield process
        finally:
            if process.process.poll() is None:
                process.process.terminate()
                process.end()


@pytest.mark.parametrize(
    ("body", "options"),
    [
        ("tell('READY=1')", ()),
        ("print('all good', flush=True)", ("--ready-log", "^all")),
        ("", ("--ready-after", "0.05")),
    ],
)
def test_init_shows_readiness(tmp_path: Path, body: str, options: tuple[str, ...]) -> None:
    with start_init(tmp_path, f"{body}\nsignal.sigwait([signal.SIGTERM])", *options) as init:
        wait_until((tmp_path / "ready").exists, "the program is ready")
        assert (tmp_path / "alive").exists()
        init.process.send_signal(signal.SIGTERM)
        assert init.end() == 128 + signal.SIGTERM
    assert not (tmp_path / "ready").exists()
    assert not (tmp_path / "alive").exists()


def test_init_shows_readiness_of_a_port(tmp_path: Path) -> None:
    (port,) = free_ports(1)
    body = f"server = socket.create_server(('127.0.0.1', {port}))\nserver.accept()\nsys.exit(3)"
    with start_init(tmp_path, body, "--ready-port", str(port)) as init:
        assert init.end() == 3


def test_init_ends_hung_program(tmp_path: Path) -> None:
    body = """
        signal.signal(signal.SIGTERM, lambda *_: (print("ends", flush=True), os._exit(0)))
        tell("READY=1\\nWATCHDOG=1")
        while True: time.sleep(1)
    """
    with start_init(tmp_path, body, "--watchdog", "0.2") as init:
        assert init.end() == 124
        assert init.has("hangs: no WATCHDOG=1 within 0.3 s")
        assert init.has("ends")


def test_init_reports_missing_program(tmp_path: Path) -> None:
    done = subprocess.run(
        [*INIT, "--state", str(tmp_path), "--", "./nothing"], capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.returncode == 127
    assert "./nothing cannot be started" in done.stderr


def test_init_runs_exported_deployment(
    export: Export, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Router and components with the settings, keys and command lines of the compose file."""
    for name, body in (("arm", ARM), ("eye", EYE)):
        path = tmp_path / name / "specificworker.py"
        head = f"import os\nfrom {name}_generated.genericworker import GenericWorker\n"
        path.write_text(f"{head}from {name}_generated.interfaces import *\n{body}")
    (tmp_path / "app.ddsl").write_text(
        'import "arm/arm.cdsl";\nimport "eye/eye.cdsl";\n'
        "Deployment app { component arm { prefix left; set serial = a; };"
        " component eye { prefix left; }; };\n"
    )
    result = export("compose", "--keys")
    assert result.exit_code == 0, result.output
    (port,) = free_ports(1)
    monkeypatch.setenv("ROBOCOMP_KEYS", str(tmp_path / "config/robocomp/keys/app.compose"))
    with ExitStack() as stack:
        for service in ("router", "left-arm", "left-eye"):
            process = start_service(tmp_path, service, port)
            running = stack.enter_context(process)
            stack.callback(process.end)
            # Not killed: nothing would end its program, as the end of a container does.
            stack.callback(process.process.terminate)
            state = tmp_path / f"state-{service}"
            wait_until((state / "ready").exists, f"{service} is ready")
        running.until("eye sees a new arm")


def start_service(tmp_path: Path, name: str, port: int) -> RunningProcess:
    """Start the process of a service as its container would, with another port and folders."""
    build, state = tmp_path / "build", tmp_path / f"state-{name}"
    source = tmp_path / f"network-{name}"
    state.mkdir()
    source.mkdir()
    data = yaml.safe_load((build / "compose.yaml").read_text())
    service = data["services"][name]
    keys = tmp_path / "config/robocomp/keys/app.compose"
    for mount in service["secrets"]:
        file = Path(data["secrets"][mount["source"]]["file"]).name
        (source / Path(mount["target"]).name).write_bytes((keys / file).read_bytes())
    settings = (build / f"network/{name}.json").read_text().replace(":7447", f":{port}")
    assert json.loads(settings)["ca"] == "ca.pem"
    (source / "network.json").write_text(settings)
    words = [
        word.replace("/run/secrets/robocomp", str(source))
        .replace("/run/robocomp", str(state))
        .replace("/opt/robocomp/content", str(build / "content"))
        for word in service["command"]
    ]
    words = [sys.executable if word == "python3" else word for word in words]
    at = words.index("--network")
    words[at:at] = ["--state", str(state)]
    folder = service.get("working_dir", "/").replace(
        "/opt/robocomp/content", str(build / "content")
    )
    return RunningProcess(*words, where=Path(folder))
