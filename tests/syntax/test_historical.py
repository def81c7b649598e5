"""Historical syntax of RoboComp: the parser accepts it with findings.

A form of today gives none, an old one a warning (its fix leads to a text without it), a broken one
an error where it is. Nothing of the rest of the file is lost.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.check.fixes import fix_all
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import parse_cdsl, parse_idsl, parse_pdsl, parse_smdsl

Parser = Callable[[Source, Report], Any]

C = "Component c {{ Communications {{ {0} }}; language Cpp; {1} }};"


def whole(ports: str = "", settings: str = "") -> str:
    return C.format(ports, settings)


CDSL: list[tuple[str, str]] = [
    (whole(), ""),
    ("component C\n{\n COMMUNICATIONS\n{};\nLANGUAGE cpp11;\n};", ""),
    ("Component c { language Python; Communications { requires A; }; };", ""),
    ("Component c { gui Qt(QWidget); Communications { }; language Cpp11; };", ""),
    ("Component c { Communications { }; GUI Qt(QMainWindow); language python; };", ""),
    (whole("implements A; requires B, C; subscribesTo D; publishes E, F;"), ""),
    (whole("publishes E; implements A;"), ""),
    (whole("requires Laser, Laser, Laser;"), ""),
    (whole("requires A(ice), B(ros); publishes T(ros);"), ""),
    (whole("requires A; requires B; requires C;"), ""),
    (whole(settings="gui Qt(QDialog); options agmagent;"), ""),
    (whole(settings="gui Qt(QWidget); options agmagent, InnerModelViewer;"), ""),
    (whole(settings="options dsr;"), ""),
    (whole(settings="options;"), "RC100"),
    (whole(settings=";"), "RC151"),
    (whole(settings='statemachine "statemachine.smdsl";'), ""),
    (whole(settings='statemachine "game.smdsl" visual;'), ""),
    (whole(settings='gui Qt(QWidget); statemachine "a.smdsl"; options dsr;'), ""),
    (whole(settings='stateMachine "fichero.scxml";'), ""),
    (whole(settings="stateMachine fichero;"), "RC163"),
    (whole(settings="gui Qt;"), "RC162"),
    (whole(settings="gui QWidget;"), "RC162"),
    (whole(settings="gui Qt(QFrame);"), "RC162"),
    (whole(settings="no_gui;"), "RC161"),
    (whole(settings="gui no_gui;"), "RC161"),
    (whole(settings="worker isThread;"), "RC161"),
    (whole(settings="useQt qt4;"), "RC161"),
    (whole(settings="qtversion Qt5;"), "RC161"),
    (whole(settings='RoboCompClasses { "/Classes/rcdraw/rcdraw.h"; rcdraw; };'), "RC161"),
    (whole(settings='RoboCompModules{ ipp; // OpenCV;\n "pcl"; };'), "RC161"),
    ('import "/robocomp/Interfaces/IDSLs/Laser.idsl";' + whole("requires Laser;"), ""),
    ('import "../../../..//interfaces/IDSLs/A.idsl";' + whole("requires A;"), ""),
    ('import "A.idsl"\nimport "B.idsl";' + whole("requires A;"), "RC150"),
    (whole("requires A, B,;"), "RC152"),
    (whole("requires ;"), "RC164"),
    ("Component c { language Python; };", "RC165"),
    (whole() + " bye", "RC153"),
    (whole() + ";", "RC151"),
    ("Component c { Communications { requires A }; language Cpp; };", "RC150"),
    ("Component c { Communications { }; language N++; };", "RC112"),
    ("Component c { Communications { }; language Cpp; options opencv2; };", "RC112"),
    ("Component c, { Communications { }; language Cpp; };", "RC100"),
    ("Component c { Communications { }; language Cpp//Cpp11//python;\n gui Qt(QWidget);\n };",
     "RC150"),
    ("import Laser.idsl;" + whole(), "RC108"),
    ('import "A.idsl"; // as old Macs\r// end lines\r' + whole("requires A;"), ""),
    ("", "RC002"),
]  # fmt: skip


def module(text: str) -> str:
    return f"module RoboCompX {{ {text} }};"


def interface(text: str) -> str:
    return module(f"interface X {{ {text} }};")


IDSL: list[tuple[str, str]] = [
    (module(""), ""),
    (interface(""), ""),
    (module("interface A { void a(); }; interface B { void b(); };"), ""),
    (module("interface A { void a(); }; struct Late { int x; };"), ""),
    (module("sequence <int> A; sequence< float > B; sequence<A> C; sequence<RoboCompY::T> D;"), ""),
    (module("dictionary<string, int> A; dictionary<int,A> B; dictionary < short , A > C;"), ""),
    (module("enum E { a, b }; enum F { c = 1, d=2 }; enum G{NULL};"), ""),
    (module("exception E { string what; }; exception F { };"), ""),
    (module('struct S { int id; string type = "x"; float len = 0.5; E e = a; bool b=true; };'), ""),
    (interface("idempotent void get(out int a, int b) throws E, RoboCompY::F;"), "RC158"),
    (interface("RoboCompY::T get(RoboCompY::T in); int a(); string b(); byte c();"), ""),
    (interface("[command] void stop(); [query] void get(out int x);"), ""),
    (interface("[command] void move(float x [mm], float a [rad]);"), ""),
    (module("struct S { float x [mm]; float y [degrees]; };"), ""),
    ("// a\n/* b */\n" + module("/** c */ interface X { /// d\n void a(); //e\n };"), ""),
    ("import \"A.idsl\"; import '/x/B.idsl';" + module(""), "RC109"),
    ('import "A.idsl"\nimport "B.idsl"\n' + module(""), "RC150 RC150"),
    (module("struct S { int a;; };"), "RC151"),
    (module("interface X { void a(); }"), "RC150"),
    (interface("void a(int);"), "RC156"),
    (interface("flush();"), "RC155"),
    (interface("void a() = 0;"), "RC157"),
    (interface("void a(out int x, int y);"), "RC158"),
    (module("void lost();"), "RC114"),
    (module("vector<StringPair> Pairs;"), "RC115"),
    ("Module RoboCompX { };", "RC111"),
    (module("") + "\n#endif", "RC154"),
    ("#ifndef X\n#define X\n" + module("") + "\n#endif", "RC154 RC154"),
    (module("") + module(""), "RC160"),
    (module("") + "};", "RC153"),
    ("<<<<<<< HEAD\n" + module("") + "\n=======\n>>>>>>> other\n", "RC117"),
    ("Component c { Communications { }; language Cpp; };", "RC003"),
]

SMDSL: list[tuple[str, str]] = [
    ("m { initial_state a; };", ""),
    ("m{ states b, c; INITIAL_STATE a; End_State d; Transitions{ a=>b,c; b => d; }; };", ""),
    ("m { initial_state a; transitions{ a => a; }; };\n:a parallel{ states x, y; };", ""),
    ("m { initial_state a; };\n\n:a{ initial_state b; };\n:b{ initial_state c; };\n", ""),
    ("/* m { states x; }; */\nm { initial_state a; // b\n };", ""),
    ("defaultMachine{ states compute; initial_state initialize; end_state finalize; };", ""),
    ("m { initial_state a; states b; transition{ a => b; }; };", "RC166"),
    ("m { initial_state a; transitions{ a => a } };", "RC150 RC150"),
]

PDSL: list[tuple[str, str]] = [
    ('ComponentParams c{\n\tdevice string "/dev/x" T;\n\tstart int 169 0:1000 T;\n};', ""),
    ("ComponentParams c{ angle float 1 0:10 T; talk bool true T; };", ""),
]

CASES = [
    (parse, text, expected)
    for parse, table in (
        (parse_cdsl, CDSL),
        (parse_idsl, IDSL),
        (parse_smdsl, SMDSL),
        (parse_pdsl, PDSL),
    )
    for text, expected in table
]


def found(parse: Parser, text: str) -> tuple[Source, Report]:
    source, report = Source(Path("x.dsl"), text), Report()
    parse(source, report)
    return source, report


@pytest.mark.parametrize(("parse", "text", "expected"), CASES)
def test_parser_reports_historical_syntax(parse: Parser, text: str, expected: str) -> None:
    _, report = found(parse, text)
    assert [d.code.id for d in report.sorted()] == expected.split(), text


@pytest.mark.parametrize(("parse", "text", "expected"), [c for c in CASES if c[2]])
def test_fixes_update_historical_syntax(parse: Parser, text: str, expected: str) -> None:
    def parse_text(changed: str) -> tuple[Source, list[Any]]:
        source, report = found(parse, changed)
        return source, report.sorted()

    _, report = found(parse, text)
    if report.has_errors:
        return
    fixed = fix_all(Source(Path("x.dsl"), text), parse_text)
    without = {d.code.id for d in report if d.fix is None}
    assert {d.code.id for d in fixed.remaining} <= without
    assert all(d.severity is not Severity.ERROR for d in fixed.remaining)
