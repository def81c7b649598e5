"""Random and mutated files: the check ends, and findings point into the files."""

from __future__ import annotations

import re
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.check.languages import CHECKS, check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.source import Span

CASES = Path(__file__).parent.parent / "cases"
TOKEN = re.compile(r"\s+|\w+|\"[^\"\n]*\"|->|::|.", re.DOTALL)
FILES = sorted(
    path
    for pattern in ("idsl/sem_*.idsl", "?dsl/sem_*/*.?dsl", "?dsl/sem_*.?dsl", "interfaces/*.idsl")
    for path in CASES.glob(pattern)
    if path.suffix in CHECKS
)


def _text(path: Path) -> str:
    return path.read_bytes().decode("utf-8", "replace")


WORDS = sorted({word for path in FILES for word in re.findall(r"\w+", _text(path))})
PIECES = st.one_of(
    st.sampled_from(WORDS), st.sampled_from(list('{}()[]<>;:,."=-')), st.text(max_size=3)
)


@st.composite
def mutated(draw: st.DrawFn) -> tuple[Path, str]:
    """A real file with some words replaced, duplicated or removed."""
    path = draw(st.sampled_from(FILES))
    tokens = TOKEN.findall(_text(path))
    for _ in range(draw(st.integers(1, 6))):
        at = draw(st.integers(0, len(tokens)))
        action = draw(st.sampled_from(["drop", "put", "exchange", "double", "swap"]))
        match action:
            case "drop":
                del tokens[at : at + draw(st.integers(1, 4))]
            case "put":
                tokens.insert(at, draw(PIECES))
            case "exchange":
                tokens[at : at + 1] = [draw(PIECES)]
            case "double":
                tokens[at:at] = tokens[at : at + draw(st.integers(1, 12))]
            case "swap":
                tokens[at : at + 3] = reversed(tokens[at : at + 3])
    return path, "".join(tokens)


def _inside(span: Span) -> bool:
    return 0 <= span.start <= span.end <= len(span.source.text)


WORKSPACE = Workspace(environ={}, shipped=CASES / "interfaces")


@settings(max_examples=300)
@given(mutated())
def test_check_file_accepts_mutated_files(case: tuple[Path, str]) -> None:
    path, text = case
    WORKSPACE.sources.set_overlay(path, text)
    try:
        report = Report()
        check_file(path, WORKSPACE, report)
        for diagnostic in report:
            assert diagnostic.message
            assert _inside(diagnostic.span)
            assert all(_inside(note.span) for note in diagnostic.notes)
            assert diagnostic.fix is None or all(
                _inside(edit.span) for edit in diagnostic.fix.edits
            )
            diagnostic.span.start_position, diagnostic.span.end_position  # noqa: B018 - must not raise
    finally:
        WORKSPACE.sources.remove_overlay(path)


IDENTIFIERS = st.sampled_from(["A", "B", "C", "M", "int", "Pose", "string"])
TYPES = st.one_of(IDENTIFIERS, st.builds("{}::{}".format, IDENTIFIERS, IDENTIFIERS))
FIELDS = st.lists(st.builds("{} {};".format, TYPES, IDENTIFIERS), max_size=3).map(" ".join)
DECLARATIONS = st.one_of(
    st.builds("struct {} {{ {} }};".format, IDENTIFIERS, FIELDS),
    st.builds("exception {} {{ {} }};".format, IDENTIFIERS, FIELDS),
    st.builds("sequence<{}> {};".format, TYPES, IDENTIFIERS),
    st.builds("dictionary<{}, {}> {};".format, TYPES, TYPES, IDENTIFIERS),
    st.builds("interface {} {{ {} f(out {} a) throws {}; }};".format, IDENTIFIERS, *[TYPES] * 3),
)
MODULES = st.builds(
    "module {} {{ {} }};\n".format, IDENTIFIERS, st.lists(DECLARATIONS, max_size=6).map("\n".join)
)
IMPORTS = st.lists(st.sampled_from("ABC").map('import "{}.idsl";\n'.format), max_size=2).map(
    "".join
)


@settings(max_examples=300)
@given(st.lists(st.tuples(IMPORTS, MODULES).map("".join), min_size=3, max_size=3))
def test_module_loader_accepts_random_imports(texts: list[str]) -> None:
    """Cycles, recursion and clashes; twice, because the second run uses the cache of the first."""
    folder = Path("/nowhere")
    workspace = Workspace(environ={}, shipped=folder)
    for name, text in zip("ABC", texts, strict=True):
        workspace.sources.set_overlay(folder / f"{name}.idsl", text)
    runs = []
    for _ in range(2):
        report = Report()
        for name in "ABC":
            check_file(folder / f"{name}.idsl", workspace, report)
        runs.append(
            [
                (diagnostic.code.id, diagnostic.span.start, diagnostic.message)
                for diagnostic in report.sorted()
            ]
        )
    assert runs[0] == runs[1]


def test_shipped_interfaces_have_no_findings() -> None:
    workspace, report = Workspace(environ={}), Report()
    for path in sorted(INTERFACES.glob("*.idsl")):
        check_file(path, workspace, report)
    assert [f"{diagnostic.span.source.path}: {diagnostic.message}" for diagnostic in report] == []
