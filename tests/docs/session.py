"""Executes the blocks of a page in a folder, as its reader would.

In: blocks. Out: files, running commands, and an `AssertionError` where the shown output differs
from the real one. In shown output `…` stands for any text, a line `…` for any number of lines, and
the time of a log line for any time.
"""

from __future__ import annotations

import ast
import contextlib
import os
import re
import signal
import subprocess
import threading
from itertools import zip_longest
from pathlib import Path
from types import TracebackType
from typing import Self

from tests.docs.blocks import ROOT, Block, Command, commands
from tests.support.waiting import wait_until

TIMEOUT_S = 120.0
_TIME = r"\d\d:\d\d:\d\d\.\d{3}"
_VARIABLE = re.compile(f"(…|{_TIME})")


def pattern(lines: tuple[str, ...]) -> re.Pattern[str]:
    """What real output has to match from its start for the shown `lines` to be right."""
    parts = [r"(?:.*\n)*?" if line.strip() == "…" else f"{_line(line)}\n" for line in lines]
    return re.compile("".join(parts))


def _line(line: str) -> str:
    parts = _VARIABLE.split(line.rstrip())
    # Every second part is one that varies.
    varying = (".*" if part == "…" else _TIME for part in parts[1::2])
    fixed = (re.escape(part) for part in parts[::2])
    return "".join(a + b for a, b in zip_longest(fixed, varying, fillvalue="")) + " *"


class Process:
    """A running command; its output so far is `output`."""

    def __init__(self, line: str, folder: Path, environment: dict[str, str]) -> None:
        self.output = ""
        self._popen = subprocess.Popen(
            ["bash", "-c", line],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self) -> None:
        assert self._popen.stdout
        for line in self._popen.stdout:
            self.output += line

    @property
    def ended(self) -> bool:
        """Whether it has ended and all its output was read."""
        return self._popen.poll() is not None and not self._reader.is_alive()

    def signal(self, number: int) -> None:
        """Send a signal to it and all it started, as a terminal does."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._popen.pid, number)

    def end(self) -> int:
        """Wait for the end; the exit code."""
        wait_until(lambda: self.ended, lambda: f"no end:\n{self.output}", TIMEOUT_S)
        return self._popen.returncode


class Session:
    """A reader at work in `folder`. Leaves no process behind."""

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        self._folder = folder
        self._environment = environment
        self._cwd = folder
        self._background: list[Process] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        for process in self._background:
            if not process.ended:
                process.signal(signal.SIGINT)
                process.end()

    def execute(self, block: Block) -> None:
        """Do what `block` says."""
        where = f"{block.page.relative_to(ROOT)}:{block.line}"
        if block.verb == "file":
            path = self._folder / block.argument
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, encoding="utf-8")
        elif block.verb == "method":
            replace_methods(self._folder / block.argument, block.text)
        elif block.language == "console":
            for command in commands(block):
                self._run(command, block, where)

    def _run(self, command: Command, block: Block, where: str) -> None:
        if command.line.startswith("cd ") and "&&" not in command.line:
            self._cwd = (self._cwd / command.line.removeprefix("cd ").strip()).resolve()
            return
        process = Process(command.line, self._cwd, self._environment)
        if block.verb == "background":
            self._background.append(process)
            self._wait_for_output(process, command.output, where)
            return
        if command.interrupted:
            try:
                self._wait_for_output(process, command.output[:-1], where)
            finally:
                process.signal(signal.SIGINT)
                code = process.end()
        else:
            code = process.end()
            if command.output:
                matches = pattern(command.output).fullmatch(f"{process.output.rstrip()}\n")
                assert matches, _difference(where, command.output, process)
        expected = int(block.argument) if block.verb == "exit" else 0
        assert code == expected, f"{where}: `{command.line}` ended with {code}:\n{process.output}"

    def _wait_for_output(self, process: Process, lines: tuple[str, ...], where: str) -> None:
        shown = pattern(lines)
        wait_until(
            lambda: shown.match(process.output) or process.ended,
            lambda: _difference(where, lines, process),
            TIMEOUT_S,
        )
        assert shown.match(process.output), _difference(where, lines, process)


def _difference(where: str, lines: tuple[str, ...], process: Process) -> str:
    shown = "\n".join(lines)
    return f"{where}: shown:\n{shown}\n--- real:\n{process.output[-8000:]}"


def replace_methods(path: Path, snippet: str) -> None:
    """Put the functions of `snippet` into the class of `path`, and its imports above the class.

    A method of the same name is replaced, another one is added at the end.
    """
    source = path.read_text(encoding="utf-8")
    lines = source.split("\n")
    tree = ast.parse(source)
    worker = next(node for node in tree.body if isinstance(node, ast.ClassDef))
    places = {node.name: node for node in worker.body if isinstance(node, ast.FunctionDef)}
    added: list[str] = []
    edits: list[tuple[int, int, list[str]]] = []
    for node in ast.parse(snippet).body:
        text = snippet.split("\n")[node.lineno - 1 : node.end_lineno]
        if not isinstance(node, ast.FunctionDef):
            edits.append((worker.lineno - 1, worker.lineno - 1, [*text, ""]))
            continue
        method = [f"    {line}" if line else "" for line in text]
        if place := places.get(node.name):
            edits.append((place.lineno - 1, _end(place, lines), method))
        else:
            added += ["", *method]
    edits.append((worker.end_lineno or 0, worker.end_lineno or 0, added))
    for start, end, text in sorted(edits, reverse=True):
        lines[start:end] = text
    path.write_text("\n".join(lines), encoding="utf-8")


def _end(method: ast.FunctionDef, lines: list[str]) -> int:
    """The line behind a method, with the comments at its end."""
    end = method.end_lineno or 0
    while end < len(lines) and lines[end].startswith("        #"):
        end += 1
    return end
