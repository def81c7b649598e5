"""`rcgen view --live`: a simulation that runs, on a page or as a picture.

In: the name of a component or none, a domain or a deployment or none. Out: a page that follows it
until Ctrl-C, or a PNG file.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import Never, TypeAlias

from robocomp_dsl.cli import options, view
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.deploy import folder
from robocomp_dsl.hardware.simulation_interface import (
    INNERMODELMANAGER,
    SIMULATION,
    InnerModelManagerProxy,
    SimulationProxy,
)
from robocomp_dsl.hardware.view.picture import Look
from robocomp_dsl.hardware.view.running import CannotFollow, look_at
from robocomp_dsl.runtime.errors import AmbiguousServer, MiddlewareError
from robocomp_dsl.runtime.onlooker import Onlooker

ME = f"rcgen-view-{os.getpid()}"
DEFAULT = "default"
PATIENCE_S = 3.0

Proxies: TypeAlias = tuple[SimulationProxy, InnerModelManagerProxy]


def show(
    component: str,
    domain: str | None,
    look: Look,
    screenshot: Path | None,
    size: tuple[int, int],
    port: int,
) -> None:
    """See the module; ends with exit code 1 where there is none, or several."""
    with _hand(component, domain) as (hand, nodes):
        try:
            if screenshot:
                seen = look_at(hand)
                view.photograph(seen.model, seen.data(), screenshot, size, look)
            else:
                _serve(component or "simulation", hand, nodes, look, port)
        except AmbiguousServer as error:
            names = [one.partition(".")[0] for one in error.servers]
            _fail(f"{' and '.join(names)} run there: say which, as in `--live {names[0]}`")
        except (MiddlewareError, CannotFollow) as error:
            _fail(str(error))


def _serve(
    name: str, hand: SimulationProxy, nodes: InnerModelManagerProxy, look: Look, port: int
) -> None:
    try:
        from robocomp_dsl.hardware.view.live import LivePage  # noqa: PLC0415 - needs an extra

        page = LivePage(name, hand, look, port=port, nodes=nodes)
    except ImportError as missing:
        _fail(str(missing))
    except OSError as error:
        view.taken(port, error)
    view.tell(page.page.url)
    try:
        page.run()
    finally:
        page.close()


@contextmanager
def _hand(component: str, domain: str | None) -> Iterator[Proxies]:
    """The simulation that is meant."""
    domains = _domains(domain)
    with ExitStack() as stack:
        found = {}
        for name in domains:
            proxies = stack.enter_context(_connected(component, name))
            if proxies[0].wait_for_server(PATIENCE_S / len(domains)):
                found[name] = proxies
        if len(found) != 1:
            _fail(_unclear(component, list(found), domains))
        yield next(iter(found.values()))


@contextmanager
def _connected(component: str, domain: str) -> Iterator[Proxies]:
    try:
        looker = Onlooker(domain, name=ME)
    except MiddlewareError as error:
        _fail(str(error))
    with closing(looker):
        yield (
            SimulationProxy(looker.link(SIMULATION, component, "Simulation")),
            InnerModelManagerProxy(looker.link(INNERMODELMANAGER, component, "InnerModelManager")),
        )


def _domains(said: str | None) -> Sequence[str]:
    """Where to look: a deployment stands for its domain."""
    try:
        running = {one.name: one.domain for one in folder.running()}
    except folder.Unavailable:
        running = {}
    if said is not None:
        return [running.get(said, said)]
    return list(dict.fromkeys([*running.values(), DEFAULT]))


def _unclear(component: str, found: Sequence[str], domains: Sequence[str]) -> str:
    if found:
        return f"simulations run in several domains: say which, --domain {found[0]}"
    what = f"no simulation called `{component}`" if component else "no simulation"
    return (
        f"{what} runs in the domain {' or '.join(f'`{one}`' for one in domains)}; start it"
        " (`python3 main.py`, `rcdeploy app.ddsl up`), or say where it is with --domain"
    )


def _fail(message: str) -> Never:
    options.complain(message)
    sys.exit(FINDINGS)
