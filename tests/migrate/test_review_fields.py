"""Fields that a struct of the found IDSL file lacks are reported with their line."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import parsed
from robocomp_dsl.migrate.review_fields import review_fields
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Source

IDSL = """module RoboCompEye {
    struct Point { float x; float y; };
    sequence<Point> Points;
    dictionary<string, Point> Named;
    struct View { Points points; Named named; Point centre; };
    interface Eye { View look(Point at); void pair(out Point left, out Point right); };
};
"""
HEAD = "class SpecificWorker(GenericWorker):\n    def f(self):\n"
HANDLER = "class SpecificWorker(GenericWorker):\n    def Eye_look(self, at):\n"


@pytest.fixture(scope="module")
def component(tmp_path_factory: pytest.TempPathFactory) -> Component:
    """A component that serves and calls the interface `Eye`."""
    folder = tmp_path_factory.mktemp("fields")
    (folder / "Eye.idsl").write_text(IDSL)
    cdsl = 'import "Eye.idsl"; Component arm { Communications { implements Eye; requires Eye; }; };'
    (folder / "arm.cdsl").write_text(cdsl)
    found = check_cdsl(folder / "arm.cdsl", Workspace((folder,)), Report())
    assert found is not None
    return found


def findings(component: Component, text: str) -> list[tuple[int, str]]:
    """Line and message of the findings about a module."""
    report = Report()
    review_fields([parsed(Source(Path("specificworker.py"), text))], component, report)
    assert {f.code.id for f in report} <= {"RC896"}
    return [(f.span.start_position[0], f.message.split(" in ")[0]) for f in report.sorted()]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("p = RoboCompEye.Point()\n        p.z = 3", (4, "`Point` has no field `z`")),
        ("p = ifaces.RoboCompEye.Point(z=3)", (3, "`Point` has no field `z`")),
        ("p = Point()\n        print(p.z)", (4, "`Point` has no field `z`")),
        ("v = self.eye_proxy.look(a)\n        v.size", (4, "`View` has no field `size`")),
        ("v = RoboCompEye.View()\n        v.centre.z", (4, "`Point` has no field `z`")),
        ("v = View()\n        v.points[0].z", (4, "`Point` has no field `z`")),
        ("v = View()\n        v.named['a'].z", (4, "`Point` has no field `z`")),
        (
            "v = View()\n        for p in v.points[1:]:\n            p.z = 1",
            (5, "`Point` has no field `z`"),
        ),
    ],
)
def test_review_fields_reports_line(
    component: Component, code: str, expected: tuple[int, str]
) -> None:
    assert findings(component, f"{HEAD}        {code}\n") == [expected]


def test_review_fields_reports_field_of_parameter(component: Component) -> None:
    assert findings(component, f"{HANDLER}        return at.z\n") == [
        (3, "`Point` has no field `z`")
    ]


@pytest.mark.parametrize(
    "code",
    [
        "p = RoboCompEye.Point(1.0, y=2.0)\n        p.x = p.y",
        "p = RoboCompEye.Point()\n        p = Other()\n        p.z = 3",
        "p, q = self.eye_proxy.pair()\n        p.z",
        "v = self.eye_proxy.look(a)\n        v.points.append(Point())\n        v.named.keys()",
        "v = View()\n        for key in v.named:\n            key.upper()",
        "v = View()\n        for i, p in enumerate(v.points):\n            p.z",
        "p = Point()\n        p.__class__\n        with open(f) as p:\n            p.z",
        "self.p = Point()\n        self.p.z",
    ],
)
def test_review_fields_accepts(component: Component, code: str) -> None:
    assert findings(component, f"{HEAD}        {code}\n") == []


def test_review_fields_skips_classes_of_the_module(component: Component) -> None:
    text = f"from shapes import Point\n{HEAD}        p = Point()\n        p.z = 3\n"
    assert findings(component, text) == []
