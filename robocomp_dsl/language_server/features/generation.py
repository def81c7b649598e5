"""The command that generates a component: runs `rcgen component` or `rcgen bridge`.

In: a CDSL or BDSL file. Out: whether files were generated, and a message. The server stays
responsive; it kills the subprocess after a timeout, or when the client disconnects.
"""

from __future__ import annotations

import asyncio
import sys
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.language_server.session import Session, UnsupportedDocument
from robocomp_dsl.source import Source, UnreadableSource

RCGEN = (sys.executable, "-c", "from robocomp_dsl.cli.rcgen.main import main; main()")
GENERATION_TIMEOUT_S = 120.0
_COMMANDS = {".cdsl": "component", ".bdsl": "bridge"}
MAX_MESSAGE_LINES = 5
"""Findings in one message; the editor shows all findings in the file."""


@dataclass(frozen=True, slots=True)
class GenerationResult:
    """Whether files were generated, and a message for the user."""

    succeeded: bool
    message: str


async def generate(session: Session, path: Path) -> GenerationResult:
    """Generate the component in the saved file at `path`. Raises `UnsupportedDocument`."""
    if path.suffix.lower() not in _COMMANDS:
        raise UnsupportedDocument(
            f"`{path.name}` is not a component: select a `.cdsl` or `.bdsl` file"
        )
    unsaved = _unsaved(session, path)
    if unsaved:
        names = ", ".join(f"`{name}`" for name in unsaved)
        return GenerationResult(False, f"nothing was generated: save {names} first")
    return await _run(path)


def _unsaved(session: Session, path: Path) -> list[str]:
    """The names of the component's dependencies with unsaved changes."""
    try:
        dependencies = session.checked(path).dependencies
    except UnreadableSource as error:
        raise UnsupportedDocument(f"cannot read `{path.name}`: {error}") from None
    paths = (doc.path for key, doc in session.documents.items() if key in dependencies)
    return sorted(path.name for path in paths if _differs(session, path))


def _differs(session: Session, path: Path) -> bool:
    try:
        return Source.read(path).text != session.files.read(path).text
    except UnreadableSource:
        return True


async def _run(path: Path) -> GenerationResult:
    process = await asyncio.create_subprocess_exec(
        *(*RCGEN, _COMMANDS[path.suffix.lower()], path.name, "--format", "concise"),
        cwd=path.parent,
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
    )
    try:
        async with asyncio.timeout(GENERATION_TIMEOUT_S):
            output, findings = await process.communicate()
    except TimeoutError:
        message = f"nothing was generated: `rcgen` took more than {GENERATION_TIMEOUT_S:g} s"
        return GenerationResult(False, message)
    finally:
        if process.returncode is None:
            process.kill()
    if process.returncode == 0:
        summary = _text(output).partition(": ")[2] or "generated"
        return GenerationResult(True, f"`{path.name}`: {summary}")
    lines = _text(findings).splitlines()
    errors = [line for line in lines if ": error[" in line] or lines
    hidden = len(errors) - MAX_MESSAGE_LINES
    more = [f"and {hidden} more"] if hidden > 0 else []
    shown = "\n".join([*errors[:MAX_MESSAGE_LINES], *more])
    return GenerationResult(False, f"nothing was generated from `{path.name}`:\n{shown}")


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace").strip()
