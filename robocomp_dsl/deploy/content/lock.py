"""Locks the Python environment of a component: which packages it has on its host.

In: an instance, its tree, the Python of its host. Out: an `Environment`, whose hash needs no wheel
and no network. Its versions are those installed here.
"""

from __future__ import annotations

import hashlib
import posixpath
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import entry_points
from pathlib import Path

from robocomp_dsl.deploy.content import codes
from robocomp_dsl.deploy.content.distributions import (
    LockedDistribution,
    RequirementProblem,
    close_requirements,
    distribution_of,
    find_installed,
    module_origin,
)
from robocomp_dsl.deploy.content.hash_cache import HashCache
from robocomp_dsl.deploy.content.package_files import NAME, is_runtime, package_version
from robocomp_dsl.deploy.content.packaging_library import Requirement
from robocomp_dsl.deploy.content.python_imports import ImportPlace, ImportReader
from robocomp_dsl.deploy.content.requirements_file import FILE_NAME, read_requirements
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.content.wheel_target import WheelTarget
from robocomp_dsl.deploy.plan import PYTHON_PROGRAMS, Plan, Process
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment, Instance
from robocomp_dsl.model.port_middlewares import port_middlewares
from robocomp_dsl.runtime.middleware.registry import ENTRY_POINT_GROUP, description_of
from robocomp_dsl.source import Source, Span

RUNTIME_REQUIREMENTS = (
    "eclipse-zenoh", "numpy", "platformdirs", "python-statemachine", "PyYAML",
)  # fmt: skip
"""What a component needs besides robocomp_dsl; all else of its requirements is the toolchain's."""
SIMULATION_REQUIREMENTS = ("mujoco", "pillow")
_SIMULATION = f"{NAME}.simulation"


@dataclass(frozen=True)
class Environment:
    """The packages of a component on a host.

    `python` is as in `3.11`, `platform` as in `x86_64-glibc`; `package_version` is that of
    robocomp_dsl, with the toolchain if `complete`.
    """

    python: str
    platform: str
    package_version: str
    distributions: tuple[LockedDistribution, ...]
    complete: bool = False

    @cached_property
    def hash(self) -> str:
        """SHA-256 over Python, platform and versions, as 64 hexadecimal digits."""
        lines = [self.python, self.platform, f"{NAME}=={self.package_version}"]
        lines += map(str, self.distributions)
        return hashlib.sha256("\n".join(lines).encode()).hexdigest()


class EnvironmentLocker:
    """Locks the environments of one host; what cannot be locked is a finding."""

    def __init__(
        self,
        deployment: Deployment,
        plan: Plan,
        python: WheelTarget,
        report: Report,
        hashes: HashCache | None = None,
        reader: ImportReader | None = None,
    ) -> None:
        self._deployment = deployment
        names = (process.name for process in plan.components)
        self._instances = dict(zip(names, deployment.instances, strict=True))
        self._python = python
        self._report = report
        self._hashes = hashes or HashCache()
        self._reader = reader or ImportReader()
        self._closures: dict[tuple[frozenset[str], bool], Environment] = {}

    def lock(self, process: Process, tree: ContentTree) -> Environment | None:
        """The environment of a process; None for a program that is not Python."""
        roots: dict[str, Span] = {}
        imports: dict[str, ImportPlace] = {}
        for member in process.members or (process,):
            instance = self._instances[member.name]
            words = shlex.split(instance.executable)
            if words[0] not in PYTHON_PROGRAMS:
                return None
            roots |= dict.fromkeys(RUNTIME_REQUIREMENTS, instance.span)
            roots |= dict.fromkeys(self._middlewares(instance), instance.span)
            imports |= self._imports(words, member, tree)
            roots |= self._listed(member.cwd)
        roots |= dict(self._imported(imports))
        complete = any(
            name.startswith(f"{NAME}.") and not is_runtime(name) and is_part(name)
            for name in imports
        )
        return self._close(roots, complete=complete)

    def lock_runtime(self, span: Span) -> Environment:
        """The environment of a program of robocomp_dsl itself, such as the router."""
        return self._close(dict.fromkeys(RUNTIME_REQUIREMENTS, span), complete=False)

    def _close(self, roots: Mapping[str, Span], *, complete: bool) -> Environment:
        key = (frozenset(roots), complete)
        if key not in self._closures:
            requirements = [Requirement(text) for text in roots]
            if complete:
                requirements += [Requirement(text) for text in _toolchain_requirements()]
            markers = self._python.marker_environment()
            found, problems = close_requirements(requirements, markers)
            self._report_problems(problems, roots)
            version = package_version(complete=complete, hashes=self._hashes)
            self._hashes.save()
            self._closures[key] = Environment(
                self._python.minor, self._python.platform, version, found, complete
            )
        return self._closures[key]

    def _listed(self, folder: Path) -> dict[str, Span]:
        """The requirements in the file of a component, each with its line."""
        requirements = read_requirements(folder, self._report)
        if not requirements:
            return {}
        source = Source.read(folder / FILE_NAME)
        return {str(requirement): source.span_at(line) for requirement, line in requirements}

    def _imports(
        self, words: list[str], process: Process, tree: ContentTree
    ) -> dict[str, ImportPlace]:
        files = {file.path: (file.sha256, file.source) for file in tree.files}
        folder = dict(tree.named)[str(process.cwd.resolve())]
        scripts = [posixpath.normpath(f"{folder}/{word}") for word in words[1:]]
        scripts += [place for _, place in tree.named if place.endswith(".py")]
        found: dict[str, ImportPlace] = {}
        for script in dict.fromkeys(scripts):
            if script in files:
                found = self._reader.imports(script, files) | found
        return found

    def _middlewares(self, instance: Instance) -> Iterator[str]:
        """The distributions of the middlewares that the ports of an instance use."""
        names = {
            name
            for port in instance.component.ports
            for name in port_middlewares(
                instance, port, self._deployment.connections, self._deployment.middleware
            )
        }
        for name in sorted(names):
            description = description_of(name)
            for module in description.requires if description else ():
                if found := distribution_of(module.partition(".")[0]):
                    yield found
            for point in entry_points(group=ENTRY_POINT_GROUP, name=name):
                if point.dist:
                    yield point.dist.name

    def _imported(self, imports: Mapping[str, ImportPlace]) -> Iterator[tuple[str, Span]]:
        """The distributions of imported modules, each with the place of the import."""
        for name, place in imports.items():
            top = name.partition(".")[0]
            if top == NAME:
                if name == _SIMULATION:
                    yield from dict.fromkeys(SIMULATION_REQUIREMENTS, _span(place)).items()
            elif found := distribution_of(top):
                yield found, _span(place)
            elif name == top and (origin := module_origin(top)):
                self._report.add(
                    codes.DISTRIBUTION,
                    _span(place),
                    f"the module `{top}` is in {origin}, which is not copied to hosts",
                    help=f"put it into the component's folder, or install it as a package and name "
                    f"that in {FILE_NAME}",
                )

    def _report_problems(
        self, problems: tuple[RequirementProblem, ...], roots: Mapping[str, Span]
    ) -> None:
        first = next(iter(roots.values()))
        by_name = {Requirement(text).name: span for text, span in roots.items()}
        for problem in problems:
            span = by_name.get(problem.requirement, first)
            self._report.add(codes.DISTRIBUTION, span, problem.message, help=problem.help)


def is_part(name: str) -> bool:
    """Whether `robocomp_dsl.part` of a dotted name is a module, and not a name in it."""
    part = name.split(".")[1]
    folder = Path(__file__).parents[2]
    return (folder / part).is_dir() or (folder / f"{part}.py").is_file()


def _toolchain_requirements() -> list[str]:
    installed = find_installed(NAME)
    requires = (installed.requires if installed else None) or []
    return [text for text in requires if "extra ==" not in text]


def _span(place: ImportPlace) -> Span:
    return Source.read(Path(place.file)).span_at(place.line, 1, 1)
