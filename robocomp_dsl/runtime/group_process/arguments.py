"""The command line of a group in one process.

In: `--name GROUP`, then for each component `--component FOLDER [--after NAMES]` and the arguments
of its `main.py`. Out: the group and its members.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.runtime.component import logs

_SEPARATOR = "--component"


@dataclass(frozen=True, slots=True)
class MemberArguments:
    """One component: its folder, the members that must be ready before it starts, arguments."""

    folder: Path
    after: tuple[str, ...]
    arguments: tuple[str, ...]
    name: str


@dataclass(frozen=True, slots=True)
class GroupArguments:
    """The group, and its members in start order."""

    name: str
    log_level: str
    log_format: str
    members: tuple[MemberArguments, ...]


def parse_arguments(argv: Sequence[str]) -> GroupArguments:
    """Parse a command line. Raises `SystemExit` if it is invalid, as argparse does."""
    own, *others = _split(argv)
    parser = argparse.ArgumentParser(
        prog="python -m robocomp_dsl.runtime.group_process",
        description="Run components in one process.",
        epilog=f"then for each component: {_SEPARATOR} FOLDER [--after NAME,NAME]"
        " and the options of its main.py",
        allow_abbrev=False,
    )
    parser.add_argument("--name", required=True, help="name of the group")
    parser.add_argument("--log-level", choices=logs.LEVELS, default=_default_log_level())
    parser.add_argument("--log-format", choices=("text", "json"), default="text")
    options = parser.parse_args(own)
    members = tuple(_member(part, parser) for part in others)
    if not members:
        parser.error(f"a group has components: {_SEPARATOR} FOLDER")
    names = [member.name for member in members]
    for member in members:
        if names.count(member.name) > 1:
            parser.error(f"there are two components called {member.name}")
        for name in member.after:
            if name not in names:
                parser.error(f"{member.name} waits for {name}, which is not in the group")
    return GroupArguments(options.name, options.log_level, options.log_format, members)


def _split(argv: Sequence[str]) -> list[list[str]]:
    parts: list[list[str]] = [[]]
    for word in argv:
        if word == _SEPARATOR:
            parts.append([])
        else:
            parts[-1].append(word)
    return parts


def _member(part: Sequence[str], parser: argparse.ArgumentParser) -> MemberArguments:
    if not part or part[0].startswith("-"):
        parser.error(f"write the folder of the component: {_SEPARATOR} FOLDER")
    members = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    members.add_argument("--after", default="")
    known, arguments = members.parse_known_args(part[1:])
    naming = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    naming.add_argument("--name", default="")
    naming.add_argument("--prefix", default="")
    named, _ = naming.parse_known_args(arguments)
    folder = Path(part[0]).absolute()
    name = named.name or folder.name
    prefix = named.prefix.strip("/")
    after = tuple(name for name in known.after.split(",") if name)
    full = f"{prefix}/{name}" if prefix else name
    return MemberArguments(folder, after, tuple(arguments), full)


def _default_log_level() -> str:
    level = os.environ.get("LOG_LEVEL", "").lower()
    return level if level in logs.LEVELS else "info"
