"""Queries running components through their interface `Component`.

In: a domain, names of components. Out: proxies, or the `ComponentInfo` of each component.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
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


def fetch_infos(domain: str, names: Iterable[str], timeout_s: float) -> Mapping[str, ComponentInfo]:
    """The `ComponentInfo` of each component; components that do not reply in time are left out."""
    requested = list(names)
    if not requested:
        return {}
    try:
        with (
            component_proxies(domain, timeout_s) as proxy_of,
            ThreadPoolExecutor(_MAX_PARALLEL) as pool,
        ):
            replies = pool.map(lambda name: _fetch_info(proxy_of(name), timeout_s), requested)
            return {name: info for name, info in zip(requested, replies, strict=True) if info}
    except MiddlewareError:
        return {}


def _fetch_info(proxy: ComponentProxy, timeout_s: float) -> ComponentInfo | None:
    try:
        return proxy.getInfo() if proxy.wait_for_server(timeout_s) else None
    except MiddlewareError:
        return None
