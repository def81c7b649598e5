"""Generated code as Python: formatted, clean, typed, and it runs."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
import yaml

from robocomp_dsl.generate import names
from robocomp_dsl.runtime import Component
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.parameters import ParameterGroup, Parameters
from tests.generate import golden_cases as golden
from tests.support.generated_package import with_package
from tests.support.waiting import wait_until

MYPY = [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--no-error-summary"]
DEADLINE_S = 120
"""How long a component may take to start; the tests do not measure speed."""


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All cases, each in its folder."""
    folder = tmp_path_factory.mktemp("generated")
    for case in golden.CASES:
        golden.put(golden.files(case), folder / case)
    return folder


def test_generated_code_passes_ruff(generated: Path) -> None:
    for command in (["check"], ["format", "--diff"]):
        done = subprocess.run(
            [str(shutil.which("ruff")), *command, "--isolated", "--no-cache", "."],
            cwd=generated,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout


def test_generated_code_passes_mypy_strict(generated: Path) -> None:
    for case in golden.CASES:
        done = subprocess.run(
            [*MYPY, "."],
            cwd=generated / case,
            capture_output=True,
            text=True,
            check=False,
        )
        assert (done.stdout, done.returncode) == ("", 0), case


@pytest.mark.parametrize("case", golden.CASES)
def test_generated_component_starts_and_stops(generated: Path, case: str) -> None:
    command = [sys.executable, "main.py", "--middleware", "inproc", "--log-format", "json"]
    log = generated / f"{case}.log"
    with log.open("wb") as stream:
        process = subprocess.Popen(command, cwd=generated / case, stderr=stream, stdout=stream)
    try:
        wait_until_started(process, log)
        process.send_signal(signal.SIGTERM)
        assert process.wait(DEADLINE_S) == 0, log.read_text()
    finally:
        process.kill()
        process.wait()
    assert "Traceback" not in log.read_text()


def wait_until_started(process: subprocess.Popen[bytes], log: Path) -> None:
    """Wait until the component has installed its handler of SIGTERM."""

    def started() -> bool:
        assert process.poll() is None, log.read_text()
        return catches_sigterm(process.pid)

    wait_until(started, log.read_text, DEADLINE_S)


def catches_sigterm(pid: int) -> bool:
    caught = next(
        line
        for line in Path(f"/proc/{pid}/status").read_text().splitlines()
        if line.startswith("SigCgt:")
    )
    return bool(int(caught.split()[1], 16) >> (signal.SIGTERM - 1) & 1)


USED = """
import numpy as np
from PACKAGE import interfaces as i
from robocomp_dsl.runtime import types as rt
for interface in vars(i).values():
    if isinstance(interface, rt.Interface):
        for operation in interface.operations:
            values = tuple(zero(t) for _, t in operation.inputs)
            decoded = operation.decode_request(operation.encode_request(values))
            assert str(decoded) == str(values), (operation.name, decoded, values)
            results = tuple(zero(t) for _, t in operation.outputs)
            answer = results[0] if len(results) == 1 else results or None
            back = operation.decode_reply(operation.encode_reply(answer))
            assert str(back) == str(answer), (operation.name, back, answer)
            for error in operation.throws:
                back = operation.decode_error(operation.encode_error(error()))
                assert type(back) is error
"""
ZERO = """
def zero(type_):
    from robocomp_dsl.runtime import types as rt
    import numpy as np
    if isinstance(type_, rt.Primitive):
        return {"bool": False, "string": "", "float": 0.0, "double": 0.0}.get(type_.name, 0)
    if isinstance(type_, rt.Array):
        return np.zeros(0, type_.element.dtype)
    if isinstance(type_, rt.Sequence):
        return []
    if isinstance(type_, rt.Dictionary):
        return {}
    return next(iter(type_)) if issubclass(type_, rt.Enum) else type_()
"""


@pytest.mark.parametrize("case", golden.CASES)
def test_generated_operations_encode_and_decode_every_type(generated: Path, case: str) -> None:
    """The zero value of each input, output and exception survives encoding and decoding."""
    run(generated / case, ZERO + USED)


DEFAULTS = """
from PACKAGE.interfaces import *
n = Numbers()
assert (n.flag, n.small, n.port, n.count, n.stamp) == (True, 7, -1, 0, 0)
assert (n.ratio, n.exact, n.gear, n.other) == (2.0, 1e-7, Gear.High, Gear.Low)
assert type(n.ratio) is float
e = Everything()
assert e.text == 'a "quoted" text, a \\'quote\\', a \\\\ and a tab\\t'
assert e.numbers == n
assert Everything().ints is not e.ints
assert Everything().names is not e.names
e.list.append(Numbers(count=3))
assert e.list.count_.tolist() == [3]
assert e.list[0].gear is Gear.High
e.nested.append(Nested(where=Point(x=1.5)))
assert e.nested.where.column("x").tolist() == [1.5]
assert e.nested.inner.column("gear").tolist() == [2]
"""
RENAMED = """
from PACKAGE.interfaces import *
p = RoboCompA_Pose(1, self_=2, class_=3, private_=4, secret__=5, rt_=6)
assert p._names_[3:7] == ("self_", "class_", "private_", "secret__")
assert (p.id, p.self_, p.private_) == (1, 2, 4)
assert (p._type_id_, RoboCompA_Failed._type_id_) == ("RoboCompA::Pose", "RoboCompA::Failed")
assert [name for name, _ in p._fields_][3:7] == ["self", "class", "_private", "__secret"]
many = list_([p])
assert many.private_.tolist() == [4]
assert many.count_.tolist() == [0]
assert many[0] == p
r = request_() if "request_" in globals() else request()
assert r.Wheel == Wheel()
assert RoboCompA_Failed("x").args_ == "x"
assert lambda_.None_ == 0
"""


@pytest.mark.parametrize(("case", "code"), [("types", DEFAULTS), ("renamed", RENAMED)])
def test_generated_types_have_defaults_and_renamed_fields(
    generated: Path, case: str, code: str
) -> None:
    run(generated / case, code)


def run(folder: Path, code: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", with_package(folder, code)],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": ""},
        check=False,
    )
    assert done.returncode == 0, done.stderr


CONFIGURED = """
import sys
from PACKAGE.params import *
(main,) = (v for n, v in list(globals().items()) if n.endswith("Params"))
assert main.load("etc/config.yaml").values() == eval(sys.stdin.read())
"""
VALUES = {
    "speech": {"rate": 1.5, "voice": "anna"},
    "hostile": {
        "text": "\"quoted\" 'x' {{ }} \\ # : - \n ",
        "path": "C:\\new",
        "number": "010",
        "tab": "\t",
    },
    "parameters": {
        "device": "/dev/ttyUSB0",
        "rate": 50.0,
        "retries": 3,
        "fast": False,
        "mode": "position",
        "weights": [1.0],
        "offsets": [0.0, 0.5, 1.0],
        "ids": [],
        "names": ["left", "right"],
        "modes": ["velocity"] * 2,
        "marks": [False] * 9,
        "models": ["etc/config.yaml"],
        **{
            f"motors[{i}].{k}": v
            for i in (0, 1)
            for k, v in [("name", "m"), ("min", -3.14), ("limits", [-1.0, 1.0])]
        },
        "limits.current": 1e-9,
        "limits.voltage": 12.5,
    },
}


@pytest.mark.parametrize("case", VALUES)
def test_generated_config_holds_defaults(generated: Path, case: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", with_package(generated / case, CONFIGURED)],
        cwd=generated / case,
        input=repr(VALUES[case]),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("case", golden.CASES)
def test_generated_config_schema_accepts_generated_config(generated: Path, case: str) -> None:
    schema = json.loads((generated / case / "etc/config.schema.json").read_text())
    config = yaml.safe_load((generated / case / "etc/config.yaml").read_text()) or {}
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(config, schema)


WRONG = [
    {"rate": 0},
    {"rate": "fast"},
    {"mode": "torque"},
    {"motors": [{"name": "a"}]},
    {"motors": [{"name": "a"}, {"nam": "b"}]},
    {"unknown": 1},
    {"retries": 1.5},
    {"weights": []},
    {"weights": [11]},
    {"weights": 1},
    {"offsets": [1, 2]},
    {"modes": ["position", "off"]},
    {"ids": [1.5]},
]


@pytest.mark.parametrize("wrong", WRONG, ids=str)
def test_generated_config_schema_rejects_wrong_values(
    generated: Path, wrong: dict[str, object]
) -> None:
    schema = json.loads((generated / "parameters/etc/config.schema.json").read_text())
    right = {"motors": [{"name": "a"}, {"name": "b"}]}
    jsonschema.validate(right, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**right, **wrong}, schema)


RESERVED = [
    (rt.Struct, names.STRUCT_MEMBERS),
    (rt.DeclaredError, names.ERROR_MEMBERS),
    (rt.StructArray, names.ARRAY_MEMBERS),
    (rt.Enum, names.ENUM_MEMBERS | {"name", "value", "mro"}),
    (rt.Proxy, names.PROXY_MEMBERS),
    (Component, names.COMPONENT_MEMBERS),
    (Parameters, names.PARAMETER_MEMBERS),
    (ParameterGroup, names.PARAMETER_MEMBERS),
]


@pytest.mark.parametrize(("base", "reserved"), RESERVED)
def test_reserved_names_include_members_of_runtime_classes(
    base: type, reserved: frozenset[str]
) -> None:
    """A new member of a base class must be added to the table, else it can be hidden."""
    own = {*dir(base), *base.__annotations__}
    assert {name for name in own if not name.startswith("_")} <= reserved
