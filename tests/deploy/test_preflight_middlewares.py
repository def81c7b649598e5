"""Preflight: middlewares that cannot be used on this machine."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.deploy.middlewares import check_middlewares
from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription
from tests.deploy.test_plan_middlewares import deployment_of

MISSING = MiddlewareDescription(
    "rpc",
    "services only",
    Capabilities(external_peers=True),
    "rpc:open",
    requires=("zenoh", "no_such_package.core"),
    install="run: pip install no-such-package",
)
ONE_PROCESS = MiddlewareDescription(
    "shm", "one process", Capabilities(between_processes=False), "shm:open"
)


def findings(
    folder: Path, text: str, *further: MiddlewareDescription
) -> list[tuple[str, str, str]]:
    """Place, message and help of each finding."""
    deployment = deployment_of(folder, text)
    known = KnownMiddlewares(further)
    return [(d.span.text, d.message, d.help) for d in check_middlewares(deployment, known)]


def test_preflight_reports_missing_package_of_middleware(tmp_path: Path) -> None:
    text = "component body; component reflex; connect reflex.Laser -> body.Laser over rpc;"
    assert findings(tmp_path, text, MISSING) == [
        (
            "body",
            "`body` uses the middleware `rpc`, which needs `no_such_package.core`",
            "run: pip install no-such-package",
        )
    ]


def test_preflight_reports_middleware_of_one_process(tmp_path: Path) -> None:
    text = "component body { middleware shm; };"
    assert findings(tmp_path, text, ONE_PROCESS) == [
        (
            "body",
            "`body` uses the middleware `shm`, which cannot connect processes",
            "choose another middleware: `middleware zenoh;`",
        )
    ]


def test_preflight_reports_middleware_that_cannot_be_loaded(tmp_path: Path) -> None:
    deployment = deployment_of(tmp_path, "component body { middleware shm; };")
    (finding,) = check_middlewares(deployment, KnownMiddlewares())
    assert finding.message.startswith("`body`: unknown middleware `shm`; known: ")


def test_preflight_of_default_middleware_has_no_findings(tmp_path: Path) -> None:
    assert findings(tmp_path, "component body; component reflex;") == []
