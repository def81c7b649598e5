"""The components of a running deployment, asked themselves over their interface `Component`.

In: a domain, names of components. Out: proxies, or what each tells of its life.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import TypeAlias

from robocomp_dsl.runtime.component_interface import COMPONENT, ComponentInfo, ComponentProxy
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, Host
from robocomp_dsl.runtime.statistics import Statistics

ProxyOf: TypeAlias = Callable[[str], ComponentProxy]
_NAME = "rcdeploy"
_AT_ONCE = 16


@contextmanager
def proxies(domain: str, patience_s: float) -> Iterator[ProxyOf]:
    """Calls components by their names. What is asked of them raises `MiddlewareError`."""
    middleware = open_middleware("zenoh", Host(_NAME, domain, Execution(), Statistics()))

    def proxy_of(name: str) -> ComponentProxy:
        proxy = ComponentProxy(middleware.proxy(Endpoint(COMPONENT, _NAME, "Component", (name,))))
        proxy.set_timeout(patience_s)
        return proxy

    try:
        yield proxy_of
    finally:
        middleware.close()


def infos(domain: str, names: Iterable[str], patience_s: float) -> Mapping[str, ComponentInfo]:
    """What each of `names` tells of itself; who does not answer in time is left out."""
    asked = list(names)
    if not asked:
        return {}
    try:
        with proxies(domain, patience_s) as proxy_of, ThreadPoolExecutor(_AT_ONCE) as pool:
            found = pool.map(lambda name: _info(proxy_of(name), patience_s), asked)
            return {name: info for name, info in zip(asked, found, strict=True) if info}
    except MiddlewareError:
        return {}


def _info(proxy: ComponentProxy, patience_s: float) -> ComponentInfo | None:
    try:
        return proxy.getInfo() if proxy.wait_for_server(patience_s) else None
    except MiddlewareError:
        return None
