"""A small workspace with components that are not generated, and the host that is this machine."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.hash_cache import HashCache
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts.local import LocalConnection
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.model.deployment import Deployment, Host

ROOT = ".local/share/robocomp/app"
CDSL = "Component {name} {{ Communications {{ }}; language Python; {more} }};"
PDSL = "ComponentParams {name} {{ file string; map string; rate float 50; }};"


def write_files(folder: Path, files: Mapping[str, str | bytes]) -> None:
    """Write files below `folder`."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)


def write_component(folder: Path, name: str, files: Mapping[str, str | bytes]) -> None:
    """A component with two text parameters and a `main.py`, below `folder`."""
    write_files(
        folder / name,
        {
            f"{name}.cdsl": CDSL.format(name=name, more=f'parameters "{name}.pdsl";'),
            f"{name}.pdsl": PDSL.format(name=name),
            "main.py": "print('hello')\n",
            **files,
        },
    )


def check(path: Path, text: str) -> tuple[Deployment, Plan]:
    """The deployment and the plan of a DDSL text, which has no errors."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    report = Report()
    deployment = check_ddsl(path, Workspace(), report)
    assert deployment is not None, [str(finding.message) for finding in report]
    assert not report.has_errors, [str(finding.message) for finding in report]
    return deployment, plan(deployment, name="app", domain="app", interpreter="/py")


def describe(
    path: Path, text: str, hashes: HashCache | None = None
) -> tuple[dict[str, ContentTree], list[Diagnostic]]:
    """The trees of a DDSL text, and the findings."""
    deployment, planned = check(path, text)
    report = Report()
    return describe_trees(deployment, planned, report, hashes), report.sorted()


def local_connection() -> LocalConnection:
    """This machine as a host; its home is that of the test."""
    return LocalConnection(Host("robot", "localhost"))
