"""The Python packages of the image: those of all components together, with the versions here.

In: the processes and their trees. Out: the text of `requirements.txt`.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping

from robocomp_dsl import __version__
from robocomp_dsl.deploy.content.lock import EnvironmentLocker
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.content.wheel_target import WheelTarget
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment

MACHINE, GLIBC = "x86_64", (2, 36)
"""Of the image `python:X-slim`; the versions are the same on other processors."""


def python_version() -> str:
    """The version of Python as in `3.11`, which the image has, too."""
    return f"{sys.version_info.major}.{sys.version_info.minor}"


def locked_requirements(
    deployment: Deployment, plan: Plan, trees: Mapping[str, ContentTree], report: Report
) -> str:
    """`NAME==VERSION` for each package that a component needs."""
    python = WheelTarget(sys.executable, sys.version_info[:2], MACHINE, GLIBC)
    locker = EnvironmentLocker(deployment, plan, python, report)
    found = set(locker.lock_runtime(deployment.span).distributions)
    for process in plan.processes:
        if environment := locker.lock(process, trees[process.name]):
            found |= set(environment.distributions)
    # The first process of a container imports robocomp_dsl.deploy, which is always in the package.
    lines = [f"robocomp_dsl=={__version__}", *map(str, sorted(found))]
    return "".join(f"{line}\n" for line in lines)
