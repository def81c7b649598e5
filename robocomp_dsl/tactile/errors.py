"""What can go wrong with touch and the generic arm.

TactileError
    DescriptionError     a description or position file is wrong; holds every finding with its place
    InvalidCommand       a command holds NaN, or has the wrong number of values
    Unreachable          no joint angles within the limits reach the pose
    RejectedFrame        a taxel frame cannot be used; says why
    BadFit               points describe no cone
    BadGeometry          what a skin tells of its taxels contradicts itself
    InvalidField         a receptive field that this skin and this arm cannot have
    NoState              the arm has not been measured yet
    NoChain              the description gives no kinematic chain
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum, StrEnum


class TactileError(Exception):
    """Anything this package raises for its caller."""


class Fault(StrEnum):
    """What kind of fault a file has."""

    FORM = "form"
    JOINT = "joint"
    LIMITS = "limits"
    BODY = "body"
    OFF_BODY = "off body"
    TWICE = "twice"


@dataclass(frozen=True, slots=True)
class Finding:
    """One fault of a file, with line and column from 1; `help` is the way out, or empty."""

    file: str
    line: int
    column: int
    message: str
    help: str = ""
    fault: Fault = Fault.FORM

    def __str__(self) -> str:
        told = f"{self.file}:{self.line}:{self.column}: {self.message}"
        return f"{told} ({self.help})" if self.help else told


class DescriptionError(TactileError):
    """A file that cannot be used. `findings` are all its faults, in the order of the file."""

    def __init__(self, findings: Iterable[Finding]) -> None:
        self.findings = tuple(sorted(findings, key=lambda one: (one.file, one.line, one.column)))
        super().__init__("\n".join(str(one) for one in self.findings))


class BadFit(TactileError):
    """The points do not describe a cone; the message says why."""


class BadGeometry(TactileError):
    """What a skin tells of its taxels contradicts itself; the message says where."""


class InvalidField(TactileError):
    """A receptive field that this skin and this arm cannot have; the message says which and why."""


class NoState(TactileError):
    """A command that starts from where the arm is, before anybody knows where that is."""


class NoChain(TactileError):
    """A question about space to an arm of which only the joints are described."""


class InvalidCommand(TactileError):
    """The values of a command cannot be meant."""


class Unreachable(TactileError):
    """The best angles found and what is missing in position [m] and direction [rad]."""

    def __init__(self, message: str, *, distance: float, angle: float) -> None:
        super().__init__(message)
        self.distance = distance
        self.angle = angle


class FrameFault(Enum):
    """Why a taxel frame is not used."""

    NOT_FINITE = "it holds NaN or infinity"
    WRONG_LENGTH = "its length is not that of the geometry"
    OUT_OF_ORDER = "it is older than the last one"
    OTHER_GEOMETRY = "it was taken with another version of the geometry"


class RejectedFrame(TactileError):
    """A taxel frame that must not be used."""

    def __init__(self, fault: FrameFault, detail: str) -> None:
        super().__init__(f"{fault.value}: {detail}")
        self.fault = fault
