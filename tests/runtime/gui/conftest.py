"""The tests of windows run offscreen; without PySide6 and its libraries they are skipped."""

from __future__ import annotations

import os

import pytest

from robocomp_dsl.extras import MissingExtra

os.environ["QT_QPA_PLATFORM"] = "offscreen"
try:
    from robocomp_dsl.runtime.gui import qt  # noqa: F401
except MissingExtra as error:
    if os.environ.get("CI"):
        raise
    pytest.skip(str(error), allow_module_level=True)
