"""Three-way merge of files that are written once and then belong to the user.

In: the new output of such files, and the folder with the user's versions and, in `.rcgen/`, their
pristine outputs. Out: the files to write. `git merge-file` merges; if both sides changed the same
lines, the user's file stays, and the proposal with conflict markers is written to `.rcgen/` beside
the pristine output.
"""

from __future__ import annotations

import re
import stat
from collections.abc import Iterable, Iterator
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.output import MANIFEST_FOLDER, OutputFile
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.source import Source

PRISTINE = f"{MANIFEST_FOLDER}pristine"
CONFLICTS = f"{MANIFEST_FOLDER}conflicts"
PATIENCE_S = 30.0
_CONFLICT = re.compile(
    r"^<{7} yours\r?\n(?P<yours>.*?)^\|{7} before\r?$.*?^={7}\r?\n(?P<new>.*?)^>{7} new\r?$",
    re.MULTILINE | re.DOTALL,
)


def merged(
    folder: Path, files: Iterable[OutputFile], report: Report, *, writes: bool = True
) -> Iterator[OutputFile]:
    """The files to write for `files`; files that are always rewritten pass unchanged.

    Without `writes` the findings describe what would be done.
    """
    for file in files:
        if file.write_once:
            yield from _merge_user_file(folder, file, report, writes=writes)
        else:
            yield file


def _merge_user_file(
    folder: Path, new: OutputFile, report: Report, *, writes: bool
) -> Iterator[OutputFile]:
    """The user's file after the merge, and the pristine output that it is based on."""
    path = folder / new.path
    mine, base = _read(path), _read(folder / PRISTINE / new.path)
    pristine = OutputFile(f"{PRISTINE}/{new.path}", new.text)
    if mine is None or base is None or new.data in (base, mine):
        yield from (new, pristine)
    elif fixed := _fixed(path):
        _report(path, mine, f"the file is {fixed}, so it stays as it is", report)
        yield from (new, pristine)
    elif mine == base:
        yield from (new.replace(write_once=False, expected_bytes=mine), pristine)
    elif (result := _merge(mine, _as_mine(base, mine), _as_mine(new.data, mine))) is None:
        message = "rcgen would write it anew; git could not merge, so it stays"
        _report(path, mine, message, report, "install git and run rcgen again")
        yield new  # the pristine output is unchanged, too, so that the next run can merge
    elif result[1]:
        yield from (new, _proposal(path, new, mine, result[0], report, writes=writes), pristine)
    else:
        _report_merged(path, mine, result[0], report, writes=writes)
        text = result[0].decode("utf-8", "surrogateescape")
        yield from (OutputFile(new.path, text, expected_bytes=mine), pristine)


def _fixed(path: Path) -> str:
    """Why rcgen cannot write to a file of the user; empty if it can."""
    if path.is_symlink():
        return "a link"
    return "" if path.stat().st_mode & stat.S_IWUSR else "read-only"


def _proposal(
    path: Path, new: OutputFile, mine: bytes, data: bytes, report: Report, *, writes: bool
) -> OutputFile:
    """Both sides with conflict markers."""
    proposal = f"{CONFLICTS}/{new.path}"
    message = "you and rcgen changed the same lines, so it stays as it is"
    where = f"both sides {'are' if writes else 'would be'} in {proposal}; take what you need"
    source = Source(path, mine.decode("utf-8", "replace"))
    yours, theirs = _first_conflict(data.decode("utf-8", "replace"))
    at = max(source.text.find(yours), 0) if yours else 0
    span = source.span(at, at + len(yours.partition("\n")[0].rstrip("\r")))
    label = f"rcgen has `{theirs}` here" if theirs else ""
    report.add(codes.NOT_MERGED, span, message, label=label, help=where)
    return OutputFile(proposal, data.decode("utf-8", "surrogateescape"))


def _first_conflict(text: str) -> tuple[str, str]:
    """The first conflict: the user's lines and the first new line; empty without a conflict."""
    found = _CONFLICT.search(text)
    return (found["yours"], found["new"].strip().partition("\n")[0].strip()) if found else ("", "")


def _report_merged(path: Path, mine: bytes, data: bytes, report: Report, *, writes: bool) -> None:
    """Report the first changed line, if there is any."""
    if data == mine:
        return
    pairs = zip(data, mine, strict=False)
    at = next((i for i, (a, b) in enumerate(pairs) if a != b), min(len(data), len(mine)))
    shown = data if writes else mine
    source = Source(path, shown.decode("utf-8", "replace"))
    place = len(shown[:at].decode("utf-8", "replace"))
    message = (
        f"what the descriptions say of it is new; it {'is' if writes else 'would be'} merged in"
    )
    report.add(codes.MERGED, source.span(place, place), message)


def _merge(mine: bytes, base: bytes, new: bytes) -> tuple[bytes, bool] | None:
    """The merged text, and whether there are conflicts; None if git is missing or fails."""
    import subprocess  # noqa: PLC0415 - most runs merge nothing
    import tempfile  # noqa: PLC0415
    from shutil import which  # noqa: PLC0415

    git = which("git")
    if git is None:
        return None
    with tempfile.TemporaryDirectory() as where:
        names = ("yours", "before", "new")
        for name, data in zip(names, (mine, base, new), strict=True):
            (Path(where) / name).write_bytes(data)
        labels = [part for name in names for part in ("-L", name)]
        command = [git, "merge-file", "-p", "--diff3", *labels, *names]
        try:
            run = subprocess.run(  # noqa: S603 - git, with our own arguments
                command, cwd=where, capture_output=True, timeout=PATIENCE_S, check=False
            )
        except (OSError, subprocess.TimeoutExpired):
            return None
    # The exit code is the number of conflicts, at most 127; a higher code is a failure.
    return (run.stdout, run.returncode > 0) if 0 <= run.returncode <= 127 else None


def _as_mine(data: bytes, mine: bytes) -> bytes:
    """`data`, generated by rcgen, with the line ends of the user's file."""
    crlf = mine.count(b"\r\n")
    return data.replace(b"\n", b"\r\n") if crlf and crlf == mine.count(b"\n") else data


def _read(path: Path) -> bytes | None:
    try:
        return read_bytes(path)
    except OSError:  # the writer reports the error
        return None


def _report(path: Path, data: bytes, message: str, report: Report, help: str = "") -> None:
    source = Source(path, data.decode("utf-8", "replace"))
    report.add(codes.NOT_MERGED, source.span(0, 0), message, help=help)
