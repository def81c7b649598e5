"""Paths of grammars, templates, interfaces and examples, in a wheel and in a checkout."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent
_INSTALLED = _PACKAGE / "share"
_ROOT = _INSTALLED if _INSTALLED.is_dir() else _PACKAGE.parent

GRAMMARS = _ROOT / "grammars"
TEMPLATES = _ROOT / "templates"
INTERFACES = _ROOT / "interfaces"
COMPONENTS = _ROOT / "components"
"""Example components, robots and demos, one folder each."""
