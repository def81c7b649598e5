"""Random typed expressions: what the checker accepts runs without an error of types."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from random import Random
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.check.passes import check_bdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen.bridge import command
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.runtime.bridge.context import MessageContext
from robocomp_dsl.runtime.bridge.errors import DoesNotFit
from robocomp_dsl.runtime.codec.codec import compile_encoder
from tests.bridge.random_expressions import HEADER, random_output

OUTPUTS = 150
ARITHMETIC = (ZeroDivisionError, OverflowError)


@pytest.mark.parametrize("seed", range(3))
def test_accepted_expressions_build_encodable_messages(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    random = Random(seed)
    outputs = [random_output(random, index) for index in range(OUTPUTS)]
    path = tmp_path / "random_values.bdsl"
    bridge = _bridge_of_accepted_outputs(path, outputs)
    assert len(bridge.outputs) > OUTPUTS // 3
    command.main(["-q", str(path)], standalone_mode=False)
    monkeypatch.syspath_prepend(tmp_path)
    try:
        mapping = import_module("random_values_generated.mapping")
        interfaces = import_module("random_values_generated.interfaces")
        failures = [text for edge in range(3) for text in _run(bridge, mapping, interfaces, edge)]
        assert failures == [], "\n".join(failures)
    finally:
        for name in [name for name in sys.modules if name.startswith("random_values_generated")]:
            del sys.modules[name]


def _bridge_of_accepted_outputs(path: Path, outputs: list[str]) -> Bridge:
    """The bridge without the outputs that have an error."""
    path.write_text("\n".join([HEADER, *outputs, "};"]))
    first_line = HEADER.count("\n") + 2
    report = Report()
    check_bdsl(path, Workspace(), report)
    faulty = {d.span.start_position[0] for d in report if d.severity is Severity.ERROR}
    accepted = [text for line, text in enumerate(outputs, first_line) if line not in faulty]
    path.write_text("\n".join([HEADER, *accepted, "};"]))
    report = Report()
    bridge = check_bdsl(path, Workspace(), report)
    assert bridge is not None
    assert not report.has_errors, [d.message for d in report if d.severity is Severity.ERROR]
    return bridge


def _run(bridge: Bridge, mapping: ModuleType, interfaces: ModuleType, edge: int) -> Iterator[str]:
    """Build and encode each message from the inputs number `edge`; yields what fails."""
    received = _inputs(interfaces, edge)
    at = MessageContext(lambda _: 1_700_000_000_000_000_000)
    hubs = {hub.name: hub for hub in bridge.hubs}
    user = SimpleNamespace(
        twice=lambda numbers: np.asarray(numbers) * 2,
        pick=lambda numbers, index: float(numbers[index]) if len(numbers) > index else 0.0,
        label=lambda name, number: f"{name}{number}",
    )
    for output in bridge.outputs:
        function = getattr(mapping, f"output_{output.name}")
        names = list(inspect.signature(function).parameters)[2:]
        sets = []
        for name in names:
            stem = name.removesuffix("_set").removesuffix("_stamp")
            hub = hubs.get(stem)
            sources = [source.name for source in hub.inputs] if hub else [stem]
            sets.append(tuple(received[source] for source in sources))
        at.begin(1_700_000_000_250_000_000, edge * 70_000)
        text = output.port.span.source.line(output.port.span.start_position[0])
        try:
            with np.errstate(all="ignore"):
                arguments = function(at, user, *sets)
        except (DoesNotFit, *ARITHMETIC):
            continue  # a length or range, which the running bridge counts
        except Exception as error:
            yield f"{text}: {type(error).__name__}: {error}"
            continue
        topic = getattr(interfaces, output.port.interface.name.upper())
        fields = topic.operation(output.port.operation.name).inputs
        try:
            compile_encoder(fields)(arguments)
        except Exception as error:
            yield f"{text}: {arguments}: {type(error).__name__}: {error}"


def _inputs(interfaces: ModuleType, edge: int) -> dict[str, Any]:
    """A message of each input: usual values, empty lists and zeros, large values."""
    scale = (1.0, 0.0, 1e6)[edge]
    count = (3, 0, 5)[edge]
    pose, joints = interfaces.PoseStamped(), interfaces.JointState()
    pose.pose.position.x = scale
    joints.position = np.arange(count) * scale
    joints.name = [f"joint{index}" for index in range(count)]
    shape = interfaces.Shape()
    shape.x, shape.count, shape.name, shape.on = scale, int(scale), "shape", edge == 1
    item = next(cls for cls in vars(interfaces).values() if _has_fields(cls, ("x", "y")))
    return {
        "number_in": 1.5 * scale,
        "angle": 90.0 * scale,
        "distance": 1234.5 * scale,
        "whole": int(7 * scale),
        "large": int(10**12 * scale),
        "small": (7, 0, 255)[edge],
        "word": ("word", "", "ä" * 50)[edge],
        "digits": ("12.5", "nothing", "-1e9")[edge],
        "flag": edge == 0,
        "angles": np.arange(count) * scale,
        "pair": np.array([0.5, -0.25]) * scale,
        "wholes": np.array([1, -2, 3]) * int(scale),
        "floats": np.arange(count, dtype=np.float32) * np.float32(scale),
        "words": ["1.5", "2"],
        "flags": np.array([True, False] * edge, np.bool_),
        "shape": shape,
        "shapes": [item() for _ in range(count)],
        "pose": pose,
        "joints": joints,
    }


def _has_fields(class_: Any, names: tuple[str, ...]) -> bool:
    return tuple(getattr(class_, "__annotations__", ())) == names
