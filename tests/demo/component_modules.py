"""The modules of the shipped components, loaded one by one: their folders are no packages."""

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

COMPONENTS = Path(__file__).parents[2] / "components"


def load(path: str) -> ModuleType:
    """The module at `path` below `components`."""
    name = "shipped_" + path.replace("/", "_").removesuffix(".py")
    if name not in sys.modules:
        spec = spec_from_file_location(name, COMPONENTS / path)
        assert spec is not None
        assert spec.loader is not None
        sys.modules[name] = module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]
