"""Modules beside the worker keep their place, and what they read stays where it was."""

from __future__ import annotations

import ast
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.migrate.review_names import PROVIDED
from tests.migrate.processes import running

Rcgen = Callable[..., object]
WORKER = "from genericworker import *\nclass SpecificWorker(GenericWorker):\n    pass\n"
CDSL = "Component arm { Communications { }; language python; };\n"


def component(folder: Path, files: dict[str, str]) -> Path:
    """A component folder `arm` with these files."""
    for name, text in ({"arm.cdsl": CDSL, "src/specificworker.py": WORKER} | files).items():
        path = folder / "arm" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "arm"


def test_migrate_relative_imports_of_worker(rcgen, tmp_path: Path) -> None:
    folder = component(
        tmp_path,
        {
            "src/__init__.py": "",
            "src/model/__init__.py": "",
            "src/model/state.py": "from ..gains import GAIN\nSTATE = GAIN\n",
            "src/gains.py": "from .genericworker import QtCore\nGAIN = 3\n",
            "src/specificworker.py": "from .genericworker import *\n"
            "from .model.state import STATE\nfrom . import gains\n"
            "class SpecificWorker(GenericWorker):\n"
            "    def compute(self):\n"
            "        print('STATE', STATE, gains.GAIN, flush=True)\n",
        },
    )
    done = rcgen("migrate", folder)
    assert done.code == 0, done.err
    out = tmp_path / "arm-migrated"
    worker = (out / "specificworker.py").read_text()
    assert (
        "from legacy import *\nfrom src.model.state import STATE\nfrom src import gains" in worker
    )
    with running(out, "--middleware", "inproc") as arm:
        assert arm.wait_for("STATE") == "STATE 3 3"


def test_migrate_optional_relative_import_is_unchanged(rcgen, tmp_path: Path) -> None:
    text = "try:\n    from .gains import G\nexcept ImportError:\n    from gains import G\n" + WORKER
    folder = component(tmp_path, {"src/specificworker.py": text, "src/gains.py": "G = 1\n"})
    assert rcgen("migrate", folder).code == 0
    worker = (tmp_path / "arm-migrated/specificworker.py").read_text()
    assert "    from .gains import G\nexcept ImportError:\n    from gains import G\n" in worker


@pytest.mark.parametrize(
    "name",
    ["GUI.py", "views/GUI.py", "views/interfaces.py", "views/main.py", "ui_report.py"],
)
def test_migrate_keeps_modules_with_names_of_generated_files(
    rcgen, tmp_path: Path, name: str
) -> None:
    folder = component(tmp_path, {f"src/{name}": "X = 1\n"})
    assert rcgen("migrate", folder).code == 0
    assert (tmp_path / "arm-migrated" / name).read_text() == "X = 1\n"


@pytest.mark.parametrize(
    ("files", "name"),
    [
        ({"src/laserI.py": "X = 1\n"}, "laserI.py"),
        ({"src/ui_mainUI.py": "X = 1\n"}, "ui_mainUI.py"),
        ({"src/ui_report.py": "X = 1\n", "src/report.ui": "<ui/>"}, "ui_report.py"),
        ({"src/arm.py": "from specificworker import *\nw = SpecificWorker({})\n"}, "arm.py"),
    ],
)
def test_migrate_drops_generated_modules(
    rcgen, tmp_path: Path, files: dict[str, str], name: str
) -> None:
    rcgen("migrate", component(tmp_path, files))
    assert not (tmp_path / "arm-migrated" / name).exists()


def test_migrate_keeps_module_that_is_named_like_the_component(rcgen, tmp_path: Path) -> None:
    files = {
        "src/arm.py": "class Arm:\n    pass\n",
        "src/specificworker.py": f"import arm\n{WORKER}",
    }
    done = rcgen("migrate", component(tmp_path, files))
    assert done.code == 0, done.err
    assert (tmp_path / "arm-migrated/arm.py").read_text() == files["src/arm.py"]


@pytest.mark.parametrize(
    ("code", "copied"),
    [
        ("open('./etc/config')", True),
        ('os.path.join(here, "etc", "config")', True),
        ('Path("etc") / "config"', True),
        ("open('etc/config_other')", False),
        ("read('config')", False),
    ],
)
def test_migrate_copies_configuration_that_code_reads(
    rcgen, tmp_path: Path, code: str, copied: bool
) -> None:
    text = WORKER.replace("    pass", f"    def setParams(self, params):\n        {code}")
    files = {"src/specificworker.py": text, "etc/config": "speed = 1.50\n"}
    rcgen("migrate", component(tmp_path, files))
    out = tmp_path / "arm-migrated"
    assert (out / "etc/config").exists() is copied
    assert (out / "etc/config.yaml").exists()


def test_migrate_provides_names_of_genericworker(rcgen, tmp_path: Path) -> None:
    assert rcgen("migrate", component(tmp_path, {})).code == 0
    tree = ast.parse((tmp_path / "arm-migrated/legacy.py").read_text())
    listed = next(
        ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
    )
    assert set(listed) >= PROVIDED
