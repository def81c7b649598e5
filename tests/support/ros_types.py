"""Runtime classes of ROS definitions, made the way a component gets them: checked and generated."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from itertools import count
from pathlib import Path
from types import ModuleType
from typing import Any

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.python.interface_code import interfaces_code
from robocomp_dsl.generate.python.python_types import PythonTypes
from robocomp_dsl.generate.templates import render
from robocomp_dsl.runtime.data.struct import Struct

_serial = count()


def ros_types(
    imports: Iterable[str], folder: Path, environ: Mapping[str, str] | None = None
) -> dict[str, type[Struct]]:
    """The structs of the imported definitions and of those that they use, by ROS name."""
    file = folder / "Imports.idsl"
    file.write_text("".join(f'import "{each}";\n' for each in imports) + "module Imports { };\n")
    report = Report()
    modules = check_idsl(file, Workspace(environ=environ or {}), report)
    assert not report.has_errors, [finding.message for finding in report]
    assert modules
    types = PythonTypes(modules[-1].closure())
    code = interfaces_code("x", (), (), {}, types)
    module: Any = ModuleType(f"ros_types_{next(_serial)}")
    sys.modules[module.__name__] = module
    exec(
        compile(render("python/component/interfaces.py.jinja", code=code), "x", "exec"),
        vars(module),
    )
    found = [each for each in vars(module).values() if isinstance(each, type)]
    return {each._type_id_: each for each in found if issubclass(each, Struct)}
