"""The shapes that the checker computes are those of generated code, which components compare."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

from robocomp_dsl.model.interface_shape import InterfaceShapes
from robocomp_dsl.runtime.component.interface import Interface
from tests.generate import golden_cases as golden


def generated_interfaces(case: str) -> ModuleType:
    (file,) = (golden.GOLDEN / case / "expected").glob("*_generated/interfaces.py")
    spec = importlib.util.spec_from_file_location(f"shape_{case}", file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("case", ["arrays", "types", "speech", "ros", "renamed"])
def test_interface_shapes_of_model_and_generated_code_are_equal(case: str) -> None:
    (path,) = (golden.GOLDEN / case).glob("*.cdsl")
    component = golden.component(Path(path))
    generated = {
        value.name: value
        for value in vars(generated_interfaces(case)).values()
        if isinstance(value, Interface)
    }
    shapes = InterfaceShapes()
    compared = 0
    for interface in {port.interface for port in component.ports}:
        found = generated[interface.qualified].shapes
        assert shapes.of(interface) == found
        compared += len(found)
    assert compared


def test_interface_shapes_include_units() -> None:
    (path,) = (golden.GOLDEN / "arrays").glob("*.cdsl")
    (interface,) = {port.interface for port in golden.component(Path(path)).ports}
    shape = InterfaceShapes().of(interface)["estimate"]
    assert "covariance:array<double,36>[mm^2]" in shape
    assert "when:uint64[ns]" in shape
