"""`rcdeploy list`, `echo`, `hz`, `bw`, `call`, `pub`, `stats`, `loglevel` and `period`."""

from __future__ import annotations

import csv
import io
import json
import logging
import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator

import pytest
import yaml
from click.testing import CliRunner, Result

from robocomp_dsl.cli.program import CliError
from robocomp_dsl.cli.rcdeploy.main import program
from tests.deploy.inspected_component import ARM, InspectedArm, Mode, run_inspected_arm
from tests.deploy.rcdeploy_process import PROGRAM, runtime_folder
from tests.support.waiting import wait_until

DOMAIN = "inspected"


@pytest.fixture(scope="module")
def arm() -> Iterator[InspectedArm]:
    with (
        pytest.MonkeyPatch.context() as patch,
        runtime_folder(patch),
        run_inspected_arm(DOMAIN) as worker,
    ):
        yield worker


def run(*words: str, code: int = 0) -> str:
    """The output of a command that ends with `code`; the message of a `CliError`."""
    result: Result = CliRunner().invoke(program, [*words, "--domain", DOMAIN])
    if isinstance(result.exception, CliError):
        assert result.exception.code == code
        return result.output + str(result.exception)
    assert result.exit_code == code, result.output + repr(result.exception)
    return result.output


def test_list_shows_ports_with_operations(arm: InspectedArm) -> None:
    lines = [line.split() for line in run("list").splitlines()]
    assert lines[0] == ["PORT", "ROLE", "INTERFACE", "OPERATIONS"]
    assert lines[1][:4] == ["arm.Arm", "implements", "Test::Arm", "move,"]
    assert ["arm.Goal", "subscribesTo", "Test::Feed", "pose"] in lines
    details = run("list", "arm.Arm")
    assert "[query] Pose move(Point to, float speed, Mode mode)" in details
    assert "[query] void reject(string reason) throws Rejected" in details
    assert "    double x\n" in details
    assert "    Moving = 1\n" in details
    data = json.loads(run("list", "arm", "--json"))[0]
    names = [port["name"] for port in data["ports"]]
    assert names == ["Arm", "Feed", "Events", "Goal", "Component"]
    assert "nobody" in run("list", "nobody", code=1)


def test_echo_prints_yaml_json_and_csv(arm: InspectedArm) -> None:
    message = yaml.safe_load(run("echo", "arm.Feed", "--once"))
    assert message.pop("serial") > 0
    assert message == {
        "name": "left arm",
        "mode": "Moving",
        "points": [{"x": 1.0, "y": 2.0}, {"x": float("inf"), "y": 0.1}],
        "ranges": [0.1, 0.1, 0.1],
        "limits": {"a": 1},
        "is_valid": True,
    }
    documents = list(yaml.safe_load_all(run("echo", "arm.Feed.pose", "-n", "2")))
    assert documents[1]["serial"] > documents[0]["serial"]
    line = json.loads(run("echo", "arm.Feed", "--json", "--once"))
    assert line["points"][1] == {"x": None, "y": 0.1}
    rows = list(csv.DictReader(io.StringIO(run("echo", "arm.Feed", "--csv", "-n", "2"))))
    assert len(rows) == 2
    cells = [rows[0][name] for name in ("points[0].y", "limits.a", "is_valid")]
    assert cells == ["2.0", "1", "true"]
    assert float(rows[0]["time"]) <= float(rows[1]["time"])


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("name", "left arm"),
        ("points[0].x", 1.0),
        ("points[-1]", {"x": float("inf"), "y": 0.1}),
        ("ranges[2]", 0.1),
        ("ranges[7]", None),
        ("limits[a]", 1),
        ("limits[b]", None),
        ("pose.mode", "Moving"),
    ],
)
def test_echo_selects_field(arm: InspectedArm, field: str, value: object) -> None:
    assert yaml.safe_load(run("echo", f"arm.Feed.{field}", "--once")) == value


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ("arm.Feed.nme", "column 10: there is no field `nme`; did you mean `name`?"),
        ("arm.Feed.points.x", "column 17: sequence<Point> has no fields; select an element"),
        ("arm.Feed.name[0]", "column 15: string has no elements"),
        ("arm.Feed.points[a]", "column 17: an index is a whole number"),
        ("arm.Feed.points[0", "column 16: write fields as in"),
        ("arm.Fed", "`arm` has no published port `Fed`; did you mean `Feed`?"),
        ("arm.Arm", "the port `arm.Arm` is implemented; this command takes published ports"),
        ("arm", "which port of `arm`? published ports: arm.Feed, arm.Events"),
    ],
)
def test_echo_locates_mistake(arm: InspectedArm, target: str, message: str) -> None:
    assert message in run("echo", target, "--once", code=1)


def test_echo_wants_operation_before_field_of_many_operations(arm: InspectedArm) -> None:
    assert "operations started, ended" in run("echo", "arm.Events.who", code=2)


def test_hz_and_bw_measure_feed(arm: InspectedArm) -> None:
    figures = json.loads(run("hz", "arm.Feed", "--once", "--json"))
    assert figures["messages"] > 1
    assert figures["min_ms"] <= 1000 / figures["hz"] <= figures["max_ms"]
    assert figures["lost"] == 0
    figures = json.loads(run("bw", "arm.Feed", "--once", "--json"))
    assert figures["mean_bytes"] == pytest.approx(97, rel=0.05)
    assert " messages/s  mean " in run("bw", "arm.Feed", "--once")


def test_call_prints_result(arm: InspectedArm) -> None:
    result = yaml.safe_load(run("call", "arm.Arm.move", "{x: 1, y: 0.1}", "-1e3", "Moving"))
    assert (result["name"], result["mode"]) == ("1.0 0.10000000149011612 -1000.0", "Moving")
    assert run("call", "arm.Arm.flag", "yes", "[1, 0xff]") == '"True [1, 255]"\n'
    assert run("call", "arm.Arm.limits", "{Moving: -3}", "--json") == '{"Moving": -3}\n'
    assert run("call", "arm.Arm.halt") == ""
    assert arm.halted.wait(30)
    assert yaml.safe_load(run("call", "arm.Component.getInfo"))["name"] == "arm"


@pytest.mark.parametrize(
    ("operation", "words", "message"),
    [
        ("move", ["{x: 1, y: fast}", "1", "Idle"], "argument 1 (`to`), column 11: `fast` is not"),
        ("move", ["{x: 1, z: 2}", "1", "Idle"], "column 8: Point has no field `z`; it has x, y"),
        ("move", ["{x: 1, x: 2}", "1", "Idle"], "column 8: the field `x` is given twice"),
        ("move", ["[1, 2]", "1", "Idle"], "a list is not a mapping"),
        ("move", ["{x: 1,\n y: [}", "1", "Idle"], "line 2, column 6: this is not YAML"),
        ("move", ["{}", "1e39", "Idle"], "argument 2 (`speed`), column 1: 1e39 does not fit"),
        ("move", ["{}", "1", "Idel"], "Mode has no value `Idel`; did you mean `Idle`?"),
        ("move", ["{}", "", "Idle"], "there is no value"),
        ("move", ["{}"], "takes 3 arguments, and 1 is given; write rcdeploy call arm.Arm.move"),
        ("flag", ["maybe", "[]"], "`maybe` is neither true nor false"),
        ("flag", ["true", "[1, 256]"], "column 5: 256 is out of range: 0 to 255"),
        ("flag", ["true", "[" * 3000], "argument 2 (`bytes`)"),
        ("limits", ["{Idle: 1, Idle: 2}"], "column 11: the key `Idle` is given twice"),
        ("limits", ["{Idle: " + "9" * 5000 + "}"], "`" + "9" * 60 + "` is not a whole number"),
    ],
)
def test_call_locates_mistake_in_argument(
    arm: InspectedArm, operation: str, words: list[str], message: str
) -> None:
    output = run("call", f"arm.Arm.{operation}", *words, code=2)
    assert message in output
    if "argument" in message or "column" in message:
        assert "such as" in output or "write rcdeploy call" in output


def test_call_reports_failures_of_component(arm: InspectedArm) -> None:
    output = run("call", "arm.Arm.reject", "too hot", code=1)
    assert output == '`arm.Arm.reject` raised Rejected {"reason": "too hot"}'
    assert "did you mean `move`?" in run("call", "arm.Arm.mvoe", code=1)
    assert "needs an operation; it has move, reject" in run("call", "arm.Arm", code=1)


def test_pub_reaches_subscribing_port(arm: InspectedArm) -> None:
    arm.received.clear()
    run("pub", "arm.Goal", "{serial: 7, name: goal, mode: 1}", "-n", "3", "--rate", "500")
    wait_until(lambda: len(arm.received) == 3, "the poses were received")
    assert (arm.received[0].serial, arm.received[0].mode) == (7, Mode.Moving)
    run("pub", "arm.Feed", "{serial: 8}")
    wait_until(lambda: arm.received[-1].serial == 8, "the pose was received")
    assert "nobody subscribes to Test::Events" in run("pub", "arm.Events.ended", code=1)
    assert "There are started, ended" in run("pub", "arm.Events", code=2)


def test_stats_loglevel_and_period(arm: InspectedArm) -> None:
    data = json.loads(run("stats", "--json"))
    feed = next(o for o in data["arm"]["operations"] if o["port"] == "Feed")
    assert feed["calls"] > 0
    assert "LOST" in run("stats", "arm")
    root = logging.getLogger()
    level = root.level
    assert run("loglevel", "arm", "error") == "arm: log level error\n"
    run("loglevel", "arm", "info")
    root.setLevel(level)
    assert run("period", "arm", "6") == "arm: every 6 ms\n"
    assert json.loads(run("stats", "arm", "--json"))["arm"]["period"] == 6
    run("period", "arm", "5")


def test_inspect_commands_report_absent_deployment(arm: InspectedArm) -> None:
    for words in (["list"], ["echo", "a.B"], ["call", "a.B.c"], ["stats"], ["period", "a", "1"]):
        result = CliRunner().invoke(program, words)
        assert isinstance(result.exception, CliError)
        assert str(result.exception) == "no deployment is running"
    result = CliRunner().invoke(program, ["list", "-d", "x", "--domain", "y"])
    assert "use --deployment or --domain, not both" in result.output


def start(*words: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM, *words, "--domain", DOMAIN],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def assert_quiet(errors: bytes) -> None:
    """Nothing but losses, which a busy machine may cause, was reported."""
    assert [line for line in errors.splitlines() if b"lost" not in line] == []


def test_echo_ends_quietly_at_ctrl_c_and_broken_pipe(arm: InspectedArm) -> None:
    interrupted, broken = start("echo", "arm.Feed"), start("hz", "arm.Feed")
    try:
        for process in (interrupted, broken):
            assert process.stdout is not None
            assert select.select([process.stdout], [], [], 60)[0]
            process.stdout.read1(10)  # type: ignore[attr-defined]
        interrupted.send_signal(signal.SIGINT)
        assert_quiet(interrupted.communicate(timeout=60)[1])
        assert interrupted.returncode == 130
        assert broken.stdout is not None
        broken.stdout.close()
        assert broken.stderr is not None
        assert_quiet(broken.stderr.read())
        assert broken.wait(60) == 141
    finally:
        for process in (interrupted, broken):
            process.kill()
            process.wait()


SHELL_WORDS = {
    "bash": ({"COMP_WORDS": "rcdeploy echo --domain inspected {}", "COMP_CWORD": "4"}, "plain,{}"),
    "zsh": ({"COMP_WORDS": "rcdeploy echo --domain inspected {}", "COMP_CWORD": "4"}, "{}"),
    "fish": ({"COMP_WORDS": "rcdeploy echo --domain inspected", "COMP_CWORD": "{}"}, "plain,{}"),
}


@pytest.mark.parametrize("shell", SHELL_WORDS)
def test_shells_complete_fields(arm: InspectedArm, shell: str) -> None:
    variables, line = SHELL_WORDS[shell]
    typed = {key: text.format("arm.Feed.po") for key, text in variables.items()}
    done = subprocess.run(
        [sys.executable, "-c", "import sys; sys.argv[0] = 'rcdeploy'; " + PROGRAM],
        env={**os.environ, **typed, "_RCDEPLOY_COMPLETE": f"{shell}_complete"},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.stderr == ""
    assert line.format("arm.Feed.points") in done.stdout.splitlines()
    script = CliRunner().invoke(program, ["completion", shell]).output
    assert f"_RCDEPLOY_COMPLETE={shell}_complete" in script


@pytest.mark.parametrize(
    ("command", "incomplete", "words"),
    [
        ("echo", "a", ["arm.Feed", "arm.Events"]),
        ("echo", "arm.E", ["arm.Events", "arm.Events.started", "arm.Events.ended"]),
        ("echo", "arm.Feed.m", ["arm.Feed.mode"]),
        ("call", "arm.Arm.", [f"arm.Arm.{operation.name}" for operation in ARM.operations]),
        ("call", "arm.C", ["arm.Component", "arm.Component.getInfo"]),
        ("pub", "arm.G", ["arm.Goal", "arm.Goal.pose"]),
        ("list", "arm.A", ["arm.Arm"]),
        ("stats", "a", ["arm"]),
        ("hz", "nobody.", []),
    ],
)
def test_completion_offers_ports_operations_and_fields(
    arm: InspectedArm, command: str, incomplete: str, words: list[str]
) -> None:
    from click.shell_completion import ShellComplete  # noqa: PLC0415 - only here

    complete = ShellComplete(program, {}, "rcdeploy", "_RCDEPLOY_COMPLETE")
    items = complete.get_completions([command, "--domain", DOMAIN], incomplete)
    offered = [item.value for item in items]
    assert offered[: len(words)] == words
    assert bool(offered) == bool(words)
