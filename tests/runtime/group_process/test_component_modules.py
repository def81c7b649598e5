"""Modules of several components in one process: the same names, without clashes."""

from __future__ import annotations

import importlib
import pickle
import sys
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from robocomp_dsl.runtime.group_process.component_modules import ROOT, ComponentModules

Load = Callable[[str, dict[str, str]], ComponentModules]


@pytest.fixture
def load(tmp_path: Path) -> Iterator[Load]:
    """Writes the files of a component, and returns its modules."""
    finders, path, import_module = list(sys.meta_path), list(sys.path), importlib.import_module

    def write_and_load(name: str, files: dict[str, str]) -> ComponentModules:
        for file, text in files.items():
            target = tmp_path / name / file
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text)
        return ComponentModules(f"{name}-{uuid.uuid4().hex}", tmp_path / name)

    yield write_and_load
    sys.meta_path[:], sys.path[:] = finders, path
    importlib.import_module = import_module
    for module in [each for each in sys.modules if each.startswith(f"{ROOT}.")]:
        del sys.modules[module]


def files_of(name: str) -> dict[str, str]:
    """A component as rcgen lays it out, with a module that is imported late."""
    return {
        "main.py": "from specificworker import Worker\n",
        "specificworker.py": "from src.parts import NAME\nimport src.parts as parts\n"
        "import gen.base\nclass Worker(gen.base.Base):\n    name = NAME\n"
        "    def late(self):\n        import late\n        return late.VALUE\n"
        "    def by_name(self):\n        import importlib\n"
        "        return importlib.import_module('late').VALUE\n",
        "src/parts.py": f"NAME = {name!r}\n",
        "gen/__init__.py": "",
        "gen/base.py": "from .types import Base\n",
        "gen/types.py": "class Base:\n    pass\n",
        "late.py": f"VALUE = 'late {name}'\n",
    }


def test_component_modules_of_same_names_are_separate(load: Load) -> None:
    left, right = load("left", files_of("left")), load("right", files_of("right"))
    workers = [modules.load("main").Worker for modules in (left, right)]
    assert [worker.name for worker in workers] == ["left", "right"]
    assert [worker().late() for worker in workers] == ["late left", "late right"]
    assert [worker().by_name() for worker in workers] == ["late left", "late right"]
    assert workers[0].__mro__[1] is not workers[1].__mro__[1]
    assert "specificworker" not in sys.modules


def test_component_modules_of_one_folder_are_separate_for_each_instance(load: Load) -> None:
    files = {"main.py": "import state\n", "state.py": "count = 0\n"}
    first, second = load("same", files), load("same", files)
    first.load("state").count = 5
    assert second.load("state").count == 0


def test_component_modules_find_classes_by_their_module_names(load: Load) -> None:
    text = (
        "from __future__ import annotations\nfrom dataclasses import dataclass\n"
        "@dataclass\nclass Point:\n    x: int = 0\n"
    )
    modules = load("points", {"points.py": text})
    point = modules.load("points").Point(3)
    assert pickle.loads(pickle.dumps(point)) == point


def test_component_modules_search_folders_that_a_component_adds(load: Load) -> None:
    text = (
        "import sys\nfrom pathlib import Path\n"
        "sys.path.append(str(Path(__file__).parent / 'lib'))\nimport tools\nNAME = tools.NAME\n"
    )
    loaded = [
        load(name, {"main.py": text, "lib/tools.py": f"NAME = {name!r}\n"}).load("main").NAME
        for name in ("left", "right")
    ]
    assert loaded == ["left", "right"]


def test_component_modules_leave_libraries_alone(load: Load) -> None:
    text = "import json, os.path\nfrom json import dumps\nimport json.decoder as decoder\n"
    modules = load("plain", {"main.py": text, "json_like/data.txt": ""})
    main = modules.load("main")
    assert main.json is sys.modules["json"]
    assert main.decoder is sys.modules["json.decoder"]
    assert main.os is sys.modules["os"]


def test_component_modules_report_missing_module_by_its_own_name(load: Load) -> None:
    modules = load("broken", {"main.py": "import no_such_module_here\n"})
    with pytest.raises(ModuleNotFoundError, match="No module named 'no_such_module_here'"):
        modules.load("main")
