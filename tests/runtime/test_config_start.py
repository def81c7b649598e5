"""Programs that search for their configuration, keep live values, and run under prefixes."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import uuid
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from robocomp_dsl.runtime.component.settings import (
    InvalidSetting,
    RunSettings,
    parse_peer,
    parse_prefix,
    parse_remaps,
)
from tests.runtime.config_machine import Machine

PROGRAM = """
from robocomp_dsl.runtime import Component, ComponentSpec, ServedPort, main
from robocomp_dsl.runtime.parameters import Parameter, Parameters
from robocomp_dsl.runtime import types as rt
EMPTY = rt.Interface("Empty")
class P(Parameters):
    SCHEMA = (Parameter("rate", "float", default=50.0, live=True),
              Parameter("keep", "float", default=0.0))
class C(Component):
    SPEC = ComponentSpec(name="arm", period=1, parameters=P, middleware="inproc",
        implements=(ServedPort("A", EMPTY), ServedPort("B", EMPTY)))
    def initialize(self):
        print("rate", self.params.rate, "as", self.name)
        if self.params.keep:
            self.params.set({"rate": self.params.keep})
            print("kept", self.params.save())
        self.quit()
raise SystemExit(main(C))
"""


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    computer = Machine(tmp_path)
    computer.put("work/main.py", PROGRAM)
    return computer


def run(machine: Machine, *arguments: str) -> tuple[int, str, str]:
    domain = f"test-{uuid.uuid4().hex[:8]}"
    done = subprocess.run(
        [sys.executable, "main.py", "--domain", domain, *arguments],
        cwd=machine.work,
        env=os.environ | machine.environment,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


def test_without_options_all_is_as_ever(machine: Machine) -> None:
    machine.put("share1/config.yaml", "rate: 3\n")
    assert run(machine)[1] == "rate 50.0 as arm\n"
    machine.put("work/etc/config.yaml", "rate: 2\n")
    _, out, err = run(machine, "--verbose-search")
    assert out == "rate 2.0 as arm\n"
    assert "configuration etc/config.yaml; no search: neither --context nor --config-name" in err


def test_a_context_wins_over_the_default(machine: Machine) -> None:
    machine.put("work/etc/config.yaml", "rate: 2\n")
    file = machine.put("share1/contexts/lab/arm.yaml", "rate: 7\n")
    code, out, err = run(machine, "--context", "lab")
    assert (code, out) == (0, "rate 7.0 as arm\n")
    assert f"configuration {file} (installed, contexts/lab)" in err
    assert "looked for" not in err
    mine = machine.put("user/data/contexts/lab/arm.yaml", "rate: 8\n")
    code, out, err = run(machine, "--context", "lab", "--verbose-search")
    assert out == "rate 8.0 as arm\n"
    assert f"candidate {mine} (user, contexts/lab): used" in err
    assert f"candidate {file} (installed, contexts/lab): shadowed" in err
    assert ": not found\n" in err


def test_a_context_without_a_file_for_it(machine: Machine) -> None:
    machine.put("share1/contexts/lab/base.yaml")
    machine.put("work/etc/config.yaml", "rate: 2\n")
    code, out, err = run(machine, "--context", "lab")
    assert (code, out) == (0, "rate 2.0 as arm\n")
    assert "context lab has no configuration for this component; using etc/config.yaml" in err
    code, _, err = run(machine, "--context", "labb")
    assert "warning: no folder has the context `labb`; did you mean `lab`?" in err


def test_a_file_that_is_nowhere(machine: Machine) -> None:
    machine.put("share1/arm.yaml")
    code, out, err = run(machine, "--config-name", "amr.yaml")
    assert (code, out) == (1, "")
    assert "error: configuration not found: `amr.yaml`\n  --> --config-name:1:1" in err
    assert "did you mean `arm.yaml`" in err
    assert f"  {machine.top}/share2/amr.yaml (installed): not found" in err
    assert "Traceback" not in err


def test_what_is_wrong_in_a_file_that_was_found_is_told_there(machine: Machine) -> None:
    file = machine.put("share1/arm.yaml", "rat: 1\n")
    code, _, err = run(machine, "--config-name", "arm.yaml")
    assert code == 1
    assert f"--> {file}:1:1" in err


def test_values_of_an_installed_configuration_are_kept_with_the_user(machine: Machine) -> None:
    machine.put("share1/contexts/lab/arm.yaml", "rate: 7\n")
    code, out, _ = run(machine, "--context", "lab", "--set", "keep=9")
    saved = machine.top / "user/data/contexts/lab/arm.saved.yaml"
    assert (code, out) == (0, f"rate 7.0 as arm\nkept {saved}\n")
    assert saved.is_file()
    assert run(machine, "--context", "lab")[1] == "rate 9.0 as arm\n"
    assert [p.name for p in (machine.top / "share1/contexts/lab").iterdir()] == ["arm.yaml"]
    assert run(machine)[1] == "rate 50.0 as arm\n"


def test_copies_keep_their_own_values(machine: Machine) -> None:
    machine.put("work/etc/config.yaml", "rate: 2\n")
    for prefix, value in (("left", 3), ("/right/", 4)):
        out = run(machine, "--prefix", prefix, "--set", f"keep={value}")[1]
        assert out.startswith(f"rate 2.0 as {prefix.strip('/')}/arm\n")
    assert run(machine, "--prefix", "left")[1] == "rate 3.0 as left/arm\n"
    assert run(machine, "--prefix", "right")[1] == "rate 4.0 as right/arm\n"
    assert run(machine)[1] == "rate 2.0 as arm\n"


def test_the_file_of_an_instance(machine: Machine) -> None:
    machine.put("share1/contexts/lab/arm.yaml", "rate: 1\n")
    machine.put("share1/contexts/lab/second.yaml", "rate: 2\n")
    machine.put("share1/contexts/lab/left/arm.yaml", "rate: 3\n")
    lab = ("--context", "lab")
    assert run(machine, *lab, "--name", "second")[1] == "rate 2.0 as second\n"
    assert run(machine, *lab, "--prefix", "left")[1] == "rate 3.0 as left/arm\n"
    assert run(machine, *lab, "--prefix", "right")[1] == "rate 1.0 as right/arm\n"


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["--context", "../x"], 1, "is not a valid context: use letters, digits"),
        (["--config", "x.yaml", "--context", "lab"], 2, "--config is an exact path"),
        (["--config", "x.yaml", "--config-name", "y.yaml"], 2, "--config is an exact path"),
        (["--prefix", "a/../b"], 2, "`..` is not a valid prefix name"),
        (["--prefix", "1"], 2, "`1` is not a valid prefix name"),
        (["--name", "left/arm"], 2, "`left/arm` is not a valid name"),
        (["--remap", "A"], 2, "`A` is not a remap; write PORT=NAME"),
        (["--remap", "A=x.y"], 2, "`A=x.y` is not a remap"),
        (["--remap", "C=x"], 2, "arm has no port `C`; its ports: A, B"),
        (["--remap", "A=B"], 2, "`A` and `B` would both be named `B`"),
        (["--remap", "A=Component"], 2, "`Component` and `A` would both be named"),
        (["--remap", "A=x", "--remap", "A=y"], 2, "`A` has two names, x and y"),
    ],
)
def test_wrong_options(machine: Machine, arguments: list[str], code: int, message: str) -> None:
    ended, out, err = run(machine, *arguments)
    assert (ended, out) == (code, "")
    assert message in re.sub(r"\s+", " ", err)
    assert "Traceback" not in err


def test_two_ports_may_change_their_names(machine: Machine) -> None:
    assert run(machine, "--remap", "A=B", "--remap", "B=A")[0] == 0


@pytest.mark.parametrize(
    ("prefix", "wires", "remaps", "peers"),
    [
        ("", (), {}, ()),
        ("left", (), {}, ()),
        ("", ("base",), {}, ("base",)),
        ("left", ("base",), {}, ("left/base",)),
        ("left", ("base.Front",), {}, ("left/base.Front",)),
        (
            "left",
            ("/base", "hand/base", "/right/base"),
            {},
            ("base", "left/hand/base", "right/base"),
        ),
        ("left", (), {"Laser": "scan"}, ("*.scan",)),
        ("left", ("base", "/b.Front"), {"Laser": "scan"}, ("left/base.scan", "b.Front")),
    ],
)
def test_peers_under_a_prefix(
    prefix: str, wires: tuple[str, ...], remaps: dict[str, str], peers: tuple[str, ...]
) -> None:
    settings = RunSettings(
        prefix=prefix, connections={"Laser": wires} if wires else {}, remaps=remaps
    )
    assert settings.peers_of("Laser") == peers


@pytest.mark.parametrize(
    ("text", "prefix"), [("left", "left"), ("/left/hand/", "left/hand"), ("/", ""), ("", "")]
)
def test_prefixes(text: str, prefix: str) -> None:
    assert parse_prefix(text) == prefix


@pytest.mark.parametrize("text", ["a//b", "a b", "*", "a/*", "/".join("abcdefghi"), "é"])
def test_prefixes_that_are_none(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_prefix(text)


@pytest.mark.parametrize("text", ["", "/", "//a", "a/", "a//b", "*", "*.x", "../a"])
def test_peers_that_are_none(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_peer(text)


@pytest.mark.parametrize("text", ["", "A=", "=x", "A=a/b", "A=*", "A=1", "A"])
def test_remaps_that_are_none(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_remaps([text])
