"""Incremental parsing gives the tree and the findings of a full parse."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.idsl import Interface
from robocomp_dsl.syntax.ast.node import Node
from robocomp_dsl.syntax.parse import LANGUAGES, parse_idsl
from tests.syntax.test_mutated import PIECES, REAL

STATEMENTS = [
    "struct A { int x; };\n",
    "enum E { A, B };\n",
    "sequence<int> L;\n",
    "/** Doc. */\n",
    "/// Doc.\n",
    "interface I {\n  void f(int a);\n};\n",
    "};\n",
    "string x;\n",
    "# a line\n",
    "module N\n{\n",
    "Component C { Communications { requires Laser; }; };\n",
    "requires Laser;\n",
    "period 5;\n",
    "// x\n",
    ";\n\n;",
    "/*",
    "*/",
    'import "X.idsl";\n',
    "x float 1.0 [mm] 0:2;\n",
    "component a of B { after b; };\n",
    "connect a.X -> b.Y;\n",
    "input a : double[] [deg] over yarp;\n",
    "output b : M::T { x = a[0] to [rad] * -1; };\n",
    "x = {",
    "}",
    "\r\n",
]
LONG = "".join(
    f"  struct S{n} {{\n    /** x */ int a{n} = {n} [mm];\n    S{n - 1} b;\n  }};\n"
    f"  sequence<S{n}> L{n};\n"
    for n in range(1, 40)
)
TEXTS: dict[str, list[str]] = {
    suffix: [p.read_text("utf-8", "replace") for p in REAL[suffix]] for suffix in LANGUAGES
}
TEXTS[".idsl"] += [
    f"module Long\n{{\n{LONG}}};\n",
    f"module One {{ {LONG} }};\nmodule Two {{\n{LONG}}};\n",
]


def plain(value: Any) -> Any:
    """A tree or finding as tuples of numbers and texts, spans and all."""
    if isinstance(value, Span):
        return value.start, value.end, value.source.text
    if isinstance(value, Node):
        fields: tuple[str, ...] = type(value).__match_args__
        return type(value).__name__, *(plain(getattr(value, field)) for field in fields)
    if isinstance(value, tuple):
        return tuple(plain(diagnostic) for diagnostic in value)
    if isinstance(value, Diagnostic):
        notes = tuple((plain(note.span), note.message) for note in value.notes)
        edits = tuple((plain(e.span), e.text) for e in value.fix.edits) if value.fix else ()
        shown = (value.code.id, value.message, value.label, value.help)
        left = value.uncertain
        uncertain = left and (plain(left.span), sorted(left.names), left.declares)
        return *shown, plain(value.span), notes, edits, uncertain
    return value


def edit(text: str, rng: random.Random) -> str:
    """`text` with one place edited, mostly typical edits."""
    at = rng.randint(0, len(text))
    until = min(len(text), at + rng.choice((0, 0, 0, 1, 1, 8, 80, 800)))
    lines = [i + 1 for i, c in enumerate(text) if c == "\n"]
    if lines and rng.random() < 0.3:
        at = rng.choice(lines)
        until = rng.choice((at, text.find("\n", at) + 1 or len(text)))
    put = rng.choice(("", "", " ", "\n", "a", "7", *PIECES, *STATEMENTS, text[at:until] * 2))
    return text[:at] + put + text[until:]


def next_text(texts: list[str], rng: random.Random) -> str:
    """The last of the texts after an edit, or after some of the edits were undone."""
    if rng.random() < 0.25:
        return rng.choice(texts)
    if rng.random() < 0.1:  # what was deleted is pasted somewhere else
        at, source = rng.randint(0, len(texts[-1])), rng.choice(texts)
        start = rng.randint(0, len(source))
        return texts[-1][:at] + source[start : start + rng.choice((80, 400))] + texts[-1][at:]
    return edit(texts[-1], rng)


@pytest.mark.parametrize("suffix", sorted(LANGUAGES))
@settings(max_examples=120, suppress_health_check=list(HealthCheck))
@given(seed=st.integers(0, 2**32))
def test_incremental_parse_equals_full_parse(suffix: str, seed: int) -> None:
    rng = random.Random(seed)
    texts = [rng.choice(TEXTS[suffix])]
    for _ in range(rng.randint(2, 12)):
        texts.append(next_text(texts, rng))
    compare(suffix, texts)


def compare(suffix: str, texts: list[str]) -> None:
    """Parse the texts incrementally and each from scratch; compare the results."""
    path, memory = Path(f"x{suffix}"), dict[str, Any]()
    parse = LANGUAGES[suffix]
    for number, text in enumerate(texts):
        remaining, alone = Report(), Report()
        source = Source(path, text, memory)
        tree = parse(source, remaining)
        fresh = parse(Source(path, text), alone)
        shown = "\n=====\n".join(texts[: number + 1])
        assert plain(tree) == plain(fresh), shown
        assert [plain(diagnostic) for diagnostic in remaining] == [
            plain(diagnostic) for diagnostic in alone
        ], shown


PARAMETERS = """\
ComponentParams P
{
    speed float 1 [m/s] 0:20 CHANGED
    ; int 3;
    quiet bool true ;live
    last int 1;
};
"""


@pytest.mark.parametrize("changed", ["; count", "live count", "live ;", "count ; ;"])
def test_incremental_parse_reads_statement_before_error_again(changed: str) -> None:
    texts = [PARAMETERS.replace("CHANGED", text) for text in ("live count", changed, "live count")]
    compare(".pdsl", texts)


def test_incremental_parse_reuses_unchanged_items() -> None:
    memory = dict[str, Any]()
    text = TEXTS[".idsl"][-2]
    first = parse_idsl(Source(Path("x.idsl"), text, memory), Report()).modules[0].declarations
    edited = text.replace("a20 = 20", "a20 = 2000")
    again = parse_idsl(Source(Path("x.idsl"), edited, memory), Report()).modules[0].declarations
    read = [new.name.text for old, new in zip(first, again, strict=True) if new is not old]
    # The first has no mark in front of it, and recovery may read the item before an error again.
    assert read == ["S1", "S20", "L20"]
    assert again[-1].span.text == "sequence<S39> L39;"


def test_incremental_parse_reuses_items_despite_error_elsewhere() -> None:
    memory = dict[str, Any]()
    text = TEXTS[".idsl"][-2].replace("int a5 =", "int int a5 =").replace("int a35 =", "int int =")
    first = parse_idsl(Source(Path("x.idsl"), text, memory), Report()).modules[0].declarations
    edited = text.replace("a20 = 20", "a20 = ")
    again = parse_idsl(Source(Path("x.idsl"), edited, memory), Report()).modules[0].declarations
    assert sum(new is old for old, new in zip(first, again, strict=False)) > 30


def test_incremental_parse_reuses_items_behind_a_stray_brace_that_is_deleted_again() -> None:
    memory = dict[str, Any]()
    operations = "".join(f"    void go{n}(int a, out float b);\n" for n in range(300))
    text = f"module M {{\n  interface I {{\n{operations}  }};\n}};\n"
    stray = text.replace("go100(", "go100 } } (")
    parse_idsl(Source(Path("x.idsl"), text, memory), Report())
    first = parse_idsl(Source(Path("x.idsl"), text, memory), Report()).modules[0].declarations
    parse_idsl(Source(Path("x.idsl"), stray, memory), Report())
    parse_idsl(Source(Path("x.idsl"), f"{stray} ", memory), Report())
    again = parse_idsl(Source(Path("x.idsl"), text, memory), Report()).modules[0].declarations
    assert isinstance(first[0], Interface)
    assert isinstance(again[0], Interface)
    pairs = list(zip(first[0].operations, again[0].operations, strict=True))
    assert sum(new is old for old, new in pairs) > 270
    assert again[0].operations[-1].span.text == "void go299(int a, out float b);"


def test_incremental_parse_ends_after_too_many_errors_as_a_full_parse_does() -> None:
    operations = "".join(f"    void go{n}(int a);\n" for n in range(300))
    text = f"module M {{\n{operations}}};\n"
    edited = text.replace("go20(", "go20x(")
    compare(".idsl", [text, edited, edited.replace("go250(", "go250x("), text])
    report = Report()
    parse_idsl(Source(Path("x.idsl"), text), report)
    assert [finding.message for finding in report][-1].startswith("more than 100 errors")
    assert len(report) == 101
