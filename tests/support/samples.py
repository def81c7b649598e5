"""The files that the tests open in every editor: an interface, what uses it, and mistakes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

LASER = """/** What a laser sees. */
module Scans
{
    struct Beam { float angle; float dist; };
    sequence<Beam> Scan;
    /** A planar laser. */
    interface Laser
    {
        Scan scan();
    };
};
"""
READER = """import "Laser.idsl";
/** Reads. */
Component reader
{
    Communications { requires Laser; };
    language Python;
};
"""
FILES = {
    "Laser.idsl": LASER,
    "reader.cdsl": READER,
    "wrong.cdsl": READER.replace("requires Laser", "requires Lasr").replace("reader", "wrong"),
    "wrong.idsl": LASER.replace("float dist", "floot dist").replace("Scans", "Wrong"),
    "wrong.pdsl": "ComponentParams wrong\n{\n    rate flaot 1;\n};\n",
    "wrong.ddsl": 'import "reader.cdsl";\nDeployment wrong\n{\n    component raeder;\n};\n',
    "wrong.xml": '<innerModel>\n    <transform id="a" id="b"/>\n</innerModel>\n',
    "wrong.scxml": '<scxml initial="a">\n    <state id="b"/>\n</scxml>\n',
    "ugly.cdsl": READER.replace("    Communications {", "Communications   {"),
}


@dataclass(frozen=True, slots=True)
class Mistake:
    """Where an editor must show a finding; line and column count from 0."""

    file: str
    line: int
    column: int
    message: str


MISTAKES = (
    Mistake("wrong.cdsl", 4, 30, "`Lasr`"),
    Mistake("wrong.idsl", 3, 31, "`floot`"),
    Mistake("wrong.pdsl", 2, 9, "`flaot`"),
    Mistake("wrong.ddsl", 3, 14, "`raeder`"),
    Mistake("wrong.scxml", 0, 16, "state `a`"),
    Mistake("wrong.xml", 1, 22, "`id`"),
)


def write(folder: Path) -> None:
    """Write the files into `folder`."""
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
