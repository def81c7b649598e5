"""Any text in doc comments, defaults and units: the output compiles and keeps the text."""

from __future__ import annotations

import inspect
import json
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.plan import OutputFile, plan
from robocomp_dsl.model import types as t
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.interface import Interface, Module, Operation, Param, Pattern
from robocomp_dsl.model.parameter import Kind, Parameter, ParameterSet
from robocomp_dsl.source import Source
from tests.generate import golden_cases as golden

HERE = Source(Path("x.idsl"), "").file_span
TEXTS = st.text(max_size=40) | st.text("\"'\\\n\r\t{}%#*/ \x00\u2028é`|", max_size=20)


def component(doc: str, text: str, unit: str) -> Component:
    """A component with the texts in every place that takes a text."""
    fields = (t.Field("s", t.STRING, HERE, text, unit, doc),)
    struct = t.Struct("M", "S", HERE, doc, fields)
    enum = t.Enum("M", "E", HERE, doc, (t.Enumerator("One", 1, HERE, doc),))
    alias = t.Sequence("M", "Q", HERE, doc, t.INT)
    error = t.ExceptionType("M", "X", HERE, doc, fields)
    inputs = (Param("a", struct, HERE, unit),)
    operation = Operation("go", HERE, Pattern.QUERY, inputs, (), enum, (error,), False, False, doc)
    interface = Interface("M", "I", HERE, doc, (operation,))
    module = Module("M", Path("x.idsl"), HERE, doc, (), (struct, enum, alias, error, interface))
    ports = tuple(Port(r, interface, "I", HERE) for r in (Role.IMPLEMENTS, Role.REQUIRES))
    parameters = (
        Parameter("p", Kind.STRING, HERE, text, unit=unit, doc=doc),
        Parameter("c", Kind.CHOICE, HERE, "a", choices=("a", "b"), doc=doc),
    )
    parameter_set = ParameterSet("c", Path("x.pdsl"), HERE, parameters, doc)
    return Component("c", Path("x.cdsl"), HERE, "Python", (module,), ports, parameter_set, doc=doc)


@settings(max_examples=60)
@given(doc=TEXTS, text=TEXTS, unit=TEXTS)
def test_generated_code_with_random_texts_keeps_texts(doc: str, text: str, unit: str) -> None:
    files = {f.path: f for f in plan(component(doc, text, unit))}
    for path, file in files.items():
        if path.endswith(".py"):
            compile(file.text, path, "exec", dont_inherit=True)
    interfaces = executed(files["c_generated/interfaces.py"])
    assert interfaces.S().s == text
    assert interfaces.X().s == text
    title = literals.lines(doc)
    assert doc_of(interfaces.S)[: len(title) or 1] == (title or ["M::S."])
    assert doc_of(interfaces.E) == (title or ["M::E."])
    params = executed(files["c_generated/params.py"])
    assert params.CParams.load(None).p == text
    config = yaml.safe_load(files["etc/config.yaml"].text)
    assert config == {"p": text, "c": "a"}
    schema = json.loads(files["etc/config.schema.json"].text)
    assert schema["properties"]["p"]["default"] == text


def executed(file: OutputFile) -> Any:
    """The module, executed."""
    module = ModuleType("generated_module")
    sys.modules["generated_module"] = module
    exec(compile(file.text, file.path, "exec", dont_inherit=True), module.__dict__)
    return module


def doc_of(class_: type) -> list[str]:
    return (inspect.getdoc(class_) or "").split("\n")


def test_generated_code_of_hostile_case_keeps_texts() -> None:
    """The texts of the hostile golden case in the executed module."""
    (file,) = (f for f in golden.files("hostile") if f.path == "hostile_generated/interfaces.py")
    module = executed(file)
    assert module.A().s == '""" {{ x }} \\ \' \n'
    assert doc_of(module.E) == ["ends with a backslash\\"]
    assert doc_of(module.X) == ["line one", '"""', "    indented \\", "{{ }}"]
