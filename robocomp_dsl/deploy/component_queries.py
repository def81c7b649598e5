"""Queries running components through their interface `Component`.

In: a domain, names of components. Out: proxies, or the `ComponentState` of each component.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from dataclasses import dataclass
from typing import TypeAlias

from robocomp_dsl.runtime.client import DomainClient
from robocomp_dsl.runtime.component.component_interface import ComponentInfo, ComponentProxy
from robocomp_dsl.runtime.errors import MiddlewareError

ProxyFactory: TypeAlias = Callable[[str], ComponentProxy]
_MAX_PARALLEL = 32
MIN_CALL_TIMEOUT_S = 0.1


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
    """The state of each component; components that do not reply in time are left out.

    It takes at most about `timeout_s` seconds for all of them.
    """
    requested = list(names)
    if not requested:
        return {}
    deadline = time.monotonic() + timeout_s
    try:
        with (
            component_proxies(domain, timeout_s) as proxy_of,
            ThreadPoolExecutor(min(len(requested), _MAX_PARALLEL)) as pool,
        ):
            replies = pool.map(lambda name: _fetch_state(proxy_of(name), deadline), requested)
            return {name: state for name, state in zip(requested, replies, strict=True) if state}
    except MiddlewareError:
        return {}


def _fetch_state(proxy: ComponentProxy, deadline: float) -> ComponentState | None:
    try:
        if not proxy.wait_for_server(max(deadline - time.monotonic(), 0.0)):
            return None
        proxy.set_timeout(max(deadline - time.monotonic(), MIN_CALL_TIMEOUT_S))
        return ComponentState(proxy.getInfo(), proxy.getStatistics().overruns)
    except MiddlewareError:
        return None
