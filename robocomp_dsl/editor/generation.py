"""The command "generate component": `rcgen component` in a process of its own.

In: a CDSL file. Out: whether files were generated, and a message. The server answers others
meanwhile; a process that takes too long, or whose client leaves, is ended.
"""

from __future__ import annotations

import asyncio
import sys
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.editor.session import NoDescription, Session
from robocomp_dsl.source import Source, UnreadableSource

RCGEN = (sys.executable, "-c", "from robocomp_dsl.cli.rcgen import main; main()")
PATIENCE_S = 120.0
MOST_LINES = 5
"""Findings in one message; the editor shows all of them in the file."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of it, in words for the user."""

    done: bool
    message: str


async def generate(session: Session, path: Path) -> Outcome:
    """Generate the component in the saved file at `path`. Raises `NoDescription`."""
    if path.suffix.lower() != ".cdsl":
        raise NoDescription(f"`{path.name}` is no component: its name must end in `.cdsl`")
    unsaved = _unsaved(session, path)
    if unsaved:
        names = ", ".join(f"`{one}`" for one in unsaved)
        return Outcome(False, f"nothing was generated: save {names} first")
    return await _run(path)


def _unsaved(session: Session, path: Path) -> list[str]:
    """Names of the files behind a component whose text in the editor is not that on the disk."""
    try:
        asked = session.checked(path).asked
    except UnreadableSource as error:
        raise NoDescription(f"cannot read `{path.name}`: {error}") from None
    open_ones = (one for key, one in session.documents.items() if key in asked)
    return sorted(one.path.name for one in open_ones if _differs(session, one.path))


def _differs(session: Session, path: Path) -> bool:
    try:
        return Source.read(path).text != session.files.read(path).text
    except UnreadableSource:
        return True


async def _run(path: Path) -> Outcome:
    process = await asyncio.create_subprocess_exec(
        *(*RCGEN, "component", path.name, "--format", "concise"),
        cwd=path.parent,
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
    )
    try:
        async with asyncio.timeout(PATIENCE_S):
            said, findings = await process.communicate()
    except TimeoutError:
        return Outcome(False, f"nothing was generated: it took more than {PATIENCE_S:g} s")
    finally:
        if process.returncode is None:
            process.kill()
    if process.returncode == 0:
        return Outcome(True, f"`{path.name}`: {_text(said).partition(': ')[2] or 'generated'}")
    lines = _text(findings).splitlines()
    errors = [one for one in lines if ": error[" in one] or lines
    more = [f"and {len(errors) - MOST_LINES} more"] if len(errors) > MOST_LINES else []
    shown = "\n".join([*errors[:MOST_LINES], *more])
    return Outcome(False, f"nothing was generated from `{path.name}`:\n{shown}")


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace").strip()
