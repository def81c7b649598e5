"""The Python packages that are installed here, and what they need.

In: requirements. Out: their closure in the installed versions, or problems. Reads metadata only.
"""

from __future__ import annotations

import importlib.util
import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import Distribution, PackageNotFoundError, distribution, distributions
from pathlib import Path

from robocomp_dsl.deploy.content.packaging_library import (
    InvalidRequirement,
    Requirement,
    canonicalize_name,
)

OWN_NAME = "robocomp-dsl"
_KNOWN_MODULES = {
    "Ice": "zeroc-ice",
    "IceStorm": "zeroc-ice",
    "cyclonedds": "cyclonedds",
    "matplotlib": "matplotlib",
    "mujoco": "mujoco",
    "numpy": "numpy",
    "rclpy": "ros-kilted-rclpy",
    "rosbags": "rosbags",
    "yaml": "PyYAML",
    "zenoh": "eclipse-zenoh",
}
"""Modules that robocomp_dsl itself uses."""


@dataclass(frozen=True, slots=True)
class RequirementProblem:
    """A requirement that cannot be locked; `requirement` names it."""

    requirement: str
    message: str
    help: str = ""


@dataclass(frozen=True, slots=True, order=True)
class LockedDistribution:
    """An installed distribution: normalised name and version."""

    name: str
    version: str

    def __str__(self) -> str:
        return f"{self.name}=={self.version}"


def close_requirements(
    roots: Iterable[Requirement], markers: Mapping[str, str]
) -> tuple[tuple[LockedDistribution, ...], tuple[RequirementProblem, ...]]:
    """The requirements and all that they need, sorted; `markers` are the variables of the host."""
    found: dict[str, LockedDistribution] = {}
    problems: dict[str, RequirementProblem] = {}
    pending = [(requirement, "") for requirement in roots if _applies(requirement, (), markers)]
    seen = set()
    while pending:
        requirement, user = pending.pop()
        name = canonicalize_name(requirement.name)
        if name == OWN_NAME:
            continue  # its wheel is written from the package that runs here
        step = (name, frozenset(requirement.extras), str(requirement.specifier))
        if step in seen:
            continue
        seen.add(step)
        installed = find_installed(name)
        problem = _problem(requirement, installed, user)
        if problem or installed is None:
            problems.setdefault(name, problem or RequirementProblem(name, ""))
            continue
        found[name] = LockedDistribution(name, installed.version)
        needed = (_needed(text, requirement.extras, markers) for text in installed.requires or ())
        pending += [(other, name) for other in needed if other]
    return tuple(found[name] for name in sorted(found)), tuple(problems.values())


@cache
def find_installed(name: str) -> Distribution | None:
    """The installed distribution of that name."""
    try:
        return distribution(name)
    except (PackageNotFoundError, ValueError):
        return None


@cache
def distribution_of(module: str) -> str | None:
    """The distribution that has the top-level `module` installed here; None if none has."""
    if (known := _KNOWN_MODULES.get(module)) and find_installed(known):
        return known
    origin = module_origin(module)
    if origin is None:
        return None
    for candidate in distributions():
        record = getattr(candidate, "_path", None)
        if record is None:
            continue
        site = Path(record).parent
        if not origin.is_relative_to(site):
            continue
        line = origin.relative_to(site).as_posix().encode()
        try:
            content = (Path(record) / "RECORD").read_bytes()
        except OSError:
            continue
        if content.startswith(line + b",") or b"\n" + line + b"," in content:
            return canonicalize_name(candidate.name)
    return None


@cache
def module_origin(module: str) -> Path | None:
    """The file from which this Python imports a top-level module; None if it finds none."""
    try:
        spec = importlib.util.find_spec(module)
    except (ImportError, ValueError, AttributeError):
        return None
    if spec is None:
        return None
    if spec.origin and spec.origin not in ("built-in", "frozen", "namespace"):
        return Path(spec.origin)
    return None


def is_editable(installed: Distribution) -> bool:
    """Whether the distribution is a link to a working copy."""
    text = installed.read_text("direct_url.json")
    if not text:
        return False
    try:
        return bool(json.loads(text).get("dir_info", {}).get("editable"))
    except (ValueError, AttributeError):
        return False


def _problem(
    requirement: Requirement, installed: Distribution | None, user: str
) -> RequirementProblem | None:
    name = str(requirement.name)
    needed_by = f" (needed by {user})" if user else ""
    if requirement.url:
        return RequirementProblem(
            name, f"`{requirement}` is a URL", "install it, and write its name"
        )
    if installed is None:
        message = f"`{requirement}` is not installed here{needed_by}"
        return RequirementProblem(name, message, f"python3 -m pip install '{requirement}'")
    if not user and not requirement.specifier.contains(installed.version, prereleases=True):
        message = f"`{requirement}` is required, but {installed.version} is installed here"
        return RequirementProblem(name, message, f"python3 -m pip install '{requirement}'")
    if is_editable(installed):
        message = f"`{name}` is installed in editable mode{needed_by}; it cannot be copied"
        return RequirementProblem(
            name, message, f"python3 -m pip install {os.curdir} in its folder"
        )
    return None


def _needed(text: str, extras: Iterable[str], markers: Mapping[str, str]) -> Requirement | None:
    """A requirement of a distribution; None if its marker excludes it on the host."""
    try:
        requirement = Requirement(text)
    except InvalidRequirement:
        return None
    return requirement if _applies(requirement, extras, markers) else None


def _applies(requirement: Requirement, extras: Iterable[str], markers: Mapping[str, str]) -> bool:
    marker = requirement.marker
    if marker is None:
        return True
    return any(marker.evaluate({**markers, "extra": extra}) for extra in ("", *extras))
