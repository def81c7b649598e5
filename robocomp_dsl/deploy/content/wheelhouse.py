"""Gets the wheels of an environment for the Python of a host.

In: locked distributions. Out: wheels with their hashes, or problems. They come from the user's
cache, from the installation here if it fits the host, or from the package index.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from robocomp_dsl.deploy.content.distributions import (
    LockedDistribution,
    RequirementProblem,
    find_installed,
)
from robocomp_dsl.deploy.content.hash_cache import HashCache, cache_folder
from robocomp_dsl.deploy.content.lock import RUNTIME_REQUIREMENTS, Environment
from robocomp_dsl.deploy.content.package_files import write_package_wheel
from robocomp_dsl.deploy.content.packaging_library import (
    InvalidWheelFilename,
    canonicalize_name,
    parse_wheel_filename,
)
from robocomp_dsl.deploy.content.repack import installed_tags, repack
from robocomp_dsl.deploy.content.wheel_target import WheelTarget

_DOWNLOAD_TIMEOUT_S = 900.0
_NO_MATCH = re.compile(r"No matching distribution found for (\S+)")


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel in the cache; `installed_bytes` is its size after installation."""

    distribution: LockedDistribution
    path: Path
    sha256: str
    size: int
    installed_bytes: int


@dataclass(frozen=True, slots=True)
class Wheelhouse:
    """The wheels of an environment, that of robocomp_dsl among them, and that of uv."""

    wheels: tuple[Wheel, ...]
    uv: Wheel

    @property
    def all_wheels(self) -> tuple[Wheel, ...]:
        """The wheels to copy."""
        return (*self.wheels, self.uv)

    @property
    def installed_bytes(self) -> int:
        """Approximate size of the environment, with bytecode."""
        return sum(wheel.installed_bytes for wheel in self.wheels) * 5 // 4

    def requirements(self) -> str:
        """The content of a requirements file with hashes."""
        return "".join(f"{w.distribution} --hash=sha256:{w.sha256}\n" for w in self.wheels)


class WheelStore:
    """The wheels in the user's cache folder, and how missing ones get there."""

    def __init__(self, folder: Path | None = None, hashes: HashCache | None = None) -> None:
        self._folder = folder or cache_folder() / "wheels"
        self._hashes = hashes or HashCache()

    def collect(
        self, environment: Environment, python: WheelTarget
    ) -> tuple[Wheelhouse | None, list[RequirementProblem]]:
        """The wheels of an environment; None with problems. Takes seconds if some are missing."""
        self._folder.mkdir(parents=True, exist_ok=True)
        uv = _locked_uv()
        if uv is None:
            help_text = f"{sys.executable} -m pip install 'robocomp_dsl[hosts]'"
            message = "`uv`, which installs packages on hosts, is not installed here"
            return None, [RequirementProblem("uv", message, help_text)]
        needed = (*environment.distributions, uv)
        tags = python.tags()
        paths = _cached_wheels(self._folder, tags)
        paths |= self._repack_all([d for d in needed if d not in paths], tags)
        missing = [d for d in needed if d not in paths]
        problems = self._download(missing, python) if missing else []
        paths |= _cached_wheels(self._folder, tags) if missing else {}
        absent = [d for d in needed if d not in paths]
        if absent:
            named = {canonicalize_name(p.requirement.partition("==")[0]) for p in problems}
            problems += [_no_wheel(d, python, "") for d in absent if d.name not in named]
            return None, problems
        own = LockedDistribution("robocomp-dsl", environment.package_version)
        wheels = [self._wheel(d, paths[d]) for d in environment.distributions]
        wheels.append(self._wheel(own, self._package_wheel(environment)))
        return Wheelhouse(tuple(wheels), self._wheel(uv, paths[uv])), []

    def _repack_all(
        self, missing: Sequence[LockedDistribution], tags: frozenset[str]
    ) -> dict[LockedDistribution, Path]:
        """Wheels of installations here that fit the host; their bytes are those that run here."""

        def repack_fitting(locked: LockedDistribution) -> Path | None:
            installed = find_installed(locked.name)
            if installed is None or installed.version != locked.version:
                return None
            return repack(installed, self._folder) if installed_tags(installed) & tags else None

        with ThreadPoolExecutor(os.cpu_count()) as pool:  # compression releases the lock
            paths = pool.map(repack_fitting, missing)
            return {locked: path for locked, path in zip(missing, paths, strict=True) if path}

    def _package_wheel(self, environment: Environment) -> Path:
        version = environment.package_version
        for path in self._folder.glob(f"robocomp_dsl-{version}-*.whl"):
            return path
        complete = environment.complete
        return write_package_wheel(self._folder, version, RUNTIME_REQUIREMENTS, complete=complete)

    def _download(
        self, missing: Sequence[LockedDistribution], python: WheelTarget
    ) -> list[RequirementProblem]:
        """Get wheels from the index; all at once, and one by one if that fails."""
        reason = self._pip(missing, python)
        if not reason:
            return []
        if len(missing) == 1:
            return [_no_wheel(missing[0], python, reason)]
        reasons = {locked: self._pip([locked], python) for locked in missing}
        return [_no_wheel(locked, python, reason) for locked, reason in reasons.items() if reason]

    def _pip(self, requested: Sequence[LockedDistribution], python: WheelTarget) -> str:
        """Why `pip download` failed; empty if it did not."""
        pip = _pip_command()
        if pip is None:
            return "pip is missing here: python3 -m ensurepip"
        major, minor = python.version
        with tempfile.TemporaryDirectory(prefix=".download-", dir=self._folder) as folder:
            command = [*pip, "download", "--quiet", "--no-deps", "--only-binary", ":all:"]
            command += ["--disable-pip-version-check", "--no-input", "--retries", "1"]
            command += ["--dest", folder, "--python-version", python.minor]
            command += ["--implementation", "cp", "--abi", f"cp{major}{minor}", "--abi", "abi3"]
            command += ["--abi", "none"]
            for platform in (*python.platforms(), "any"):
                command += ["--platform", platform]
            reason = _run(command + [str(locked) for locked in requested])
            for file in Path(folder).glob("*.whl"):
                file.replace(self._folder / file.name)
        return reason

    def _wheel(self, locked: LockedDistribution, path: Path) -> Wheel:
        status = path.stat()
        with zipfile.ZipFile(path) as archive:
            installed = sum(entry.file_size for entry in archive.infolist())
        digest = self._hashes.sha256(str(path), status)
        return Wheel(locked, path, digest, status.st_size, installed)


def _cached_wheels(folder: Path, tags: frozenset[str]) -> dict[LockedDistribution, Path]:
    """The wheels of a folder that fit the host."""
    found = {}
    for path in sorted(folder.glob("*.whl")):
        try:
            name, version, _, wheel_tags = parse_wheel_filename(path.name)
        except InvalidWheelFilename:
            continue
        if any(str(tag) in tags for tag in wheel_tags):
            found[LockedDistribution(name, str(version))] = path
    return found


@cache
def _pip_command() -> tuple[str, ...] | None:
    if importlib.util.find_spec("pip"):
        return (sys.executable, "-m", "pip")
    uvx = shutil.which("uvx")
    return (uvx, "pip") if uvx else None


def _run(command: Sequence[str]) -> str:
    """The last lines of what a failed command printed; empty if it succeeded."""
    try:
        result = subprocess.run(  # noqa: S603 - names and versions of installed distributions
            command,
            capture_output=True,
            text=True,
            timeout=_DOWNLOAD_TIMEOUT_S,
            stdin=subprocess.DEVNULL,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"it took longer than {_DOWNLOAD_TIMEOUT_S:g} s"
    if result.returncode == 0:
        return ""
    lines = [line for line in result.stderr.splitlines() if line.startswith("ERROR")]
    return (lines or result.stderr.splitlines() or [f"exit code {result.returncode}"])[-1]


def _no_wheel(locked: LockedDistribution, python: WheelTarget, reason: str) -> RequirementProblem:
    host = f"Python {python.minor} on {python.machine} with {_describe_libc(python)}"
    if reason and not _NO_MATCH.search(reason):
        message = f"the wheel of {locked} for {host} cannot be downloaded: {reason}"
        help_text = "connect this machine to the package index once; wheels stay in the cache"
        return RequirementProblem(str(locked), message, help_text)
    message = f"there is no wheel of {locked} for {host}"
    other = f"Python {_own_minor()}" if python.glibc else "a system with glibc, such as Debian,"
    help_text = f"install a version here that has one, or use {other} on the host"
    return RequirementProblem(str(locked), message, help_text)


def _describe_libc(python: WheelTarget) -> str:
    name, version = ("glibc", python.glibc) if python.glibc else ("musl", python.musl)
    return f"{name} {version[0]}.{version[1]}"


def _own_minor() -> str:
    return f"{sys.version_info.major}.{sys.version_info.minor}"


def _locked_uv() -> LockedDistribution | None:
    installed = find_installed("uv")
    return LockedDistribution("uv", installed.version) if installed else None
