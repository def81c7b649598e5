"""Checks before the start of a deployment, and the places of their findings."""

from __future__ import annotations

import json
import socket
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.cli.rcdeploy.app import check
from robocomp_dsl.cli.rcdeploy.main import normalise_arguments
from robocomp_dsl.cli.rcdeploy.plan import as_text
from robocomp_dsl.deploy.checked_deployment import CheckedDeployment
from tests.deploy.generated_components import generate_components
from tests.deploy.rcdeploy_process import rcdeploy

APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    component arm { set serial = "abc"; ARM };
    component eye { after arm; EYE };
};
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two generated components and no deployment yet, the working folder of the test."""
    monkeypatch.chdir(tmp_path)
    generate_components(tmp_path)
    return tmp_path


def check_app(folder: Path, arm: str = "", eye: str = "", app: str = APP) -> CheckedDeployment:
    path = folder / "app.ddsl"
    path.write_text(app.replace("ARM", arm).replace("EYE", eye))
    return check(path, ())


def finding_lines(checked: CheckedDeployment, folder: Path) -> list[str]:
    lines = []
    for finding in checked.findings:
        path = finding.span.source.path.absolute().relative_to(folder)
        place = ":".join(map(str, finding.span.start_position))
        lines.append(f"{path}:{place} {finding.code.id} {finding.message}")
    return lines


def test_check_gives_plan_for_valid_deployment(folder: Path) -> None:
    checked = check_app(folder, "set rate = 20;")
    assert finding_lines(checked, folder) == []
    assert checked.plan
    assert [p.name for p in checked.plan.processes] == ["arm", "eye"]
    assert checked.plan.domain.startswith("app-")
    again = check_app(folder, "set rate = 20;").plan
    assert again
    assert again.domain != checked.plan.domain


def spoil_config(folder: Path) -> None:
    (folder / "own.yaml").write_text("rate: 5000\nserail: x\nmotors:\n  - id: 300\n")


def remove_main(folder: Path) -> None:
    (folder / "eye" / "main.py").unlink()


def remove_config(folder: Path) -> None:
    (folder / "arm" / "etc" / "config.yaml").unlink()


def empty_config(folder: Path) -> None:
    (folder / "arm" / "etc" / "config.yaml").write_text("")


def spoil_own_config(folder: Path) -> None:
    (folder / "arm" / "etc" / "config.yaml").write_text("x: 5\n")


def touch_generated(folder: Path) -> None:
    with (folder / "arm" / "arm_generated" / "params.py").open("a") as stream:
        stream.write("# changed\n")


def nothing(_: Path) -> None:
    pass


NO_ENTRY = (
    "app.ddsl:6:15 RC901 `motors` has 1 entries, there is no [2] (they count from 0) "
    "(`set motors[2].id=5` of `arm`)"
)
NO_SERIAL = "arm/etc/config.yaml:1:1 RC901 `serial` is not given and has no default (`arm`)"
NO_MAIN = (
    "app.ddsl:7:15 RC903 `eye`: component not generated: no main.py in the folder of eye/eye.cdsl"
)
CASES = [
    # what is done to the folder, `component arm`, `component eye`, the findings
    (spoil_config, 'config "own.yaml";', "", [
        "own.yaml:1:7 RC901 `rate` is 5000 Hz, its highest value is 1000 Hz (`arm`)",
        "own.yaml:2:1 RC901 unknown parameter `serail` (`arm`)",
        "own.yaml:4:9 RC901 `motors[0].id` is 300, its highest value is 127 (`arm`)",
    ]),
    (nothing, "set motors[0].id = 5; set motors[2].id = 5;", "", [NO_ENTRY]),
    (remove_config, "", "", []),
    (empty_config, "", "", []),
    (spoil_own_config, "", "", ["arm/etc/config.yaml:1:1 RC901 unknown parameter `x` (`arm`)"]),
    (remove_main, "", "", [NO_MAIN]),
    (nothing, 'executable "./arm --fast";', 'executable "no-such-program-anywhere main.py";', [
        "app.ddsl:6:15 RC902 `arm`: program not found: `./arm`",
        "app.ddsl:7:15 RC902 `eye`: program not found: `no-such-program-anywhere`",
    ]),
    (nothing, "", 'executable "python3 other.py";', [
        "app.ddsl:7:15 RC902 `eye`: no other.py in eye",
    ]),
    (touch_generated, "", "", [
        "app.ddsl:6:15 RC905 the generated code of `arm` is outdated",
    ]),
]  # fmt: skip


@pytest.mark.parametrize(("change", "arm", "eye", "expected"), CASES)
def test_check_reports_what_deployment_lacks(
    folder: Path, change: Callable[[Path], None], arm: str, eye: str, expected: list[str]
) -> None:
    change(folder)
    checked = check_app(folder, arm, eye)
    assert finding_lines(checked, folder) == expected
    assert checked.plan
    assert checked.ready == all("RC905" in line for line in expected)


@pytest.fixture
def share(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An installed folder with a context for `arm`; no folder of this computer is searched."""
    for name in ("CONFIG_HOME", "DATA_HOME", "CONFIG_DIRS", "DATA_DIRS"):
        monkeypatch.setenv(f"ROBOCOMP_{name}", str(folder / name))
    context = folder / "DATA_DIRS" / "contexts" / "lab"
    context.mkdir(parents=True)
    return context


def test_check_validates_config_found_in_context(folder: Path, share: Path) -> None:
    (share / "arm.yaml").write_text("rate: 5000\n")
    assert finding_lines(check_app(folder, 'context "lab";'), folder) == [
        "DATA_DIRS/contexts/lab/arm.yaml:1:7 RC901 `rate` is 5000 Hz, its highest value is 1000 Hz"
        " (`arm`)"
    ]
    own = folder / "DATA_HOME" / "contexts" / "lab"
    own.mkdir(parents=True)
    (own / "arm.yaml").write_text("rate: 500\n")
    assert finding_lines(check_app(folder, 'context "lab";'), folder) == []
    assert finding_lines(check_app(folder, 'context "other";'), folder) == []


def test_check_reports_config_not_found(folder: Path, share: Path) -> None:
    (share / "arm.yaml").write_text("rate: 500\n")
    checked = check_app(folder, 'context "lab"; from "amr.yaml";')
    message = "app.ddsl:6:15 RC901 configuration not found: `amr.yaml` (`arm`)"
    assert finding_lines(checked, folder) == [message]
    assert checked.findings[0].label == "did you mean `arm.yaml`?"
    assert f"{share}/amr.yaml (installed, contexts/lab): not found" in checked.findings[0].help
    assert finding_lines(check_app(folder, 'context "lab"; from "arm.yaml";'), folder) == []


def test_check_reports_missing_parameter_in_config_file(folder: Path) -> None:
    empty_config(folder)
    assert finding_lines(check_app(folder, app=APP.replace('set serial = "abc";', "")), folder) == [
        NO_SERIAL
    ]


def test_check_reports_port_in_use(folder: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        found = finding_lines(check_app(folder, f"port {port};"), folder)
    message = f"`arm`: port {port} cannot be used: Address already in use"
    assert found == [f"app.ddsl:6:15 RC904 {message}"]
    assert finding_lines(check_app(folder, f"port {port};"), folder) == []


def test_check_reports_all_findings_at_once(folder: Path) -> None:
    spoil_config(folder)
    remove_main(folder)
    found = finding_lines(check_app(folder, 'config "own.yaml";'), folder)
    assert [line.split()[1] for line in found] == ["RC903", "RC901", "RC901", "RC901"]


@pytest.mark.parametrize("content", [b"", b"\0\1\2", b"Deployment", b"\xff\xfe", b"{" * 100_000])
def test_check_reports_unreadable_deployment_file(folder: Path, content: bytes) -> None:
    (folder / "app.ddsl").write_bytes(content)
    checked = check(folder / "app.ddsl", ())
    assert checked.plan is None
    assert checked.findings


ORDERS = [
    ([], []),
    (["app.ddsl"], ["up", "app.ddsl"]),
    (["app.ddsl", "plan"], ["plan", "app.ddsl"]),
    (["app.ddsl", "status", "--format", "json"], ["status", "app.ddsl", "--format", "json"]),
    (["plan", "app.ddsl"], ["plan", "app.ddsl"]),
    (["--duration", "3", "app.ddsl"], ["up", "--duration", "3", "app.ddsl"]),
    (["app.ddsl", "--name", "stop"], ["up", "app.ddsl", "--name", "stop"]),
    (["status"], ["status"]),
    (["status", "app"], ["status", "app"]),
    (["--help"], ["--help"]),
    (["app.ddsl", "sttus"], ["sttus", "app.ddsl"]),
    (["app.ddsl", "stop", "arm"], ["stop", "app.ddsl", "arm"]),
    (["restart", "arm"], ["restart", "arm"]),
    (["app.ddsl", "param", "set", "arm", "x=1"], ["param", "set", "app.ddsl", "arm", "x=1"]),
    (["param", "app.ddsl", "list"], ["param", "list", "app.ddsl"]),
    (["param", "list", "app.ddsl"], ["param", "list", "app.ddsl"]),
    (["param", "app.ddsl"], ["param", "app.ddsl"]),
]


@pytest.mark.parametrize(("arguments", "expected"), ORDERS)
def test_normalise_arguments_accepts_file_before_command(
    arguments: list[str], expected: list[str]
) -> None:
    assert normalise_arguments(arguments) == expected


def test_rcdeploy_commands_print_and_exit_as_documented(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(folder))
    check_app(folder, 'env MODE = "a b";')
    shown = rcdeploy("app.ddsl", "plan")
    assert (shown.returncode, shown.stderr) == (0, "")
    assert "2. eye (eye) after arm\n" in shown.stdout
    assert (
        f"(cd {folder}/arm && MODE='a b' {sys.executable} main.py --name arm --domain"
        in shown.stdout
    )
    assert shown.stdout.endswith("stops: eye, then arm\n")
    data = json.loads(rcdeploy("plan", "app.ddsl", "--format", "json", "--domain", "d").stdout)
    assert data["domain"] == "d"
    assert data["processes"][1]["after"] == ["arm"]
    assert data["processes"][0]["env"] == {"MODE": "a b"}
    right = rcdeploy("check", "app.ddsl")
    assert (right.returncode, right.stdout) == (0, "app.ddsl: 2 components can be started\n")
    check_app(folder, 'executable "nothing";')
    wrong = rcdeploy("check", "app.ddsl", "--format", "json")
    assert wrong.returncode == 1
    assert [load["code"] for load in json.loads(wrong.stdout)] == ["RC902"]
    shown = rcdeploy("plan", "app.ddsl")
    assert shown.returncode == 1
    assert "program not found: `nothing`" in shown.stderr
    assert f"cd {folder}/arm && nothing --name arm" in shown.stdout
    started = rcdeploy("app.ddsl")
    assert started.returncode == 1
    assert "nothing was started (1 error)" in started.stderr
    for verb in ("status", "logs", "stop"):
        absent = rcdeploy("app.ddsl", verb)
        assert (absent.returncode, absent.stdout) == (1, "")
        assert absent.stderr.startswith("error: `app.ddsl` is not running")
    assert rcdeploy("stop").stderr == "error: no deployment is running\n"
    assert rcdeploy("missing.ddsl").returncode == 1
    assert rcdeploy("app.ddsl", "sttus").returncode == 2
    assert rcdeploy("--no-such-option").returncode == 2


PLACED = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    host robot { address "10.0.0.2"; };
    host desk { address "127.0.0.1"; };
    group left on WHERE { component arm { set serial = "abc"; }; export Laser from arm; };
    component eye on localhost { after left; };
};
"""


def test_check_leaves_remote_programs_to_their_host(folder: Path) -> None:
    app = PLACED.replace("WHERE", "robot").replace('"abc";', '"abc"; executable "no-such-program";')
    checked = check_app(folder, app=app)
    assert checked.ready
    assert checked.hosted
    assert checked.plan
    assert checked.plan.domain == "app"
    shown = "\n".join(as_text(checked.plan, hosted=checked.hosted))
    assert r"robocomp-app-left\x2darm.service: no-such-program" in shown


def test_check_accepts_groups_on_local_hosts(folder: Path) -> None:
    for where in ("desk", "localhost"):
        app = PLACED.replace("WHERE", where)
        checked = check_app(folder, app=app)
        assert {finding.code.id for finding in checked.findings} == {"RC573"}
        assert checked.plan is not None
        arm, eye = checked.plan.processes
        assert (arm.name, arm.group, eye.after) == ("left-arm", "left", ("left-arm",))
        assert arm.host == ("desk (127.0.0.1)" if where == "desk" else "localhost")
        shown = "\n".join(as_text(checked.plan))
        assert f"1. left-arm (arm) in group left on {arm.host}" in shown
        assert "2. eye (eye) on localhost after left-arm" in shown


def test_preflight_reports_cores_that_the_machine_does_not_have(folder: Path) -> None:
    checked = check_app(folder, "cores 1022-1023;", "realtime priority 1; cores 0;")
    (line,) = [line for line in finding_lines(checked, folder) if "1022" in line]
    assert line.startswith("app.ddsl:6:15 RC575 `arm`: the CPU cores 1022-1023 cannot be used")
    assert not checked.ready


CHOSEN = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    host robot { address "ROBOT"; labels gpu; };
    host desk { address "DESK"; labels gpu; };
    component arm on label gpu { set serial = "abc"; };
    component eye { place by load on robot, desk; };
    connect eye.Laser -> arm.Laser over OVER;
};
"""


def test_check_places_components_on_this_machine(folder: Path) -> None:
    app = CHOSEN.replace("ROBOT", "localhost").replace("DESK", "127.0.0.1")
    checked = check_app(folder, app=app.replace("OVER", "local"))
    assert finding_lines(checked, folder) == []
    assert checked.plan is not None
    assert {process.host for process in checked.plan.processes} == {"robot (localhost)"}
    assert checked.ready
    assert not checked.hosted


def test_plan_leaves_other_hosts_to_the_start(folder: Path) -> None:
    app = CHOSEN.replace("ROBOT", "10.0.0.2").replace("DESK", "10.0.0.3")
    checked = check_app(folder, app=app.replace("OVER", "zenoh"))
    assert finding_lines(checked, folder) == []
    assert checked.plan is not None
    assert checked.hosted
    shown = "\n".join(as_text(checked.plan))
    assert "1. arm (arm) on label gpu (robot, desk), placed when started" in shown
    assert "1. eye (eye) by load on robot, desk, placed when started" in shown
