"""A fault of one token in a correct file: one error, at its place, whose fix restores the file."""

from __future__ import annotations

import re
from pathlib import Path
from random import Random

import pytest

from benchmarks.bench_recovery import measure
from benchmarks.token_faults import (
    KINDS,
    SUFFIXES,
    Fault,
    apply,
    find_errors,
    judge,
    make_fault,
    tokens,
)

IDSL = """\
module M
{
    struct Place
    {
        double x [m];
        string name;
    };
    exception Lost { string what; };
    interface Finder
    {
        Place find(string name) throws Lost;
        void forget(string name);
        void meet(string name, out string owner, out Place place);
    };
};
"""
SMDSL = """\
Machine
{
    initial_state Idle;
    states Busy;
    transitions
    {
        Idle => Busy on started;
        Busy => Idle on finished;
    };
};
"""
PDSL = """\
ComponentParams P
{
    speed float 1 [m/s] 0:20 live;
    quiet bool true live;
};
"""
CDSL = """\
import "Laser.idsl";
Component c
{
    Communications { implements Laser; };
    language Python;
};
"""
CASES = [
    (".idsl", IDSL, "string name;", "string string name;", "`string` is written twice"),
    (".idsl", IDSL, "module M", "module module M", "`module` is written twice"),
    (".idsl", IDSL, "exception L", "exception exception L", "`exception` is written twice"),
    (".idsl", IDSL, "struct Place", "Place", "`struct` is missing before `Place`"),
    (".idsl", IDSL, "interface Finder", "Finder", "`interface` is missing before `Finder`"),
    (".idsl", IDSL, "x [m];", "[m] x;", "`[m]` and `x` are in the wrong order"),
    (".idsl", IDSL, "string name;", "name string;", "unknown type `name`"),
    (".idsl", IDSL, "void forget", "viod forget", "unknown type `viod`"),
    (".idsl", IDSL, "out string owner", "uot string owner", "`uot` is not a keyword"),
    (".idsl", IDSL, "out Place place", "ouut Place place", "`ouut` is not a keyword"),
    (".smdsl", SMDSL, "on started", "started", "`on` is missing before `started`"),
    (".smdsl", SMDSL, "=> Busy", "=>=> Busy", "`=>` is written twice"),
    (".smdsl", SMDSL, "Idle =>", "=> Idle", "`=>` and `Idle` are in the wrong order"),
    (".smdsl", SMDSL, "=> Busy", "=> Buzsy", "unknown state `Buzsy`"),
    (".pdsl", PDSL, "speed float", "speed", "`float` is missing after `speed`"),
    (".pdsl", PDSL, "0:20", ":0 20", "`:` and `0` are in the wrong order"),
    (".pdsl", PDSL, "0:20", "0 20:", "`20` and `:` are in the wrong order"),
    (".pdsl", PDSL, "0:20", "0 20", "`:` is missing after `0`"),
    (".pdsl", PDSL, "[m/s] 0:20", "0 [m/s] :20", "`0` and `[m/s]` are in the wrong order"),
    (".pdsl", PDSL, "0:20 live", "0: live 20", "`live` and `20` are in the wrong order"),
    (".pdsl", PDSL, "live;", ";live", "`;` and `live` are in the wrong order"),
    (
        ".pdsl",
        PDSL,
        "live;\n    quiet",
        "live quiet\n    ;",
        "`quiet` and `;` are in the wrong order",
    ),
    (
        ".pdsl",
        PDSL,
        "quiet bool true live;\n}",
        "quiet bool true live;\n",
        "`}` is missing before `;`",
    ),
    (".smdsl", SMDSL, "initial_state Idle", "Idle", "`initial_state` is missing before `Idle`"),
    (".smdsl", SMDSL, "states Busy;", "states ;Busy", "`;` and `Busy` are in the wrong order"),
    (".idsl", IDSL, "void forget(", "void (forget ", "`(` and `forget` are in the wrong order"),
    (".cdsl", CDSL, "Communications {", "{", "`Communications` is missing before `{`"),
    (".pdsl", PDSL, "0:20", "0::20", "`:` is written twice"),
    (".pdsl", PDSL, "true live", "true live live", "`live` is written twice"),
]


@pytest.mark.parametrize(("suffix", "text", "right", "wrong", "message"), CASES)
def test_parser_repairs_fault_of_one_token(
    suffix: str, text: str, right: str, wrong: str, message: str, tmp_path: Path
) -> None:
    path = tmp_path / f"x{suffix}"
    assert not find_errors(path, text)
    changed = text.replace(right, wrong, 1)
    errors = find_errors(path, changed)
    assert [error.message for error in errors] == [message]
    assert errors[0].fix
    assert not find_errors(path, apply(changed, errors[0].fix))
    start = text.index(right)
    outcome = judge(Fault(path, "", text, changed, start, start + len(right)))
    assert outcome
    assert outcome.near
    assert outcome.restored


SWAPPED_BRACKETS = [
    (
        ".idsl",
        "module M { interface I { [query] int a(); }; };",
        "[query] int",
        "int [query]",
    ),
    (".pdsl", "ComponentParams P { load[1:2] { value int 1; }; };", "load[1:2]", "[1:2]load"),
    (".bdsl", "bridge b { input a : double[2] over yarp; };", "double[2]", "[2]double"),
]


@pytest.mark.parametrize(("suffix", "text", "right", "wrong"), SWAPPED_BRACKETS)
def test_parser_reports_brackets_before_word(
    suffix: str, text: str, right: str, wrong: str, tmp_path: Path
) -> None:
    assert find_errors(tmp_path / f"x{suffix}", text.replace(right, wrong))


@pytest.mark.parametrize("kind", ["swap", "delete", "double"])
def test_make_fault_keeps_words_beside_fault_apart(kind: str) -> None:
    found = tokens(PDSL, ".pdsl")
    words = set(re.findall(r"\w+", PDSL))
    for index in range(len(found) - 1):
        fault = make_fault(Path("x.pdsl"), PDSL, found, index, kind, Random(1))
        assert fault
        assert set(re.findall(r"\w+", fault.text)) <= words, fault.text


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("suffix", SUFFIXES)
def test_measure_finds_faults_in_each_language(suffix: str, kind: str) -> None:
    outcomes = measure(suffix, kind, count=20)
    assert outcomes
    assert all(outcome.errors for outcome in outcomes)
    if kind == "double":
        assert sum(outcome.restored for outcome in outcomes) >= 0.8 * len(outcomes)


MISSING = [
    (".idsl", IDSL, "struct Place", "struct", "a name is missing after `struct`"),
    (".cdsl", CDSL, '"Laser.idsl"', "", 'a "string" is missing after `import`'),
    (".cdsl", CDSL, "implements Laser", "implements as l", "a name is missing after `implements`"),
    (".smdsl", SMDSL, "=> Busy on", "=> on", "a name is missing after `=>`"),
    (".smdsl", SMDSL, "states Busy", "states", "a name is missing after `states`"),
    (".smdsl", SMDSL, "        Idle => Busy", "        => Busy", "a name is missing before `=>`"),
]
"""Names that no repair can know: one error, and nothing about what follows from it."""


@pytest.mark.parametrize(("suffix", "text", "right", "wrong", "message"), MISSING)
def test_missing_operand_is_one_error(
    suffix: str, text: str, right: str, wrong: str, message: str, tmp_path: Path
) -> None:
    changed = text.replace(right, wrong, 1)
    assert changed != text
    errors = find_errors(tmp_path / f"x{suffix}", changed)
    assert [error.message for error in errors] == [message]
