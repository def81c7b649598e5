"""Which configuration a component starts with, and where the live values it keeps belong.

In: what the command line asked for, the surroundings. Out: `Chosen`, or `ConfigError` that lists
each place in which a file that was asked for is not.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.runtime.config.contexts import context_names
from robocomp_dsl.runtime.config.drop_ins import dropped
from robocomp_dsl.runtime.config.find import Tried, WrongName, checked_context, checked_file, search
from robocomp_dsl.runtime.config.places import CONTEXTS, Place, places
from robocomp_dsl.runtime.config.surroundings import Origin, Surroundings
from robocomp_dsl.runtime.parameters import findings as found
from robocomp_dsl.runtime.parameters.findings import ConfigError, Finding, did_you_mean

SUFFIXES = (".yaml", ".toml")
DEFAULT = "config"


@dataclass(frozen=True, slots=True)
class Asked:
    """`file`: that of `--from`. `names`: what a file of this component may be called, best first.

    The names matter when no file was asked for: `arm.yaml`, say, then `config.yaml`.
    """

    context: str = ""
    file: str = ""
    names: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Chosen:
    """`path` None: there is none, which is no failure. Live values are kept beside `keeps`.

    `warnings` tell what is wrong around it without being a reason not to start.
    """

    path: Path | None
    place: Place | None
    keeps: Path
    tried: tuple[Tried, ...]
    warnings: tuple[str, ...] = ()


def choose(asked: Asked, around: Surroundings) -> Chosen:
    """The configuration. Raises `ConfigError` for a wrong name or a `--from` that is nowhere."""
    _check_names(asked, around)
    findings: list[Finding] = []
    roots = (*around.roots, *dropped(around, findings))
    tried = _tried(asked, places(roots, around.robot, asked.context))
    winner = next((one for one in tried if one.there), None)
    if asked.file and winner is None:
        raise ConfigError([_nowhere(asked.file, tried)])
    warnings = [str(one).removeprefix("error: ") for one in findings]
    known = context_names(roots)
    if asked.context and asked.context not in known:
        guess = did_you_mean(asked.context, known)
        said = f"no folder has the context `{asked.context}`"
        warnings.append(f"{said}; {guess}" if guess else said)
    keeps = _keeps(asked, winner, around)
    path, place = (winner.path, winner.place) if winner else (None, None)
    return Chosen(path, place, keeps, tuple(tried), tuple(warnings))


def _check_names(asked: Asked, around: Surroundings) -> None:
    findings = []
    for option, word, check in (
        ("ROBOCOMP_ROBOT_NAME", around.robot, lambda w: checked_context(w, "robot name")),
        ("--context", asked.context, checked_context),
        ("--from", asked.file, checked_file),
    ):
        try:
            _ = word and check(word)
        except WrongName as error:
            findings.append(Finding(_at(option, word), str(error)))
    if findings:
        raise ConfigError(findings)


def _tried(asked: Asked, order: tuple[Place, ...]) -> list[Tried]:
    if asked.file:
        return search(asked.file, order)
    inside = [one for one in order if one.in_context]
    names = [*asked.names, DEFAULT]
    return [t for n in names for suffix in SUFFIXES for t in search(f"{n}{suffix}", inside)]


def _keeps(asked: Asked, winner: Tried | None, around: Surroundings) -> Path:
    """Beside the file if it is the user's own; else at the same place of the user's data."""
    own = asked.names[-1] if asked.names else DEFAULT
    within = f"{CONTEXTS}/{asked.context or own}"
    if winner is None:
        return around.data_home / within / f"{own}.yaml"
    if winner.place.root.origin in (Origin.WORKING, Origin.USER) and _writable(winner.path.parent):
        return winner.path
    inner = winner.path.relative_to(winner.place.folder)
    return around.data_home / (winner.place.within or within) / inner


def _writable(folder: Path) -> bool:
    return os.access(folder, os.W_OK | os.X_OK)


def _nowhere(file: str, tried: list[Tried]) -> Finding:
    listed = "\n".join(f"  {one.path} ({one.place}): {one.obstacle}" for one in tried)
    near = did_you_mean(file, files_beside(tried))
    return Finding(
        _at("--from", file),
        f"there is no configuration `{file}`",
        label=near,
        help=f"put it into one of these places, which were searched in this order:\n{listed}",
    )


def files_beside(tried: list[Tried]) -> list[str]:
    """The configurations that there are in the places that were searched."""
    names: list[str] = []
    for one in tried:
        try:
            names += [p.name for p in one.place.folder.iterdir() if p.suffix in SUFFIXES]
        except OSError:
            continue
    return names


def _at(option: str, word: str) -> found.Place:
    return found.Place(found.Text(option, (word,)), 1, 1, max(1, len(word)))
