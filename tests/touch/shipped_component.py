"""A shipped component's own modules, for a test that runs it in its own process.

Component folders are no packages and each has a `specificworker`: the user's modules are loaded
with the folder in front of the path, and then kept under names of their own.
"""

from __future__ import annotations

import importlib
import sys
from functools import cache
from pathlib import Path
from types import SimpleNamespace

COMPONENTS = Path(__file__).parents[2] / "components"


@cache
def load(component: str) -> SimpleNamespace:
    """`worker` is the user's class, `interfaces` what is generated, `folder` where it is."""
    folder = COMPONENTS / component
    before = dict(sys.modules)
    own = {path.stem for path in folder.glob("*.py")}
    for name in [module for module in sys.modules if module.partition(".")[0] in own]:
        del sys.modules[name]
    sys.path.insert(0, str(folder))
    try:
        worker = importlib.import_module("specificworker").SpecificWorker
        interfaces = importlib.import_module(f"{component}_generated.interfaces")
    finally:
        sys.path.remove(str(folder))
        for name in [module for module in sys.modules if module.partition(".")[0] in own]:
            sys.modules[f"shipped_{component}.{name}"] = sys.modules.pop(name)
            if name in before:
                sys.modules[name] = before[name]
    return SimpleNamespace(worker=worker, interfaces=interfaces, folder=folder)
