"""Models of interfaces: patterns of operations, types and documentation."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model import types
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Interface, Pattern
from tests.check.case_models import CASES, case_workspace, module_of, operation_of

PATTERNS = [
    # text, pattern, inputs, outputs, result
    ("[command] void stop();", Pattern.COMMAND, "", "", None),
    ("[command] void go(Req r);", Pattern.COMMAND, "r", "", None),
    ("[command] void go(Req r) throws Failed;", Pattern.COMMAND, "r", "", None),
    ("[publish] void told(Req r);", Pattern.PUBLISH, "r", "", None),
    ("[query] int say(Req q, Outcome o);", Pattern.QUERY, "q", "o", "int"),
    ("[query] int say(Req q, SayResponse o);", Pattern.QUERY, "q", "o", "int"),
    ("[query] void say(Req q, SayResponse o);", Pattern.QUERY, "q", "o", None),
    ("[query] void say(int q, BusyRESP o);", Pattern.QUERY, "q", "o", None),
    ("[query] int isBusy(BusyRESP r);", Pattern.QUERY, "", "r", "int"),
    ("[query] int tell(Req r);", Pattern.QUERY, "r", "", "int"),
    ("[query] void move(Req a, Outcome b);", Pattern.QUERY, "a b", "", None),
    ("[query] bool ask(Req q, Outcome o);", Pattern.QUERY, "q o", "", "bool"),
    ("[query] int three(Req a, Req b, SayResponse c);", Pattern.QUERY, "a b c", "", "int"),
    ("[query] int ask(Req q, out Outcome o);", Pattern.QUERY, "q", "o", "int"),
    ("[query] int ask(out Outcome o, SayResponse r);", Pattern.QUERY, "r", "o", "int"),
    ("[query] int add(int a, int b);", Pattern.QUERY, "a b", "", "int"),
    ("[query] int mode(Req q, Mode m);", Pattern.QUERY, "q m", "", "int"),
    ("int say(Req q, SayResponse o);", Pattern.QUERY, "q o", "", "int"),
    ("int get();", Pattern.QUERY, "", "", "int"),
    ("void get(out int a, out int b);", Pattern.QUERY, "", "a b", None),
    ("void run() throws Failed;", Pattern.QUERY, "", "", None),
    ("void set(int a);", Pattern.UNMARKED, "a", "", None),
    ("idempotent void set(int a);", Pattern.UNMARKED, "a", "", None),
]


@pytest.mark.parametrize(("text", "pattern", "inputs", "outputs", "result"), PATTERNS)
def test_operation_patterns(
    text: str, pattern: Pattern, inputs: str, outputs: str, result: str | None, tmp_path: Path
) -> None:
    model = operation_of(text, tmp_path)
    assert model.pattern is pattern
    assert " ".join(item.name for item in model.inputs) == inputs
    assert " ".join(output.name for output in model.outputs) == outputs
    assert (model.result.name if model.result else None) == result
    assert model.marked == text.startswith("[")
    assert model.idempotent == text.startswith("idempotent")


def test_idsl_model_has_types_and_docs(tmp_path: Path) -> None:
    module = module_of(
        """
        import "Base.idsl";
        /** The module. */
        module M
        {
            sequence<Thing> Things;
            /** A thing. */
            struct Thing
            {
                /** How wide. */
                float width = 2 [mm];
                Mode mode = Moving;
                Pose pose;
            };
            enum Mode { Idle, Moving = 5, Stopped };
        };
        """,
        tmp_path,
    )
    things, thing, mode = module.declarations
    assert module.doc == "The module."
    assert isinstance(things, types.Sequence)
    assert things.element is thing
    assert isinstance(thing, types.Struct)
    assert thing.doc == "A thing."
    width, kind, pose = thing.fields
    assert (width.default, width.unit, width.doc) == (2.0, "mm", "How wide.")
    assert isinstance(width.default, float)
    assert kind.type is mode
    assert kind.default == "Moving"
    assert isinstance(mode, types.Enum)
    assert [enumerator.value for enumerator in mode.enumerators] == [0, 5, 6]
    assert pose.type is module.imports[0].declarations[0]
    assert module.closure() == (module.imports[0], module)
    assert thing.span.text == "Thing"


def test_imported_interfaces_are_shared_objects() -> None:
    workspace = case_workspace()
    first = check_cdsl(CASES / "cdsl" / "sem_clean.cdsl", workspace, Report())
    second = check_cdsl(CASES / "ddsl" / "sem_parts" / "body.cdsl", workspace, Report())
    assert first is not None
    assert second is not None

    def laser(component: Component) -> Interface:
        return next(port.interface for port in component.ports if port.name == "Laser")

    assert laser(first) is laser(second)
