"""Rewrites a process for the host that it runs on. Pure.

In: a process as planned for this machine, its tree, and where tree and Python are on the host. Out:
the process with the host's paths in working folder, command line and environment.
"""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.plan import Process

_CONTEXT_FLAGS = ("--context", "--config-name")
_MEMBER_FLAG = "--component"
_ENDS = r"(?=$|[/\"',;:\s])"
_BEGINS = r"(?<![\w./~-])"


def relocate(
    process: Process, tree: ContentTree, *, tree_folder: str, python: str, interpreter: str
) -> Process:
    """The process on a host.

    `tree_folder` is the absolute path of the tree there; `python` replaces the program
    `interpreter` of the command line. A configuration that a component would search for in its
    context was found and copied: it is passed as `--config`. So it is for the members of a group.
    """
    paths = {text: posixpath.normpath(f"{tree_folder}/{place}") for text, place in tree.named}
    configs = {name: posixpath.normpath(f"{tree_folder}/{place}") for name, place in tree.configs}
    members = tuple(_relocate(member, paths, configs) for member in process.members)
    names = process.member_names or (process.name,)
    argv = _with_configs([_rewrite(word, paths) for word in process.argv], names, configs)
    if argv and process.argv[0] == interpreter:
        argv[0] = python
    folder = Path(posixpath.normpath(f"{tree_folder}/{tree.working_folder}"))
    moved = _relocate(process, paths, configs)
    return replace(moved, argv=tuple(argv), cwd=folder, members=members)


def _relocate(process: Process, paths: Mapping[str, str], configs: Mapping[str, str]) -> Process:
    """The process with the host's paths, but for the options of its configuration."""
    here = str(process.config or "")
    config = configs.get(process.name) or paths.get(here, here)
    is_found = process.name in configs
    return replace(
        process,
        argv=tuple(_rewrite(word, paths) for word in process.argv),
        cwd=Path(_rewrite(str(process.cwd.resolve()), paths)),
        env=tuple((name, _rewrite(value, paths)) for name, value in process.env),
        config=Path(config) if config else None,
        settings=tuple(_rewrite(setting, paths) for setting in process.settings),
        context="" if is_found else process.context,
        config_name="" if is_found else process.config_name,
    )


def _rewrite(word: str, paths: Mapping[str, str]) -> str:
    """`word` with the paths of this machine replaced, also within JSON; longest first."""
    for here, there in paths.items():
        for old, new in ((here, there), (json.dumps(here)[1:-1], json.dumps(there)[1:-1])):
            if old in word:
                pattern = _BEGINS + re.escape(old) + _ENDS
                word = re.sub(pattern, new.replace("\\", "\\\\"), word)
    return word


def _with_configs(
    argv: Sequence[str], names: Sequence[str], configs: Mapping[str, str]
) -> list[str]:
    """The command line with `--config` where a component had `--context` and `--config-name`.

    `names` are the components whose options it has, one after the other.
    """
    result: list[str] = []
    words = iter(argv)
    remaining = iter(names)
    name = next(remaining) if len(names) == 1 else ""
    added = ""
    for word in words:
        if word == _MEMBER_FLAG:
            name = next(remaining, "")
        if word not in _CONTEXT_FLAGS or name not in configs:
            result.append(word)
            continue
        next(words, None)
        if added != name:
            result += ["--config", configs[name]]
            added = name
    return result
