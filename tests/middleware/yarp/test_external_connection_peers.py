"""`rcdeploy` connects programs of a real YARP 3.5, as a migrated application describes them."""

from __future__ import annotations

import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.write import write
from robocomp_dsl.migrate.yarp.migration import plan_yarp_files
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient, NameServerLost
from tests.deploy.rcdeploy_process import start_rcdeploy
from tests.middleware.yarp.conftest import LOOPBACK
from tests.middleware.yarp.yarp_tools import Tools, binary, free_port, needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_yarp]
APPLICATION = """\
<application>
    <name>Relay</name>
    <module>
        <name>{yarp}</name><parameters>read /in</parameters><prefix>/left</prefix>
        <dependencies><port timeout="100">/out</port></dependencies>
    </module>
    <connection>
        <from external="true">/out</from><to external="true">/left/in</to>
        <protocol>{carrier}</protocol>
    </connection>
</application>
"""


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Tools]:
    """YARP's programs and its name server, which `rcdeploy` finds, too."""
    opened = Tools(tmp_path, free_port())
    monkeypatch.setenv("YARP_CONFIG_HOME", str(tmp_path))
    monkeypatch.delenv("YARP_NAMESPACE", raising=False)
    opened.start_name_server()
    names = NameClient((LOOPBACK, opened.number))
    wait_until(lambda: names.query("/root"), ignoring=NameServerLost)
    yield opened
    opened.close()


@pytest.mark.parametrize("carrier", ["", "tcp", "fast_tcp", "udp", "text"])
def test_migrated_application_connects_programs_of_yarp(
    tools: Tools, tmp_path: Path, carrier: str
) -> None:
    (tmp_path / "relay.xml").write_text(APPLICATION.format(yarp=binary("yarp"), carrier=carrier))
    plan = plan_yarp_files([tmp_path / "relay.xml"], tmp_path, Report())
    write(tmp_path, plan.files)
    name = f"relay-{uuid.uuid4().hex[:8]}"
    with start_rcdeploy("up", str(tmp_path / "relay.ddsl"), "--name", name, "--no-table") as app:
        app.until("yarp is ready")
        writer = tools.start("write", "/out")
        app.until("connected /out -> /left/in")
        assert writer.stdin is not None
        writer.stdin.write("hello 3\n")
        writer.stdin.flush()
        app.until("hello 3")
        app.process.terminate()
        assert app.end() == 0, app.lines
    assert "no connection" not in tools.run("ping", "/out").stdout
    assert "/left/in" not in tools.run("ping", "/out").stdout


def test_external_connection_of_yarp_is_made_again_after_the_writer_restarts(
    tools: Tools, tmp_path: Path
) -> None:
    (tmp_path / "relay.xml").write_text(APPLICATION.format(yarp=binary("yarp"), carrier="tcp"))
    plan = plan_yarp_files([tmp_path / "relay.xml"], tmp_path, Report())
    write(tmp_path, plan.files)
    name = f"relay-{uuid.uuid4().hex[:8]}"
    writer = tools.start("write", "/out")
    with start_rcdeploy("up", str(tmp_path / "relay.ddsl"), "--name", name, "--no-table") as app:
        app.until("connected /out -> /left/in")
        writer.kill()
        app.until("lost /out -> /left/in")
        writer = tools.start("write", "/out")
        app.until("connected /out -> /left/in")
        assert writer.stdin is not None
        writer.stdin.write("again 4\n")
        writer.stdin.flush()
        app.until("again 4")
        app.process.terminate()
        assert app.end() == 0, app.lines
