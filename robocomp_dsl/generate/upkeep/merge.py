"""Files that are written once and then the user's: both sides' changes are brought together.

In: the new output of such files, and the folder with the user's versions and, in `.rcgen/`, the
pristine output they come from. Out: the files to write. `git merge-file` does the merging; where
both sides changed the same lines the user's file stays, and the proposal with conflict markers is
put into `.rcgen/` beside the pristine output.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.output import RECORD, OutputFile
from robocomp_dsl.source import Source

PRISTINE = f"{RECORD}pristine"
CONFLICTS = f"{RECORD}conflicts"
PATIENCE_S = 30.0


def merged(folder: Path, files: Iterable[OutputFile], report: Report) -> Iterator[OutputFile]:
    """What to write for `files`; those that are rewritten each time pass through."""
    for one in files:
        if not one.keep:
            yield one
            continue
        yield from _kept(folder, one, report)
        yield OutputFile(f"{PRISTINE}/{one.path}", one.text)


def _kept(folder: Path, new: OutputFile, report: Report) -> Iterator[OutputFile]:
    path = folder / new.path
    mine, base = _read(path), _read(folder / PRISTINE / new.path)
    if mine is None or base in (None, new.data) or mine == new.data:
        yield new
    elif path.is_symlink():
        _report(path, mine, "the file is a link, so it stays as it is", report)
        yield new
    elif mine == base:
        yield replace(new, keep=False, seen=mine)
    else:
        yield from _three_ways(path, new, mine, base or b"", report)


def _three_ways(
    path: Path, new: OutputFile, mine: bytes, base: bytes, report: Report
) -> Iterator[OutputFile]:
    result = _merge(mine, _as_mine(base, mine), _as_mine(new.data, mine))
    if result is None:
        _report(path, mine, "rcgen would write it anew; git could not merge, so it stays", report)
        yield new
        return
    data, conflicts = result
    text = data.decode("utf-8", "surrogateescape")
    if conflicts:
        proposal = f"{CONFLICTS}/{new.path}"
        said = "you and rcgen changed the same lines, so it stays as it is"
        _report(path, mine, said, report, f"both sides are in {proposal}; take what you need")
        yield new
        yield OutputFile(proposal, text)
        return
    if data != mine:
        pairs = zip(data, mine, strict=False)
        at = next((i for i, (a, b) in enumerate(pairs) if a != b), min(len(data), len(mine)))
        said = "what the descriptions say of it is new; it is merged in"
        _report(path, data, said, report, at=at)
    yield OutputFile(new.path, text, seen=mine)


def _merge(mine: bytes, base: bytes, new: bytes) -> tuple[bytes, bool] | None:
    """The merged text, and whether there are conflicts; None where git is missing or refuses."""
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
    # The exit code is the number of conflicts, at most 127; above it is a failure.
    return (run.stdout, run.returncode > 0) if 0 <= run.returncode <= 127 else None


def _as_mine(data: bytes, mine: bytes) -> bytes:
    """`data`, which rcgen wrote, with the line ends of the user's file."""
    crlf = mine.count(b"\r\n")
    return data.replace(b"\n", b"\r\n") if crlf and crlf == mine.count(b"\n") else data


def _read(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:  # whatever it is, the writer says what is wrong with it
        return None


def _report(
    path: Path, data: bytes, said: str, report: Report, help: str = "", at: int = 0
) -> None:
    source = Source(path, data.decode("utf-8", "replace"))
    place = len(data[:at].decode("utf-8", "replace"))
    code = codes.NOT_MERGED if help or not at else codes.MERGED
    report.add(code, source.span(place, place), said, help=help)
