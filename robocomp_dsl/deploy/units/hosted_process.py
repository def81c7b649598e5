"""What the unit of a component needs to know beside the plan. Pure data."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.units.quoting import PathMap

HOME = "/@home"
"""Stands for the home folder of a host's user in paths of a `HostedProcess`."""
HOST_PATHS = PathMap(((HOME, "%h"),))


@dataclass(frozen=True, slots=True)
class HostedProcess:
    """A process of the plan on a host. All its paths are those of the host, below `HOME`.

    `process` has the host's paths, too; `host` is its name in the description, `root` the folder of
    the deployment. `python` runs the helpers of the unit. `network` is the file with the network
    settings, "" without; `certificate` identifies its content and the component's certificate.
    `tree` and `environment` identify what was copied.
    """

    process: Process
    host: str
    root: str
    python: str
    network: str = ""
    certificate: str = ""
    tree: str = ""
    environment: str = ""
