"""Imports modules that RoboComp's build generated from files of Qt Designer.

In: `import ui_login`, `import pictures_rc`. Out: the module that Qt's compilers generate from
`login.ui` and `pictures.qrc` in the folders of the component. Files of these names come first.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

from robocomp_dsl.runtime.gui.ui_file import compile_form, compile_resources


class _SourceLoader(Loader):
    """Loads a module from a file of Qt Designer."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def exec_module(self, module: ModuleType) -> None:
        """Run what Qt's compiler generates. Raises `WindowError`."""
        compiler = compile_form if self._path.suffix == ".ui" else compile_resources
        exec(compile(compiler(self._path), str(self._path), "exec"), vars(module))  # noqa: S102


class FormFinder(MetaPathFinder):
    """Finds forms (`ui_NAME`) and resources (`NAME_rc`) in some folders."""

    def __init__(self, folders: Sequence[Path]) -> None:
        self.folders = tuple(folders)

    def find_spec(
        self, fullname: str, _path: object = None, _target: object = None
    ) -> ModuleSpec | None:
        """The module of a file; None if there is no file for this name."""
        if fullname.startswith("ui_"):
            file = f"{fullname.removeprefix('ui_')}.ui"
        elif fullname.endswith("_rc"):
            file = f"{fullname.removesuffix('_rc')}.qrc"
        else:
            return None
        path = next((p for folder in self.folders if (p := folder / file).is_file()), None)
        return ModuleSpec(fullname, _SourceLoader(path), origin=str(path)) if path else None


def install_finder(folder: Path) -> None:
    """Find the forms of the component in `folder`, after all other modules."""
    folders = (folder, folder / "src")
    if not any(isinstance(f, FormFinder) and f.folders == folders for f in sys.meta_path):
        sys.meta_path.append(FormFinder(folders))
