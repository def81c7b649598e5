"""`rcdeploy connections`, `connect`, `disconnect`, `remap` and `qos`."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest
from click.testing import CliRunner, Result

from robocomp_dsl.cli.program import CliError
from robocomp_dsl.cli.rcdeploy.main import program
from tests.deploy.rcdeploy_process import runtime_folder
from tests.runtime.test_component_connections import Deployment
from tests.support.waiting import wait_until


@pytest.fixture(scope="module")
def deployment() -> Iterator[Deployment]:
    with pytest.MonkeyPatch.context() as patch, runtime_folder(patch):
        opened = Deployment("zenoh")
        yield opened
        opened.close()


@pytest.fixture(autouse=True)
def connected_to_a(deployment: Deployment) -> Iterator[None]:
    """Every test finds and leaves the sink connected to `a` only."""
    wait_until(lambda: deployment.sink.received)
    yield
    sink = deployment.sink_connections
    if ("News", "b.News") in deployment.list("sink"):
        sink.disconnect("News", "/b.News")


def run(deployment: Deployment, *words: str, code: int = 0) -> str:
    """The output of a command that ends with `code`; the message of a `CliError`."""
    result: Result = CliRunner().invoke(program, [*words, "--domain", deployment.domain])
    if isinstance(result.exception, CliError):
        assert result.exception.code == code, result.exception
        return result.output + str(result.exception)
    assert result.exit_code == code, result.output + repr(result.exception)
    return result.output


def test_connections_lists_states_and_quality_of_service(deployment: Deployment) -> None:
    lines = [line.split() for line in run(deployment, "connections").splitlines()]
    assert lines[0][:5] == ["PORT", "ROLE", "PEER", "OVER", "STATE"]
    rows = {(line[0], line[2]): line for line in lines[1:]}
    assert rows["sink.News", "a.News"][3:6] == ["zenoh", "connected", "-"]
    assert rows["b.News", "any"][4] == "waiting"
    data = json.loads(run(deployment, "connections", "sink", "--json"))
    assert {row["component"] for row in data} == {"sink"}
    assert {row["port"] for row in data} == {"News", "Probe"}


def test_connect_and_disconnect_in_both_orders(deployment: Deployment) -> None:
    output = run(deployment, "connect", "b.News", "sink.News")
    assert "b.News -> sink.News: connected" in output
    assert "until sink ends" in output
    assert "connect b.News -> sink.News;" in output
    wait_until(lambda: deployment.sink.sources() == {"a", "b"})
    output = run(deployment, "disconnect", "sink.News", "b.News")
    assert "b.News -> sink.News: disconnected until sink ends" in output
    wait_until(lambda: deployment.sink.sources() == {"a"})


def test_qos_changes_the_ends_that_it_concerns(deployment: Deployment) -> None:
    output = run(deployment, "qos", "a.News", "sink.News", "priority=high", "depth=9")
    assert "sink.News with a.News: depth=9" in output
    assert "a.News with sink.News: priority=high" in output
    assert "write it into the deployment" in output

    def qos() -> dict[tuple[str, str], str]:
        listed = json.loads(run(deployment, "connections", "--json"))
        return {(row["component"], row["peer"]): row["qos"] for row in listed}

    changed = {("sink", "a.News"): "depth=9", ("a", "sink.News"): "priority=high"}
    # A busy component may not answer in time: its rows are missing then.
    wait_until(lambda: changed.items() <= qos().items(), "both ends show the change")
    output = run(deployment, "qos", "a.News", "sink.News", "priority=off", "depth=off")
    assert "the defaults" in output


def test_qos_of_a_port(deployment: Deployment) -> None:
    assert "sink.News: depth=4" in run(deployment, "qos", "sink.News", "depth=4")
    assert "sink.News: the defaults" in run(deployment, "qos", "sink.News", "depth=off")


def test_remap_renames_and_names_back(deployment: Deployment) -> None:
    assert "b.Probe: named Second" in run(deployment, "remap", "b.Probe", "Second")
    assert "b.Second: named Probe" in run(deployment, "remap", "b.Second", "Probe")


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (("connect", "a.Nws", "sink.News"), 1, "did you mean `News`"),
        (("connect", "a.News", "sink.News"), 1, "connected to `a` already"),
        (("connect", "a.News", "b.News"), 1, "`a.News` is published, `b.News` is published"),
        (("connect", "a.News", "sink.Probe"), 1, "`a.News` is Test::News, and `sink.Probe` is"),
        (("connect", "a", "b"), 1, "no two of these ports fit"),
        (("connect", "b", "sink"), 1, "which connection? Name both ports"),
        (("connect", "b.News", "sink.News", "--over", "pigeon"), 1, "no middleware `pigeon`"),
        (
            ("connect", "b.News", "sink.News", "--over", "local"),
            1,
            "`b.News` is on `zenoh`, so `News` cannot be connected to it over `local`;"
            " `--over zenoh`",
        ),
        (("connect", "a.News", "x@zenoh:abc"), 1, "no required or subscribed port"),
        (("disconnect", "b.News", "sink.News"), 1, "not connected to `b.News`"),
        (("disconnect", "sink.News", "nobody.News"), 1, "not connected to `nobody.News`"),
        (("remap", "a", "x"), 1, "which port of `a`"),
        (("remap", "a.Probe", "1"), 1, "not a remap"),
        (("qos", "a.News", "sink.News", "priority=urgent"), 2, "`priority=urgent`"),
        (("qos", "a.News"), 2, "one or two ports and then items"),
        (("qos", "sink.Probe", "a.Probe", "deadline=5"), 1, "which only topics have"),
        (("qos", "b.News", "sink.News", "depth=5"), 1, "not connected to `b.News`"),
    ],
)
def test_mistakes_are_explained(
    deployment: Deployment, words: tuple[str, ...], code: int, text: str
) -> None:
    assert text in run(deployment, *words, code=code)
