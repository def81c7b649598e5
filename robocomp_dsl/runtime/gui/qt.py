"""PySide6, of the extra `gui`.

Importing this module raises `MissingExtra` if PySide6 is not installed, and `UnusableExtra` if the
system lacks a library that Qt loads, or if the version of PySide6 is not usable.
"""

from __future__ import annotations

import sys

from robocomp_dsl.extras import MissingExtra, UnusableExtra

PURPOSE = "a component with a window"
PACKAGES = "libegl1 libgl1 libxkbcommon0 libdbus-1-3 libfontconfig1 libglib2.0-0"
"""The packages of Debian and Ubuntu with the libraries that Qt loads at the import."""
INSTALL = f"{sys.executable} -m pip install 'robocomp_dsl[gui]'"

try:
    import PySide6
    from PySide6 import QtCore, QtGui, QtWidgets
except ModuleNotFoundError as error:
    raise MissingExtra(PURPOSE, "gui", error) from None
except ImportError as error:
    raise UnusableExtra(PURPOSE, str(error), f"sudo apt-get install {PACKAGES}") from None

if sys.version_info < (3, 12) and PySide6.__version__ == "6.12.0":
    # `Signal.emit` releases a reference to `True` that it does not own.
    REASON = "PySide6 6.12.0 ends Python 3.11 after some hundred signals"
    raise UnusableExtra(PURPOSE, REASON, INSTALL)

__all__ = ["QtCore", "QtGui", "QtWidgets"]
