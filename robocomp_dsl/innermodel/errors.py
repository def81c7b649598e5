"""The error of an InnerModel: a file that cannot be used, an unknown node, an invalid value."""

from __future__ import annotations

from robocomp_dsl.finding import Finding


class InnerModelError(ValueError):
    """A file that cannot be used as InnerModel, an unknown node, or an invalid value.

    `findings` locate the problems of a file, each with line, column and help; the message contains
    all of them. They are empty for an error of a call.
    """

    def __init__(self, message: str, findings: tuple[Finding, ...] = ()) -> None:
        super().__init__(message)
        self.findings = findings
