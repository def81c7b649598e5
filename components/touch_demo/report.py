"""The report at the end of the demo.

In: recordings. Out: a table on the terminal, a picture, and the failures.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isnan
from pathlib import Path

from body import Body
from figure import PHOTO_PIXELS, draw
from metrics import TouchMetrics, outcomes, table
from panel import Column
from photograph import before_and_after, best_seen
from recording import Recording
from subject import Subject

from robocomp_dsl.hardware.devices.errors import NoRendering

TITLE = "A finger touches, the arm withdraws: one reflex, two robots"
_LEAST_SCALE = 0.1  # N


def report(
    subjects: Sequence[Subject], recordings: Sequence[Recording], picture: Path
) -> list[str]:
    """Print the table and draw the picture; returns the failures."""
    highest = max(_LEAST_SCALE, *(float(item.force.max(initial=0.0)) for item in recordings))
    columns = [
        _column(subject, recording, highest)
        for subject, recording in zip(subjects, recordings, strict=True)
    ]
    rows = [row for column in columns for row in column.outcomes]
    print()
    for line in table(rows):
        print(line)
    print()
    for why in dict.fromkeys(item.why_not for item in columns if item.why_not):
        print(f"no photographs in the picture: {why}")
    draw(columns, TITLE, facts(rows), highest, picture)
    print(f"picture: {picture.resolve()}")
    return [row.trouble for row in rows if row.trouble]


def _column(subject: Subject, recording: Recording, highest: float) -> Column:
    body = Body(subject.world, recording.skin, subject.part)
    found = outcomes(recording, body)
    shown = best_seen(recording, body, found)
    if shown.trouble:
        return Column(recording, found, shown, None, f"no arm of {subject.name} withdrew")
    try:
        photos = before_and_after(recording, body, shown, highest, PHOTO_PIXELS)
    except NoRendering as error:
        return Column(recording, found, shown, None, str(error))
    return Column(recording, found, shown, photos)


def facts(rows: Sequence[TouchMetrics]) -> str:
    """The outcomes of all touches in one line."""
    good = [row for row in rows if not row.trouble]
    parts = [f"{len(good)} of {len(rows)} touches: the arm withdrew"]
    for before, values, after in (
        ("by ", [row.withdrawn for row in good], "mm"),
        ("first motion ", [row.moved_after for row in good], "ms after the contact"),
        ("free after ", [row.cleared_after for row in good], "ms"),
    ):
        known = [value for value in values if not isnan(value)]
        if known:
            parts.append(f"{before}{_span(known)} {after}")
    return parts[0] + (" " + " · ".join(parts[1:]) if good else "")


def _span(values: Sequence[float]) -> str:
    ends = dict.fromkeys(f"{end:.0f}" for end in (min(values), max(values)))
    return " to ".join(ends)
