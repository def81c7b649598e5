"""The components of a running deployment, asked themselves over their interface `Component`.

In: a domain, names of components. Out: proxies, or what each tells of its life.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from typing import TypeAlias

from robocomp_dsl.runtime.component_interface import ComponentInfo, ComponentProxy
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.onlooker import Onlooker

ProxyOf: TypeAlias = Callable[[str], ComponentProxy]
_AT_ONCE = 16


@contextmanager
def proxies(domain: str, patience_s: float) -> Iterator[ProxyOf]:
    """Calls components by their names. What is asked of them raises `MiddlewareError`."""
    with closing(Onlooker(domain, name="rcdeploy")) as looker:

        def proxy_of(name: str) -> ComponentProxy:
            proxy = looker.component(name)
            proxy.set_timeout(patience_s)
            return proxy

        yield proxy_of


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
