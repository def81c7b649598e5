"""The report of a hang: what hangs, where, and since when.

In: what a watchdog found. Out: a `HangReport`, which travels as JSON from a component to rcdeploy.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass


@dataclass(frozen=True, slots=True)
class HangReport:
    """A hang: `activity` is what hangs, `location` the innermost line of user code.

    `at` in s since 1970; `seconds` is how long it has been running; `stack` has the outermost call
    first.
    """

    at: float
    activity: str
    seconds: float
    location: str
    stack: tuple[str, ...]

    def summary(self) -> str:
        """One line of text."""
        where = f" at {self.location}" if self.location else ""
        return f"{self.activity} has hung for {self.seconds:.1f} s{where}"

    def to_json(self) -> str:
        """The report as one line of JSON."""
        return json.dumps(asdict(self))

    @staticmethod
    def from_json(line: str) -> HangReport:
        """The inverse of `to_json`. Raises `ValueError`."""
        return HangReport.from_fields(json.loads(line))

    @staticmethod
    def from_fields(fields: object) -> HangReport:
        """The report of the fields in its JSON. Raises `ValueError`."""
        if not isinstance(fields, dict):
            raise ValueError("a report is a JSON object")  # noqa: TRY004 - one error for all faults
        try:
            return HangReport(
                float(fields["at"]),
                str(fields["activity"]),
                float(fields["seconds"]),
                str(fields["location"]),
                tuple(map(str, fields["stack"])),
            )
        except (KeyError, TypeError) as error:
            raise ValueError(f"a report without a valid field {error}") from None
