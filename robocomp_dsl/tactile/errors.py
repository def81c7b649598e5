"""Errors of touch and of the generic arm.

TactileError
    DescriptionError     a description or position file is invalid; contains all findings
    InvalidCommand       a command holds NaN, or has the wrong number of values
    Unreachable          no joint angles within the limits reach the pose
    RejectedFrame        a taxel frame cannot be used, with the reason
    BadFit               no cone fits the points
    BadGeometry          the geometry message of a skin is inconsistent
    InvalidField         a receptive field does not fit the skin or the arm
    NoState              no measurement of the arm has arrived yet
    NoChain              the description has no kinematic chain
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum, StrEnum

from robocomp_dsl.finding import Finding


class TactileError(Exception):
    """Base class of all errors of this package."""


class Fault(StrEnum):
    """Kind of a finding in a file."""

    FORM = "form"
    JOINT = "joint"
    LIMITS = "limits"
    BODY = "body"
    OFF_BODY = "off body"
    TWICE = "twice"
    DIRECTION = "direction"
    FRAME = "frame"
    CHAIN = "chain"
    SURFACE = "surface"
    UNANSWERED = "unanswered"


class DescriptionError(TactileError):
    """A file that cannot be used. `findings` are all problems, in the order of the file."""

    def __init__(self, findings: Iterable[Finding]) -> None:
        self.findings = tuple(sorted(findings, key=_file_order))
        super().__init__("\n".join(str(finding) for finding in self.findings))


def _file_order(finding: Finding) -> tuple[str, int, int]:
    return finding.location.file, finding.location.line, finding.location.column


class BadFit(TactileError):
    """No cone fits the points; the message gives the reason."""


class BadGeometry(TactileError):
    """The geometry message of a skin is inconsistent; the message says where."""


class InvalidField(TactileError):
    """A receptive field does not fit the skin or the arm; the message gives the reason."""


class NoState(TactileError):
    """A command needs the current pose of the arm, but no measurement has arrived yet."""


class NoChain(TactileError):
    """A Cartesian operation on an arm whose description has no kinematic chain."""


class InvalidCommand(TactileError):
    """A command holds invalid values."""


class Unreachable(TactileError):
    """A pose cannot be reached; `distance` [m] and `angle` [rad] are the remaining error."""

    def __init__(self, message: str, *, distance: float, angle: float) -> None:
        super().__init__(message)
        self.distance = distance
        self.angle = angle


class FrameFault(Enum):
    """Reasons of a rejected taxel frame."""

    NOT_FINITE = "it holds NaN or infinity"
    WRONG_LENGTH = "its length is not that of the geometry"
    OUT_OF_ORDER = "it is older than the last one"
    OTHER_GEOMETRY = "it was taken with another version of the geometry"


class RejectedFrame(TactileError):
    """A taxel frame was rejected."""

    def __init__(self, fault: FrameFault, detail: str) -> None:
        super().__init__(f"{fault.value}: {detail}")
        self.fault = fault
