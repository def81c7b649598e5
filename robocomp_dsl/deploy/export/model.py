"""What is exported: a deployment whose processes have the paths of their containers. Pure data."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.model.deployment import Deployment, Instance

ROUTER = "router"
"""The service through which components find each other."""
ROUTER_PORT = 7447
CONTENT = "/opt/robocomp/content"
"""Where the files of components are in the image."""
NETWORK_SOURCE = "/run/secrets/robocomp"
"""Where a container finds its network settings and keys."""
STATE = "/run/robocomp"
"""A file system in memory: what the first process of a container shows and keeps."""


@dataclass(frozen=True, slots=True)
class ConfigFile:
    """A configuration file of a component: `source` here, `target` in the container."""

    source: Path
    target: str


@dataclass(frozen=True, slots=True)
class ExportedProcess:
    """A process in a container.

    `service` is its name there: lower-case letters, digits and `-`. `process` has the paths of the
    container; `device_files` are those that its settings name. `secrets` are variables whose value
    is not exported.
    """

    service: str
    process: Process
    instance: Instance
    tree: ContentTree
    configs: tuple[ConfigFile, ...] = ()
    device_files: tuple[str, ...] = ()
    secrets: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ExportedDeployment:
    """A deployment in containers; `name` is a service name, too."""

    name: str
    domain: str
    deployment: Deployment
    processes: tuple[ExportedProcess, ...]
    requirements: str

    def service_of(self, full_name: str) -> str:
        """The service of a process."""
        return next(p.service for p in self.processes if p.process.name == full_name)
