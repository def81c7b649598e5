"""Installs Python environments on a host, without network.

In: requests with a locked list of wheels that are stored as blobs. Out: `environments/HASH`, which
gets its name when it is complete.
"""

from __future__ import annotations

import contextlib
import csv
import ctypes
import json
import os
import shutil
import signal
import stat
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

MARKER = "robocomp.json"
_INSTALL_TIMEOUT_S = 540.0
_PR_SET_PDEATHSIG = 1


class InstallationFailed(Exception):
    """A step of the installation failed; the message is what the program printed."""

    kind = "installation"


def find_incomplete(request: dict[str, Any]) -> dict[str, Any]:
    """Which of `environments` are missing or damaged, with the reason."""
    folder = Path(request["root"]) / "environments"
    problems = {name: _problem(folder / name, name) for name in request["environments"]}
    return {"environments": {name: problem for name, problem in problems.items() if problem}}


def install_environment(request: dict[str, Any]) -> dict[str, Any]:
    """Install an environment of stored blobs.

    `name` is its hash, `python` the interpreter, `uv` the blob of uv's wheel, `wheels` pairs of
    file name and blob, `requirements` the text of the locked requirements, `imports` modules that
    must load.
    """
    root = Path(request["root"]).absolute()
    name = request["name"]
    folder = root / "environments"
    folder.mkdir(parents=True, exist_ok=True)
    draft = folder / f".new-{name}-{os.getpid()}"
    for old in folder.glob(f".new-*{name}-*"):
        shutil.rmtree(old, ignore_errors=True)
    try:
        _create(root, draft, request)
        _check_imports(draft, request["imports"])
        marker = {"name": name, "requirements": request["requirements"]}
        blobs = [blob for _, blob in request["wheels"]] + [request["uv"]]
        (draft / MARKER).write_text(json.dumps(marker | {"blobs": blobs}))
        _sync_file_system(folder)  # after a power failure no complete environment has empty files
        _replace(folder, draft, folder / name)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
    return {}


def _link_wheels(root: Path, wheels: list[tuple[str, str]]) -> list[str]:
    """The options with the folders of wheels.

    Each wheel has a folder of its own that never changes: uv unpacks it once, and environments have
    links to the files.
    """
    options = []
    for file, blob in wheels:
        folder = root / "wheels" / blob
        folder.mkdir(parents=True, exist_ok=True)
        if not (folder / file).exists():
            os.link(root / "blobs" / blob, folder / file)
        options += ["--find-links", str(folder)]
    return options


def _create(root: Path, draft: Path, request: dict[str, Any]) -> None:
    uv = _unpack_uv(root, request["uv"])
    passed_on = ("HOME", "LANG", "LC_ALL", "PATH", "TMPDIR")
    variables = {name: value for name, value in os.environ.items() if name in passed_on}
    variables |= {
        "UV_NO_CONFIG": "1",
        "UV_OFFLINE": "1",
        "UV_PYTHON_DOWNLOADS": "never",
        "UV_CACHE_DIR": str(root / "cache" / "uv"),
        "NO_COLOR": "1",
    }
    python = ["--python", request["python"]]
    _run("`uv venv`", [uv, "venv", "--quiet", "--relocatable", *python, str(draft)], variables)
    requirements = draft / "requirements.txt"
    requirements.write_text(request["requirements"])
    install = [uv, "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-build"]
    install += ["--require-hashes", "-r", str(requirements), "--compile-bytecode"]
    install += ["--python", str(draft / "bin" / "python"), "--link-mode", "hardlink"]
    _run("`uv pip install`", install + _link_wheels(root, request["wheels"]), variables)


def _unpack_uv(root: Path, blob: str) -> str:
    """The program uv from its wheel; it is unpacked once."""
    program = root / "tools" / f"uv-{blob[:16]}"
    if program.exists():
        return str(program)
    program.parent.mkdir(parents=True, exist_ok=True)
    draft = program.with_name(f".new-uv-{os.getpid()}")
    with zipfile.ZipFile(root / "blobs" / blob) as wheel:
        (member,) = (n for n in wheel.namelist() if n.endswith(".data/scripts/uv"))
        with wheel.open(member) as source, draft.open("wb") as target:
            shutil.copyfileobj(source, target)
    draft.chmod(draft.stat().st_mode | stat.S_IXUSR)
    draft.replace(program)
    return str(program)


def _end_with_parent() -> None:
    """The kernel kills the program when this process ends: no orphan goes on to write files."""
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _check_imports(draft: Path, modules: list[str]) -> None:
    code = ";".join(f"import {module}" for module in modules)
    python = str(draft / "bin" / "python")
    variables = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    _run("the import of installed packages", [python, "-c", code], variables)


def _run(title: str, command: list[str], variables: dict[str, str]) -> None:
    """Run a program; `title` names it in errors."""
    try:
        result = subprocess.run(  # noqa: S603 - the command line is rcdeploy's
            command,
            env=variables,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=_INSTALL_TIMEOUT_S,
            check=False,
            preexec_fn=_end_with_parent,
        )
    except subprocess.TimeoutExpired:
        text = f"{title} did not end within {_INSTALL_TIMEOUT_S:g} s"
        raise InstallationFailed(text) from None
    if result.returncode:
        output = (result.stderr or result.stdout).decode("utf-8", "replace").strip()
        reason = output or f"exit code {result.returncode}"
        raise InstallationFailed(f"{title} failed: {reason[-2000:]}")


def _sync_file_system(folder: Path) -> None:
    """Wait until the disk has all that was written to the file system of `folder`."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        if ctypes.CDLL(None).syncfs(descriptor):
            os.sync()
    finally:
        os.close(descriptor)


def _replace(folder: Path, draft: Path, complete: Path) -> None:
    """Give `draft` its name; a damaged environment of this name goes away."""
    if not _problem(complete, complete.name):
        return  # another rcdeploy installed it meanwhile, and processes may run in it
    old = folder / f".new-old-{complete.name}-{os.getpid()}"
    with contextlib.suppress(FileNotFoundError):
        complete.rename(old)
    draft.rename(complete)
    shutil.rmtree(old, ignore_errors=True)


def _problem(environment: Path, name: str) -> str:
    """Why an environment cannot be used; empty if it is complete."""
    try:
        marker = json.loads((environment / MARKER).read_bytes())
    except (OSError, ValueError):
        return "missing" if not environment.exists() else "incomplete"
    if marker.get("name") != name:
        return "incomplete"
    if not os.access(environment / "bin" / "python", os.X_OK):
        return "its Python is gone"
    for file, size in _recorded_files(environment):
        try:
            if file.stat().st_size != size:
                return f"{file.relative_to(environment)} was changed"
        except OSError:
            return f"{file.relative_to(environment)} is missing"
    return ""


def _recorded_files(environment: Path) -> Iterator[tuple[Path, int]]:
    """The files that the installed distributions list, with their sizes."""
    for record in environment.glob("lib/python*/site-packages/*.dist-info/RECORD"):
        site = record.parents[1]
        with record.open(encoding="utf-8", newline="") as stream:
            for row in csv.reader(stream):
                if len(row) == 3 and row[2].isdigit():
                    yield site / row[0], int(row[2])
