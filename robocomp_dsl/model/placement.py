"""How the host of an instance is chosen when its deployment starts."""

from __future__ import annotations

from robocomp_dsl.record import Record, ValueRecord

LABEL, LOAD = "label", "load"


class Placement(ValueRecord):
    """How the host of an instance is chosen; `kind` is `LABEL`, `LOAD`, or "" if it is given.

    `candidates` are the names of the possible hosts, in order of declaration. Instances with the
    same `unit` (the group that says where they run, or their own name) run on the same host.
    """

    kind: str = ""
    label: str = ""
    candidates: tuple[str, ...] = ()
    unit: str = ""

    def __str__(self) -> str:
        """`on label gpu` or `by load on robot, desk`; empty if the host is given."""
        if self.kind == LABEL:
            return f"on label {self.label}"
        if self.kind != LOAD:
            return ""
        return f"by load on {f'label {self.label}' if self.label else ', '.join(self.candidates)}"


class LabelledHosts(Record):
    """The hosts that have a label, by name."""

    label: str
    hosts: tuple[str, ...]
