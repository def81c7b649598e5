"""Queries running components through their interface `Component`.

In: a domain, names of components. Out: proxies, or the `ComponentState` of each component.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from dataclasses import dataclass
from typing import TypeAlias

from robocomp_dsl.runtime.client import DomainClient
from robocomp_dsl.runtime.component.component_interface import ComponentInfo, ComponentProxy
from robocomp_dsl.runtime.errors import MiddlewareError

ProxyFactory: TypeAlias = Callable[[str], ComponentProxy]
_MAX_PARALLEL = 16


@contextmanager
def component_proxies(domain: str, timeout_s: float) -> Iterator[ProxyFactory]:
    """Open the domain; yields a function from a component's name to its proxy.

    Calls time out after `timeout_s` seconds. Opening and calling raise `MiddlewareError`.
    """
    with closing(DomainClient(domain, name="rcdeploy")) as client:

        def proxy_of(name: str) -> ComponentProxy:
            proxy = client.component(name)
            proxy.set_timeout(timeout_s)
            return proxy

        yield proxy_of


@dataclass(frozen=True, slots=True)
class ComponentState:
    """What a running component says about itself."""

    info: ComponentInfo
    overruns: int


def fetch_states(
    domain: str, names: Iterable[str], timeout_s: float
) -> Mapping[str, ComponentState]:
    """The state of each component; components that do not reply in time are left out."""
    requested = list(names)
    if not requested:
        return {}
    try:
        with (
            component_proxies(domain, timeout_s) as proxy_of,
            ThreadPoolExecutor(_MAX_PARALLEL) as pool,
        ):
            replies = pool.map(lambda name: _fetch_state(proxy_of(name), timeout_s), requested)
            return {name: state for name, state in zip(requested, replies, strict=True) if state}
    except MiddlewareError:
        return {}


def _fetch_state(proxy: ComponentProxy, timeout_s: float) -> ComponentState | None:
    try:
        if not proxy.wait_for_server(timeout_s):
            return None
        return ComponentState(proxy.getInfo(), proxy.getStatistics().overruns)
    except MiddlewareError:
        return None
