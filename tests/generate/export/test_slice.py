"""`--to slice`: compiled with slice2py of ZeroC."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import export
from robocomp_dsl.generate.exports.slice_names import SliceNames
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.slice_identifiers import operation_names, valid_name
from tests.generate.export import exported, random_idsl

SLICE2PY = shutil.which("slice2py")
compiled = pytest.mark.skipif(
    SLICE2PY is None and "CI" not in os.environ,  # there it must not be missing
    reason="needs slice2py: `make test-tools`, or package zeroc-ice-compilers of Debian",
)


def slice2py(folder: Path) -> str:
    """The messages of the compiler for all files of a folder; empty if they are valid."""
    assert SLICE2PY, "no slice2py"
    out = folder / "out"
    out.mkdir(exist_ok=True)
    files = sorted(map(str, folder.glob("*.ice")))
    done = subprocess.run(
        [SLICE2PY, "--output-dir", str(out), *files],
        capture_output=True,
        text=True,
        check=False,
    )
    output = done.stderr + done.stdout
    return output or ("failed in silence" if done.returncode else "")


@compiled
def test_slice_export_of_shipped_interfaces_compiles(tmp_path: Path) -> None:
    for name in exported.SHIPPED:
        files = export(exported.modules(INTERFACES / name), "slice")
        assert not files.findings
        exported.put(files.files, tmp_path)
    assert {p.stem for p in tmp_path.glob("*.ice")} >= {Path(n).stem for n in exported.SHIPPED}
    assert slice2py(tmp_path) == ""


@settings(max_examples=100)
@given(texts=random_idsl.texts())
def test_slice_names_of_operations_are_those_on_the_wire(texts: dict[str, str]) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in texts.items():
            (folder / file).write_text(text)
        modules = exported.modules(folder / "Text.idsl")
    names = SliceNames(modules, Report())
    for module in modules:
        for interface in module.interfaces:
            written = {o.name: names[o] for o in interface.operations}
            # A number that another declaration caused is not known on the wire.
            if names[interface] == valid_name(interface.name):
                assert operation_names(interface.name, written) == written


@compiled
@settings(max_examples=40)
@given(texts=random_idsl.texts())
def test_slice_export_of_random_interface_compiles(texts: dict[str, str]) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in texts.items():
            (folder / file).write_text(text)
        files = export(exported.modules(folder / "Text.idsl"), "slice")
        exported.put(files.files, folder)
        assert slice2py(folder) == "", "\n".join(written.text for written in files.files)
