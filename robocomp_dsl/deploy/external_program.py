"""A program outside of a deployment, as data and as text. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class ExternalProgram:
    """A program outside of the deployment; `users` are the components connected to it.

    `role` and `interface` are those of its port: `implements`, `RoboCompLaser::Laser`.
    """

    name: str
    middleware: str
    address: str
    role: str
    interface: str
    users: tuple[str, ...]

    @staticmethod
    def from_dict(fields: Mapping[str, Any]) -> ExternalProgram:
        """The inverse of `as_dict`."""
        return ExternalProgram(**{**fields, "users": tuple(fields["users"])})

    def as_dict(self) -> dict[str, Any]:
        """The fields as a dictionary, for JSON."""
        return asdict(self) | {"users": list(self.users)}

    def format(self) -> tuple[str, str]:
        """`external scan: publishes RoboCompLaser::Scan`, and how it is connected."""
        address = f' at "{self.address}"' if self.address else ""
        users = f", used by {', '.join(self.users)}" if self.users else ""
        port = f"external {self.name}: {self.role} {self.interface}"
        return port, f"over {self.middleware}{address}{users}"
