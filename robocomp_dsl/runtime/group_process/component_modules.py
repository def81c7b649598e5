"""Imports the modules of several components into one process, without clashes of their names.

Components have modules of the same names, such as `specificworker`. Those in the folder of a
component are loaded as submodules of a package of their own, so that `sys.modules` has them all.
Their `import` statements look into the folder of their component first, as they do when `main.py`
runs: the code of each module has an `__import__` of its component among its builtins.
"""

from __future__ import annotations

import builtins
import importlib
import re
import sys
from collections.abc import Mapping, Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import find_spec, resolve_name
from pathlib import Path
from types import ModuleType
from typing import Any

ROOT = "robocomp_components"
"""The package of the packages of components."""
_MARK = "__robocomp_component__"
_import = builtins.__import__
_import_module = importlib.import_module


class ComponentModules(MetaPathFinder):
    """The modules in the folder of one component; a finder of its package."""

    def __init__(self, name: str, folder: Path) -> None:
        self.folder = folder
        self.package = f"{ROOT}.{re.sub(r'[^0-9A-Za-z]', lambda m: f'_{ord(m[0]):x}_', name)}"
        self._own: dict[str, tuple[int, bool]] = {}
        self.builtins = {**vars(builtins), "__import__": self._import_name, _MARK: self}
        for package in (ROOT, self.package):
            if package not in sys.modules:
                module = ModuleType(package)
                module.__path__ = []
                sys.modules[package] = module
        sys.meta_path.insert(0, self)
        importlib.import_module = _import_module_of_caller

    def load(self, name: str) -> ModuleType:
        """The module `name` in the folder. Raises what its import raises."""
        return _import_module(f"{self.package}.{name}")

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,  # noqa: ARG002 - see `MetaPathFinder`
    ) -> ModuleSpec | None:
        """See `MetaPathFinder`: modules of the component get the builtins of the component."""
        if not fullname.startswith(f"{self.package}."):
            return None
        is_top = fullname.count(".") == self.package.count(".") + 1
        spec = PathFinder.find_spec(fullname, self._search_path() if is_top else path)
        if spec is not None and type(spec.loader) is SourceFileLoader:
            spec.loader = _ComponentLoader(fullname, spec.loader.path, self.builtins)
        return spec

    def _search_path(self) -> list[str]:
        """The folder, and folders in it that the component has added to `sys.path`."""
        own = str(self.folder)
        added = (entry for entry in sys.path if entry.startswith(f"{own}/"))
        return [own, *dict.fromkeys(added)]

    def _is_own(self, top: str) -> bool:
        """Whether the top-level module `top` is in the folder of the component."""
        entries, known = self._own.get(top, (0, False))
        if entries != len(sys.path):  # the component may have added a folder
            spec = PathFinder.find_spec(f"{self.package}.{top}", self._search_path())
            known = spec is not None and (
                spec.origin is not None
                # A folder without `__init__.py` is searched last.
                or (top not in sys.modules and find_spec(top) is None)
            )
            self._own[top] = len(sys.path), known
        return known

    def _import_name(
        self,
        name: str,
        globals_: Mapping[str, Any] | None = None,
        locals_: Mapping[str, Any] | None = None,
        fromlist: Sequence[str] | None = (),
        level: int = 0,
    ) -> ModuleType:
        """`__import__` for the code of the component."""
        top = name.partition(".")[0]
        if level or not self._is_own(top):
            return _import(name, globals_, locals_, fromlist or (), level)
        full = f"{self.package}.{name}"
        if fromlist:
            return _import(full, globals_, locals_, fromlist, 0)
        _import_module(full)
        return sys.modules[f"{self.package}.{top}"]

    def import_module(self, name: str, package: str | None) -> ModuleType:
        """`importlib.import_module` for the code of the component."""
        full = resolve_name(name, package) if name.startswith(".") else name
        own = not name.startswith(".") and self._is_own(full.partition(".")[0])
        return _import_module(f"{self.package}.{full}" if own else full)


class _ComponentLoader(SourceFileLoader):
    """Runs a module with the builtins of its component."""

    def __init__(self, fullname: str, path: str, names: dict[str, Any]) -> None:
        super().__init__(fullname, path)
        self._names = names

    def exec_module(self, module: ModuleType) -> None:
        """See `Loader`."""
        module.__dict__["__builtins__"] = self._names
        super().exec_module(module)


def _import_module_of_caller(name: str, package: str | None = None) -> ModuleType:
    """`importlib.import_module`, which knows from which component it is called."""
    names = sys._getframe(1).f_globals.get("__builtins__")
    modules = names.get(_MARK) if isinstance(names, dict) else None
    if isinstance(modules, ComponentModules):
        return modules.import_module(name, package)
    return _import_module(name, package)
