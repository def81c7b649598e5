"""The Python of a host: which wheels it can install, and how markers evaluate there. Pure."""

from __future__ import annotations

import sys
from dataclasses import dataclass

from robocomp_dsl.deploy.hosts.host_facts import HostFacts

_OLDEST_GLIBC = (2, 5)
_LEGACY = {(2, 17): "manylinux2014", (2, 12): "manylinux2010", (2, 5): "manylinux1"}
_LEGACY_MACHINES = {"manylinux2010": ("x86_64", "i686"), "manylinux1": ("x86_64", "i686")}


@dataclass(frozen=True, slots=True)
class WheelTarget:
    """The Python of a host: CPython at `path` on Linux.

    `glibc` is None with musl, whose version is then `musl`.
    """

    path: str
    version: tuple[int, int]
    machine: str
    glibc: tuple[int, int] | None
    musl: tuple[int, int] = (1, 2)

    @property
    def minor(self) -> str:
        """The version as in `3.11`."""
        return ".".join(map(str, self.version))

    @property
    def platform(self) -> str:
        """Processor and C library, as in `x86_64-glibc`."""
        return f"{self.machine}-{'glibc' if self.glibc else 'musl'}"

    def platforms(self) -> tuple[str, ...]:
        """The platform tags of wheels that it can install, best first."""
        if self.glibc is None:
            major, newest = self.musl
            return tuple(f"musllinux_{major}_{n}_{self.machine}" for n in range(newest, -1, -1))
        major, newest = self.glibc
        tags = []
        for minor in range(newest, _OLDEST_GLIBC[1] - 1, -1):
            tags.append(f"manylinux_{major}_{minor}_{self.machine}")
            legacy = _LEGACY.get((major, minor))
            if legacy and self.machine in _LEGACY_MACHINES.get(legacy, (self.machine,)):
                tags.append(f"{legacy}_{self.machine}")
        return tuple(tags)

    def tags(self) -> frozenset[str]:
        """All tags of wheels that it can install, as in `cp311-abi3-manylinux2014_x86_64`."""
        major, minor = self.version
        platforms = self.platforms()
        own = f"cp{major}{minor}"
        found = {f"{own}-{own}-{platform}" for platform in platforms}
        for older in range(2, minor + 1):
            found |= {f"cp{major}{older}-abi3-{platform}" for platform in platforms}
        for python in (own, f"py{major}", *(f"py{major}{older}" for older in range(minor + 1))):
            found |= {f"{python}-none-{platform}" for platform in (*platforms, "any")}
        return frozenset(found)

    def marker_environment(self) -> dict[str, str]:
        """The variables of markers in requirements (PEP 508)."""
        return {
            "implementation_name": "cpython",
            "implementation_version": f"{self.minor}.0",
            "os_name": "posix",
            "platform_machine": self.machine,
            "platform_python_implementation": "CPython",
            "platform_release": "",
            "platform_system": "Linux",
            "platform_version": "",
            "python_full_version": f"{self.minor}.0",
            "python_version": self.minor,
            "sys_platform": "linux",
            "extra": "",
        }


def choose_target(facts: HostFacts) -> WheelTarget | None:
    """The Python of a host for components; None if none is suitable.

    The version of the Python that runs here is preferred: its packages are installed here.
    """
    suitable = [python for python in facts.pythons if python.is_suitable]
    same = [python for python in suitable if python.version[:2] == sys.version_info[:2]]
    python = next(iter([*same, *suitable]), None)
    if python is None:
        return None
    major, minor = python.version[:2]
    return WheelTarget(python.path, (major, minor), facts.machine, _version(facts.glibc))


def _version(text: str) -> tuple[int, int] | None:
    """`2.36` as numbers; None for anything else."""
    parts = text.split(".")
    if len(parts) < 2 or not (parts[0].isdigit() and parts[1].isdigit()):
        return None
    return int(parts[0]), int(parts[1])
