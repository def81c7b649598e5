"""Finds the configuration when a component starts, and logs the search.

In: a `ConfigRequest`. Out: the file, and where to save live values. Each candidate is logged at
level debug, or info with `--verbose-search`.
"""

from __future__ import annotations

import logging
from pathlib import Path

from robocomp_dsl.runtime.config.resolve import ConfigRequest, resolve_config
from robocomp_dsl.runtime.config.search_environment import SearchEnvironment
from robocomp_dsl.runtime.config.search_paths import CONTEXTS

__all__ = ["ConfigRequest", "fallback_save_path", "find_config"]

log = logging.getLogger("robocomp.config")


def find_config(
    request: ConfigRequest, default: Path, *, verbose: bool
) -> tuple[Path | None, Path]:
    """The configuration file (None: none), and the path beside which live values are saved.

    If a context has no file for the component, `default` is used if it exists. Raises
    `ConfigError`.
    """
    result = resolve_config(request, SearchEnvironment.from_environ())
    for candidate in result.candidates:
        level = logging.INFO if verbose else logging.DEBUG
        used = candidate.path == result.path
        outcome = "used" if used else candidate.skip_reason or "shadowed"
        log.log(level, "candidate %s (%s): %s", candidate.path, candidate.search_path, outcome)
    for warning in result.warnings:
        log.warning("%s", warning)
    if result.path is not None:
        log.info("configuration %s (%s)", result.path, result.search_path)
        return result.path, result.save_beside
    path = default if default.is_file() else None
    fallback = f"using {path}" if path else "using no file"
    log.info("context %s has no configuration for this component; %s", request.context, fallback)
    return path, result.save_beside


def fallback_save_path(config: Path, component: str) -> Path:
    """Where to save the live values of a configuration whose folder is not writable."""
    return SearchEnvironment.from_environ().data_home / CONTEXTS / component / config.name
