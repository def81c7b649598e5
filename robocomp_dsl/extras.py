"""Libraries that only an optional extra of `robocomp_dsl` installs.

In: a failed import. Out: an error whose message says how to install what is missing.
"""

from __future__ import annotations

import sys


class MissingExtra(ModuleNotFoundError):
    """A library of an optional extra is not installed; the message says what to do."""

    def __init__(self, purpose: str, extra: str, error: ModuleNotFoundError) -> None:
        """`purpose` begins the message: what needs the library, as in "the language server"."""
        module = (error.name or "").partition(".")[0]
        super().__init__(
            f"{purpose} needs the module `{module}`, which {sys.executable} does not have; "
            f"install it: {sys.executable} -m pip install 'robocomp_dsl[{extra}]'",
            name=module,
        )
        self.extra = extra


class UnusableExtra(MissingExtra):
    """The library of an extra is installed but cannot be used; the message says what to do."""

    def __init__(self, purpose: str, reason: str, command: str) -> None:
        """`command` installs what is needed."""
        message = f"{purpose} cannot start: {reason}; install it: {command}"
        ModuleNotFoundError.__init__(self, message)
