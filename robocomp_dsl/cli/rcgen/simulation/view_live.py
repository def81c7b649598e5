"""`rcgen view --live`: a running simulation, on a page or as a picture.

In: the name of a component or none, a domain or a deployment or none. Out: a page that follows it
until Ctrl-C, or a PNG file.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import TypeAlias

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.simulation import view_output
from robocomp_dsl.deploy import instances
from robocomp_dsl.runtime.client import DomainClient
from robocomp_dsl.runtime.errors import AmbiguousServer, MiddlewareError
from robocomp_dsl.simulation.simulation_interface import (
    INNERMODELMANAGER,
    SIMULATION,
    InnerModelManagerProxy,
    SimulationProxy,
)
from robocomp_dsl.simulation.view.live_state import UnsupportedSimulation, fetch_live_state
from robocomp_dsl.simulation.view.picture import Viewpoint

CLIENT_NAME = f"rcgen-view-{os.getpid()}"
DEFAULT_DOMAIN = "default"
DISCOVERY_TIMEOUT_S = 3.0

Proxies: TypeAlias = tuple[SimulationProxy, InnerModelManagerProxy]


def show(
    component: str,
    domain: str | None,
    look: Viewpoint,
    screenshot: Path | None,
    size: tuple[int, int] | None,
    port: int,
    *,
    opens: bool | None,
) -> None:
    """See the module; exits with code 1 unless exactly one simulation matches."""
    with _simulation(component, domain) as (simulation, nodes):
        try:
            if screenshot:
                seen = fetch_live_state(simulation)
                view_output.save_screenshot(seen.model, seen.data(), screenshot, size, look)
            else:
                _serve(component or "simulation", simulation, nodes, look, port, opens=opens)
        except AmbiguousServer as error:
            names = [server.partition(".")[0] for server in error.servers]
            raise CliError(
                EXIT_FINDINGS,
                f"{' and '.join(names)} are running: select one, for example `--live {names[0]}`",
            ) from None
        except (MiddlewareError, UnsupportedSimulation) as error:
            raise CliError(EXIT_FINDINGS, str(error)) from None


def _serve(
    name: str,
    simulation: SimulationProxy,
    nodes: InnerModelManagerProxy,
    look: Viewpoint,
    port: int,
    *,
    opens: bool | None,
) -> None:
    from robocomp_dsl.simulation.view.live import LivePage  # noqa: PLC0415 - needs an extra

    with view_output.page_errors(port):
        page = LivePage(name, simulation, look, port=port, nodes=nodes)
    with closing(page), view_output.shown_page(page.page.url, opens=opens):
        page.run()


@contextmanager
def _simulation(component: str, domain: str | None) -> Iterator[Proxies]:
    """The proxies of the selected simulation."""
    domains = _domains(domain)
    with ExitStack() as stack:
        found = {}
        for name in domains:
            proxies = stack.enter_context(_connected(component, name))
            if proxies[0].wait_for_server(DISCOVERY_TIMEOUT_S / len(domains)):
                found[name] = proxies
        if len(found) != 1:
            raise CliError(EXIT_FINDINGS, _selection_problem(component, list(found), domains))
        yield next(iter(found.values()))


@contextmanager
def _connected(component: str, domain: str) -> Iterator[Proxies]:
    try:
        looker = DomainClient(domain, name=CLIENT_NAME)
    except MiddlewareError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    with closing(looker):
        yield (
            SimulationProxy(looker.channel(SIMULATION, component, "Simulation")),
            InnerModelManagerProxy(
                looker.channel(INNERMODELMANAGER, component, "InnerModelManager")
            ),
        )


def _domains(requested: str | None) -> Sequence[str]:
    """The domains to search; the name of a deployment selects its domain."""
    try:
        running = {item.name: item.domain for item in instances.running()}
    except instances.Unavailable:
        running = {}
    if requested is not None:
        return [running.get(requested, requested)]
    return list(dict.fromkeys([*running.values(), DEFAULT_DOMAIN]))


def _selection_problem(component: str, found: Sequence[str], domains: Sequence[str]) -> str:
    if found:
        return f"simulations run in several domains: select one, for example --domain {found[0]}"
    what = f"no simulation called `{component}`" if component else "no simulation"
    return (
        f"{what} runs in the domain {' or '.join(f'`{domain}`' for domain in domains)}; start it"
        " (`python3 main.py`, `rcdeploy app.ddsl up`), or select its domain with --domain"
    )
