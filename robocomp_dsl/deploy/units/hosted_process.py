"""What the unit of a component needs to know beside the plan. Pure data."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.units.quoting import NO_PATHS, PathMap


@dataclass(frozen=True, slots=True)
class HostedProcess:
    """A process of the plan on a host. All paths are as in a unit file, `%h` is the home folder.

    `host` is its name in the description. `folder` is the working folder; `paths` maps local paths
    in the command line and the environment. `python` runs the helpers of the unit. `network` is the
    file with the network settings, "" without; `certificate` is the fingerprint of the component's
    certificate. `tree` and `environment` identify what was copied.
    """

    process: Process
    host: str
    folder: str
    log: str
    python: str
    paths: PathMap = NO_PATHS
    network: str = ""
    certificate: str = ""
    tree: str = ""
    environment: str = ""
