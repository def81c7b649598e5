"""Pages of documentation: valid HTML, working links, and the described content."""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from pathlib import Path

import pytest

from robocomp_dsl.check.workspace.workspace import Workspace
from tests.check.other_middlewares import OTHER_MIDDLEWARES
from tests.doc import doc_site
from tests.doc.doc_site import DEMO, ROOT, check_links, headings, pages, read

INTERFACES = sorted((ROOT / "interfaces").glob("*.idsl"))


@pytest.fixture(scope="module")
def demo() -> dict[str, str]:
    """The pages of the demo."""
    return pages(DEMO)


@pytest.fixture(scope="module")
def library() -> dict[str, str]:
    """The pages of all shipped interfaces."""
    return pages(*INTERFACES)


def test_links_of_pages_resolve(demo: dict[str, str], library: dict[str, str]) -> None:
    assert check_links(demo) > 300
    assert check_links(library) > 3000


def test_documentation_has_page_per_declaration(demo: dict[str, str]) -> None:
    names = {path for path in demo if path.endswith(".html")}
    assert names == {
        "index.html",
        "components/mobile_base.html",
        "components/path_logger.html",
        "components/wander.html",
        "deployments/wander.html",
        "interfaces/RoboCompClock.Clock.html",
        "interfaces/RoboCompDifferentialRobot.DifferentialRobot.html",
        "interfaces/RoboCompDifferentialRobotPub.DifferentialRobotPub.html",
        "interfaces/RoboCompGenericBase.GenericBase.html",
        "interfaces/RoboCompLaser.Laser.html",
        "interfaces/RoboCompPathLog.PathLog.html",
        "modules/RoboCompClock.html",
        "modules/RoboCompDifferentialRobot.html",
        "modules/RoboCompDifferentialRobotPub.html",
        "modules/RoboCompGenericBase.html",
        "modules/RoboCompLaser.html",
        "modules/RoboCompPathLog.html",
    }
    assert {path.removesuffix(".html") + ".md" for path in names} <= set(demo)


SHOWN = [
    ("interfaces/RoboCompLaser.Laser", "TLaserData getLaserAndBStateData(out TBaseState bState);"),
    ("interfaces/RoboCompLaser.Laser", "The latest scan, and the state of the base"),
    ("interfaces/RoboCompLaser.Laser", "angle float rad"),
    ("interfaces/RoboCompLaser.Laser", "mobile_base implements it"),
    ("interfaces/RoboCompLaser.Laser", "wander requires it"),
    ("components/wander", "Laser requires Laser query getLaserData, getLaserAndBStateData"),
    ("components/wander", "threshold live float 620 1 … 10000 mm An obstacle closer"),
    ("components/wander", "side live one of freer, random freer Turning direction"),
    ("components/mobile_base", "laser.degrees float 240 1 … 360 deg Width of the scan"),
    ("components/mobile_base", "Computes every 10 ms"),
    ("components/path_logger", "Computes only on events"),
    ("deployments/wander", "wander.Laser mobile_base.Laser Laser query"),
    ("deployments/wander", 'file = "../../build/wander/path.csv"'),
    ("deployments/wander", "ready within 30 s"),
]


@pytest.mark.parametrize(("page", "text"), SHOWN)
def test_page_shows_description(demo: dict[str, str], page: str, text: str) -> None:
    assert text in read(demo[f"{page}.html"]).text


def test_deployment_page_shows_full_instance_name(tmp_path: Path) -> None:
    ddsl = tmp_path / "left.ddsl"
    wander = DEMO.parent / "wander.cdsl"
    base = ROOT / "components" / "mobile_base" / "mobile_base.cdsl"
    ddsl.write_text(
        f'import "{wander}";\nimport "{base}";\n'
        "Deployment d { component wander { prefix left; }; component mobile_base; };\n"
    )
    assert "runs as left/wander" in read(pages(ddsl)["deployments/d.html"]).text


def test_deployment_page_shows_connections_between_external_programs(tmp_path: Path) -> None:
    (tmp_path / "d.ddsl").write_text(
        'Deployment d { program p { executable "p"; ready after 1 s; };'
        ' connect yarp "/a:o" -> "/b:i" carrier fast_tcp; };'
    )
    text = read(pages(tmp_path / "d.ddsl")["deployments/d.html"]).text
    assert "Connections between external programs" in text
    assert all(word in text for word in ("/a:o", "/b:i", "yarp", "fast_tcp"))


def test_deployment_page_shows_external_programs_and_monitors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(doc_site, "Workspace", partial(Workspace, middlewares=OTHER_MIDDLEWARES))
    (tmp_path / "limits.py").write_text(
        "class Limit(Monitor):\n    def accept(self, operation, arguments):\n        return True\n"
    )
    ddsl = tmp_path / "app.ddsl"
    wander = DEMO.parent / "wander.cdsl"
    logger = ROOT / "components" / "path_logger" / "path_logger.cdsl"
    ddsl.write_text(
        f'import "{wander}";\nimport "{logger}";\n'
        """Deployment app
        {
            component wander; component path_logger;
            /// The laser of the old robot.
            extern laser over rpc at "laser:tcp -p 10001" implements Laser;
            extern base over rpc at "base:tcp -p 10001" implements DifferentialRobot;
            extern odometry over bus at "/odom" publishes DifferentialRobotPub;
            connect wander.Laser -> laser.Laser;
            connect wander.DifferentialRobot -> base.DifferentialRobot
            {
                monitor "limits.py" Limit;
            };
            connect odometry.DifferentialRobotPub -> path_logger.DifferentialRobotPub
            {
                latched; keep last 2; liveliness 500 ms; thread priority 5;
            };
        };
        """
    )
    site = pages(ddsl)
    text = read(site["deployments/app.html"]).text
    assert "Middleware that of each component" in text
    assert "laser Laser implements rpc laser:tcp -p 10001 The laser of the old robot." in text
    assert "wander.Laser laser.Laser Laser query rpc" in text
    assert "monitor Limit" in text
    assert "keep last 2, latched, liveliness 500 ms, thread priority 5" in text
    assert "2 components, 3 connections" in site["deployments/app.html"]
    assert check_links(site) > 20


def test_page_headings_descend_by_one_level(demo: dict[str, str]) -> None:
    for path, text in demo.items():
        if path.endswith(".html"):
            main = read(text[text.index("<main") : text.index("</main>") + len("</main>")])
            levels = headings(main.tags)
            assert levels[0] == 1
            assert levels.count(1) == 1
            assert all(b <= a + 1 for a, b in pairwise(levels)), path


def test_pages_load_no_external_resources(demo: dict[str, str]) -> None:
    for path, text in demo.items():
        assert "://" not in text.replace("http://www.w3.org/2000/svg", ""), path
        assert "<script" not in text
        assert "@import" not in text


def test_documentation_is_deterministic(demo: dict[str, str]) -> None:
    assert pages(DEMO) == demo


def test_deployment_page_draws_a_group_as_one_box(tmp_path: Path) -> None:
    parts = ROOT / "tests" / "cases" / "ddsl" / "sem_parts"
    (tmp_path / "app.ddsl").write_text(f"""
        import "{parts}/body.cdsl";
        import "{parts}/reflex.cdsl";
        group arm {{ component body; component reflex; export LaserPub from body as Seen;
            export Laser from body; }};
        Deployment app {{
            group left : arm {{ inprocess; prefix far; }};
            group both {{ group right : arm; }};
            component reflex;
            connect left.Seen -> reflex.LaserPub;
            connect reflex.Laser -> left.Laser;
        }};
    """)
    written = pages(tmp_path / "app.ddsl")
    text = written["deployments/app.html"]
    figures = text.split('role="group" aria-label="Components of')[1:]
    boxes = [figure.partition("</svg>")[0] for figure in figures]
    assert len(boxes) == 4
    assert ">arm, 2 components, one process</text>" in boxes[0]
    assert ">left-body</text>" not in boxes[0]
    assert ">left-body</text>" in boxes[1]
    assert ">both-right</text>" in boxes[2]
    assert ">both-right-body</text>" in boxes[3]
    page = read(text).text
    assert "instance of arm, one process, prefix far" in page
