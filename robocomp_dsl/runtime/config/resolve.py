"""Resolves the configuration file of a component.

In: a `ConfigRequest` from the command line, the search environment. Out: a `ConfigResult`, or
`ConfigError` that lists each path where a requested file was looked for.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.config.candidates import (
    Candidate,
    InvalidName,
    search,
    validate_context,
    validate_file,
)
from robocomp_dsl.runtime.config.contexts import context_names
from robocomp_dsl.runtime.config.drop_ins import drop_in_roots
from robocomp_dsl.runtime.config.search_environment import Origin, SearchEnvironment
from robocomp_dsl.runtime.config.search_paths import CONTEXTS, SearchPath, search_paths
from robocomp_dsl.runtime.parameters.errors import ConfigError, did_you_mean

SUFFIXES = (".yaml", ".toml")
DEFAULT = "config"


@dataclass(frozen=True, slots=True)
class ConfigRequest:
    """What to search for.

    `config_name`: the value of `--config-name`; empty: files of the context under `names`, best
    first (`arm.yaml`, then `config.yaml`).
    """

    context: str = ""
    config_name: str = ""
    names: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ConfigResult:
    """The result of a search.

    `path` None: no file was found, which is not an error. Live values are saved beside
    `save_beside`. `warnings` are problems that do not prevent the start.
    """

    path: Path | None
    search_path: SearchPath | None
    save_beside: Path
    candidates: tuple[Candidate, ...]
    warnings: tuple[str, ...] = ()


def resolve_config(request: ConfigRequest, environment: SearchEnvironment) -> ConfigResult:
    """Search the configuration file.

    Raises `ConfigError` for an invalid name, or a `--config-name` that is not found.
    """
    _check_names(request, environment)
    findings: list[Finding] = []
    roots = (*environment.roots, *drop_in_roots(environment, findings))
    candidates = _candidates(request, search_paths(roots, environment.robot, request.context))
    winner = next((c for c in candidates if c.is_usable), None)
    if request.config_name and winner is None:
        raise ConfigError([_not_found(request.config_name, candidates)])
    warnings = [finding.render(severity="") for finding in findings]
    known = context_names(roots)
    if request.context and request.context not in known:
        guess = did_you_mean(request.context, known)
        message = f"no folder has the context `{request.context}`"
        warnings.append(f"{message}; {guess}" if guess else message)
    return ConfigResult(
        winner.path if winner else None,
        winner.search_path if winner else None,
        _save_beside(request, winner, environment),
        tuple(candidates),
        tuple(warnings),
    )


def _check_names(request: ConfigRequest, environment: SearchEnvironment) -> None:
    findings = []
    for option, word, check in (
        ("ROBOCOMP_ROBOT_NAME", environment.robot, lambda w: validate_context(w, "robot name")),
        ("--context", request.context, validate_context),
        ("--config-name", request.config_name, validate_file),
    ):
        try:
            _ = word and check(word)
        except InvalidName as error:
            findings.append(Finding(_option_location(option, word), str(error)))
    if findings:
        raise ConfigError(findings)


def _candidates(request: ConfigRequest, order: tuple[SearchPath, ...]) -> list[Candidate]:
    if request.config_name:
        return search(request.config_name, order)
    inside = [path for path in order if path.in_context]
    names = [*request.names, DEFAULT]
    return [t for n in names for suffix in SUFFIXES for t in search(f"{n}{suffix}", inside)]


def _save_beside(
    request: ConfigRequest, winner: Candidate | None, environment: SearchEnvironment
) -> Path:
    """The file itself if the user owns its folder; else the same path in the user's data folder."""
    own = request.names[-1] if request.names else DEFAULT
    subfolder = f"{CONTEXTS}/{request.context or own}"
    if winner is None:
        return environment.data_home / subfolder / f"{own}.yaml"
    if winner.search_path.root.origin in (Origin.WORKING, Origin.USER) and _writable(
        winner.path.parent
    ):
        return winner.path
    inner = winner.path.relative_to(winner.search_path.folder)
    return environment.data_home / (winner.search_path.subfolder or subfolder) / inner


def _writable(folder: Path) -> bool:
    return os.access(folder, os.W_OK | os.X_OK)


def _not_found(file: str, candidates: list[Candidate]) -> Finding:
    searched = "\n".join(f"  {c.path} ({c.search_path}): {c.skip_reason}" for c in candidates)
    near = did_you_mean(file, existing_configs(candidates))
    return Finding(
        _option_location("--config-name", file),
        f"configuration not found: `{file}`",
        label=near,
        help=f"put it into one of these folders, searched in this order:\n{searched}",
    )


def existing_configs(candidates: list[Candidate]) -> list[str]:
    """Names of the configuration files in the folders that were searched."""
    names: list[str] = []
    for candidate in candidates:
        try:
            names += [
                p.name for p in candidate.search_path.folder.iterdir() if p.suffix in SUFFIXES
            ]
        except OSError:
            continue
    return names


def _option_location(option: str, word: str) -> Location:
    return Location(SourceText(option, (word,)), 1, 1, max(1, len(word)))
