"""Breaking changes between versions: kind, message and location."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.breaking.compare import Version, compare
from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report

BODY = """\
struct Pose { float x [mm]; float y = 1; };
enum Mood { calm, loud };
sequence<Pose> Poses;
dictionary<string, Pose> Map;
exception Bad { string what; };
interface Base { idempotent Pose get(int a) throws Bad; [command] void go(Pose p); };
"""

# What is replaced in the interface, by what, the kind, and the words.
INTERFACES = [
    ("float x [mm];", "", "RC641", "in place of field `x` `M::Pose` has `y`"),
    ("float y = 1;", "", "RC641", "field `y` of `M::Pose` was removed"),
    ("float y = 1;", "float y = 1; int z;", "RC641", "field `z` of `M::Pose` was added"),
    ("float y = 1", "float w = 1", "RC641", "field `y` of `M::Pose` is `w` now"),
    ("float y = 1", "double y = 1", "RC641", "`M::Pose.y` was float, now double"),
    ("float y = 1", "float y = 2", "RC644", "the default of `M::Pose.y` was 1.0, now 2.0"),
    ("[mm]", "[m]", "RC644", "`M::Pose.x` was in mm, now in m"),
    ("calm, loud", "calm", "RC641", "`loud` of `M::Mood` was removed"),
    ("calm, loud", "loud, calm", "RC641", "`calm` of `M::Mood` was 0, now 1"),
    ("calm, loud", "calm, loud, mad", "RC641", "`mad` of `M::Mood` was added"),
    ("sequence<Pose>", "sequence<Mood>", "RC641", "the elements of `M::Poses` were M::Pose"),
    ("dictionary<string", "dictionary<int", "RC641", "the keys of `M::Map` were string, now int"),
    ("idempotent Pose get", "Pose get", "RC644", "is no longer idempotent"),
    ("Pose get(int a)", "Mood get(int a)", "RC641", "`M::Base.get` returned M::Pose, now M::Mood"),
    ("get(int a)", "get(int a, int b)", "RC641", "`M::Base.get` had 1 input, now 2"),
    ("get(int a)", "get(int b)", "RC642", "input `a` of `M::Base.get` is called `b` now"),
    ("get(int a)", "get(float a)", "RC641", "input `a` of `M::Base.get` was int, now float"),
    (" throws Bad", "", "RC641", "`M::Base.get` threw M::Bad, now nothing"),
    ("[command] void go", "[query] void go", "RC641", "was a command, now a query"),
    ("[command] void go(Pose p);", "", "RC641", "operation `go` of `M::Base` was removed"),
    ("[command] void go", "void stop(); [command] void go", "RC641", "operation `stop`"),
    ("struct Pose { float x [mm]; float y = 1; };", "sequence<int> Pose;", "RC641", "was a struct"),
]
PDSL = (
    "rate float 5 0:10 live; name string; mode {a, b} a; on { deep int 1; };"
    " list[1:4] int 1; more[] {x, y};"
)
PARAMETERS = [
    ("name string;", "", "RC643", "parameter `name` was removed"),
    ("float 5 0:10", "float 5 1:10", "RC643", "accepted 0 to 10, now 1 to 10"),
    ("float 5 0:10", "float 5 0:20", "", ""),
    ("float 5 0:10", "float 6 0:10", "RC644", "the default of `rate` was 5"),
    ("float 5 0:10", "int 5 0:10", "RC643", "was a number, now it is a whole number"),
    (" live", "", "RC644", "`rate` can no longer change while running"),
    ("{a, b} a", "{a} a", "RC643", "no longer accepts `b`"),
    ("{a, b} a", "{a, b, c} a", "", ""),
    ("deep int 1", "deep int", "RC643", "parameter `on.deep` is now required"),
    ("name string;", "name string; new int;", "RC643", "`new` was added and is required"),
    ("name string;", "name string; new int 3;", "", ""),
]
LISTS = [
    ("list[1:4]", "list[2:4]", "RC643", "`list` accepted 1 to 4 elements, now 2 to 4 elements"),
    ("list[1:4]", "list[1:3]", "RC643", "`list` accepted 1 to 4 elements, now 1 to 3 elements"),
    ("list[1:4]", "list[1:]", "", ""),
    ("list[1:4] int 1", "list[1:4] int", "RC643", "parameter `list` is now required"),
    ("list[1:4] int 1", "list[1:4] int {1, 2}", "RC644", "`list` was [1], now [1, 2]"),
    ("list[1:4] int", "list[1:4] float", "RC643", "was a list, each a whole number, now it is"),
    ("list[1:4] int", "list int", "RC643", "a list, each a whole number, now it is a whole number"),
    ("more[] {x, y}", "more[] {x}", "RC643", "`more` no longer accepts `y`"),
    ("more[] {x, y}", "more[2] {x, y}", "RC643", "accepted any number of elements, now 2 elements"),
]
PORTS = [
    ("implements Base;", "", "RC641", "`c` implements `M::Base` no longer"),
    (
        "implements Base;",
        "implements Base; requires Base;",
        "RC641",
        "now requires `M::Base`: it needs a server",
    ),
    ("implements Base;", "implements Base; implements Base as two;", "", ""),
    ("implements Base;", "implements Base(inproc);", "RC641", "used zenoh, now inproc"),
    ("implements Base;", "implements Base(inproc, zenoh);", "", ""),
    ("middleware zenoh;", "middleware inproc;", "RC641", "used zenoh, now inproc"),
]
CASES = [("idsl", *c) for c in INTERFACES] + [("pdsl", *c) for c in PARAMETERS]
CASES += [("pdsl", *c) for c in LISTS] + [("cdsl", *c) for c in PORTS]


def version(folder: Path, changed: str = "", old: str = "", new: str = "") -> Version:
    texts = {
        "idsl": f"module M {{\n{BODY}}};\n",
        "pdsl": f"ComponentParams c {{ {PDSL} }};\n",
        "cdsl": 'import "M.idsl";\nComponent c { Communications { implements Base; };\n'
        'language Python; middleware zenoh; parameters "M.pdsl"; };\n',
    }
    folder.mkdir()
    found = Version()
    report = Report()
    for suffix, text in texts.items():
        assert suffix != changed or old in text
        (folder / f"M.{suffix}").write_text(text.replace(old, new) if suffix == changed else text)
    for suffix in texts:
        found.add(check_file(folder / f"M.{suffix}", Workspace(environ={}), report))
    assert not report.has_errors, [d.message for d in report]
    return found


def compared(tmp_path: Path, changed: str, old: str, new: str) -> list[Diagnostic]:
    report = Report()
    compare(version(tmp_path / "old"), version(tmp_path / "new", changed, old, new), (), report)
    return report.sorted()


@pytest.mark.parametrize(("changed", "old", "new", "kind", "words"), CASES)
def test_compare_reports_change(
    tmp_path: Path, changed: str, old: str, new: str, kind: str, words: str
) -> None:
    found = compared(tmp_path, changed, old, new)
    if not kind:
        assert [d.message for d in found] == []
        return
    matching = [d for d in found if words in d.message and d.code.id == kind]
    assert matching, [(d.code.id, d.message) for d in found]
    assert matching[0].span.source.path.parent.name == "new"
    assert all(n.span.source.path.parent.name == "old" for n in matching[0].notes[:1])


def test_compare_reports_removed_declaration_at_old_location(tmp_path: Path) -> None:
    report = Report()
    compare(version(tmp_path / "old"), Version(), (), report)
    messages = {d.message: d for d in report}
    assert "interface `M::Base` was removed" in messages
    assert "component `c` was removed" in messages
    assert "the parameters of `c` were removed" in messages
    assert {d.span.source.path.parent.name for d in report} == {"old"}


def test_compare_of_equal_versions(tmp_path: Path) -> None:
    assert compared(tmp_path, "", "", "") == []
