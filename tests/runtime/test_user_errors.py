"""Locations of errors in user code, and their tracebacks."""

from __future__ import annotations

import importlib.util
import json
import logging
import sys
from pathlib import Path
from types import ModuleType

import pytest

from robocomp_dsl.runtime.component import user_errors

WORKER = """
from helpers_of_others import divide
class SpecificWorker:
    def compute(self):
        return self.ratio()
    def ratio(self):
        return divide(1, 0)  # line 7
    def load(self):
        import json
        return json.loads("{")  # line 10
"""
SHARED = """
def divide(a, b):
    return a / b
"""


def load(path: Path, text: str) -> ModuleType:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def worker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> type:
    """A worker in a folder of its own that calls code in another folder."""
    monkeypatch.setattr(user_errors, "_user_folders", set())
    for name in ("helpers_of_others", "worker_module"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))
    load(tmp_path / "shared" / "helpers_of_others.py", SHARED)
    cls: type = load(tmp_path / "arm" / "worker_module.py", WORKER).SpecificWorker
    return cls


def error_of(worker: type, method: str) -> Exception:
    try:
        getattr(worker(), method)()
    except Exception as error:
        return error
    raise AssertionError(f"{method} did not fail")


def test_describe_error_names_line_in_folder_of_component(worker: type, tmp_path: Path) -> None:
    user_errors.add_user_folder(worker)
    location = f"({tmp_path / 'arm' / 'worker_module.py'}:7)"
    text = user_errors.describe_error(error_of(worker, "compute"))
    assert text == f"ZeroDivisionError: division by zero {location}"


def test_describe_error_names_innermost_user_code_without_component(
    worker: type, tmp_path: Path
) -> None:
    text = user_errors.describe_error(error_of(worker, "compute"))
    assert text.endswith(f"({tmp_path / 'shared' / 'helpers_of_others.py'}:3)")


def test_describe_error_skips_standard_library(worker: type) -> None:
    user_errors.add_user_folder(worker)
    assert user_errors.describe_error(error_of(worker, "load")).endswith("worker_module.py:10)")


@pytest.mark.parametrize("folder", ["site-packages", "dist-packages"])
def test_is_library_code_covers_installed_packages(tmp_path: Path, folder: str) -> None:
    path = tmp_path / "arm" / ".venv" / "lib" / folder / "lib" / "code.py"
    assert user_errors.is_library_code(str(path))
    assert user_errors.is_library_code(json.__file__)
    assert not user_errors.is_library_code(str(tmp_path / "arm" / "specificworker.py"))


@pytest.mark.parametrize("is_requested", [False, True])
def test_log_error_shows_traceback_on_request(
    worker: type,
    is_requested: bool,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    monkeypatch.setenv(user_errors.TRACEBACK_VARIABLE, "1" if is_requested else "")
    with caplog.at_level(logging.DEBUG):
        user_errors.log_failure("compute", error_of(worker, "compute"))
    [record] = caplog.records
    assert record.getMessage().startswith("compute failed: ZeroDivisionError: division by zero (")
    assert (user_errors.HINT in record.getMessage()) is not is_requested
    assert bool(record.exc_info) is is_requested
