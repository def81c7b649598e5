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
_ENDS = r"(?=$|[/\"',;:\s])"
_BEGINS = r"(?<![\w./~-])"


def relocate(
    process: Process,
    tree: ContentTree,
    *,
    tree_folder: str,
    python: str = "",
    interpreter: str = "",
) -> Process:
    """The process on a host.

    `tree_folder` is the absolute path of the tree there; `python` replaces the program
    `interpreter` of the command line. A configuration that the component would search for in its
    context was found and copied: it is passed as `--config`.
    """
    paths = {text: posixpath.normpath(f"{tree_folder}/{place}") for text, place in tree.named}
    argv = [_rewrite(word, paths) for word in process.argv]
    if argv and interpreter and process.argv[0] == interpreter:
        argv[0] = python
    config = process.config
    if config is not None:
        config = Path(paths.get(str(config), str(config)))
    elif tree.config:
        config = Path(posixpath.normpath(f"{tree_folder}/{tree.config}"))
        argv = _with_config(argv, str(config))
    return replace(
        process,
        argv=tuple(argv),
        cwd=Path(posixpath.normpath(f"{tree_folder}/{tree.working_folder}")),
        env=tuple((name, _rewrite(value, paths)) for name, value in process.env),
        config=config,
        settings=tuple(_rewrite(setting, paths) for setting in process.settings),
        context="" if tree.config else process.context,
        config_name="" if tree.config else process.config_name,
    )


def _rewrite(word: str, paths: Mapping[str, str]) -> str:
    """`word` with the paths of this machine replaced, also within JSON; longest first."""
    for here, there in paths.items():
        for old, new in ((here, there), (json.dumps(here)[1:-1], json.dumps(there)[1:-1])):
            if old in word:
                word = re.sub(_BEGINS + re.escape(old) + _ENDS, lambda _, new=new: new, word)  # type: ignore[misc]
    return word


def _with_config(argv: Sequence[str], config: str) -> list[str]:
    """The command line with `--config` where it had `--context` and `--config-name`."""
    result: list[str] = []
    words = iter(argv)
    for word in words:
        if word not in _CONTEXT_FLAGS:
            result.append(word)
            continue
        next(words, None)
        if "--config" not in result:
            result += ["--config", config]
    return result
