"""The configuration of a component that starts. In: what was asked for. Out: a file, and its keep.

What was found is logged; each place that was tried, too, for who debugs or wants to see it.
"""

from __future__ import annotations

import logging
from pathlib import Path

from robocomp_dsl.runtime.config.choose import Asked, choose
from robocomp_dsl.runtime.config.places import CONTEXTS
from robocomp_dsl.runtime.config.surroundings import surroundings

__all__ = ["Asked", "found", "keep_of"]

log = logging.getLogger("robocomp.config")


def found(asked: Asked, otherwise: Path, *, verbose: bool) -> tuple[Path | None, Path]:
    """The configuration and the file beside which live values are kept.

    `otherwise` is taken, if it is there, where a context has no file for the component. Raises
    `ConfigError`.
    """
    chosen = choose(asked, surroundings())
    for one in chosen.tried:
        level = logging.INFO if verbose else logging.DEBUG
        won = "taken" if one.path == chosen.path else "there, too" if one.there else one.obstacle
        log.log(level, "looked for %s (%s): %s", one.path, one.place, won)
    for warning in chosen.warnings:
        log.warning("%s", warning)
    if chosen.path is not None:
        log.info("configuration %s (%s)", chosen.path, chosen.place)
        return chosen.path, chosen.keeps
    path = otherwise if otherwise.is_file() else None
    instead = f"{path} is used" if path else "no file is used"
    log.info("context %s has no configuration of this component; %s", asked.context, instead)
    return path, chosen.keeps


def keep_of(config: Path, component: str) -> Path:
    """Beside which file the live values for a path are kept whose folder cannot be written."""
    return surroundings().data_home / CONTEXTS / component / config.name
