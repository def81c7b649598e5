"""Copies of a set of components in one domain: who finds whom under which prefix."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import pytest

from robocomp_dsl.runtime.errors import AmbiguousServer, NoServer
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_types import PROBE, NewsProxy
from tests.support.waiting import wait_until

pytestmark = pytest.mark.feature("Namespaces")


def serve(network: Network, *names: str) -> None:
    """Each answers with its position in `names`."""
    for i, name in enumerate(names):
        network.node(name).serve({"add": lambda *_, i=i: i})


def asked(network: Network, client: str, *peers: str) -> int:
    return network.node(client).probe(*peers).add(0, 0)


def asked_when_all_are_known(network: Network, client: str, count: int) -> int:
    probe = network.node(client).probe()
    wait_until(lambda: len(_known(network)) == count)
    return probe.add(0, 0)


SERVERS = ("base", "left/base", "right/base", "left/hand/base")


@pytest.mark.parametrize(
    ("client", "server"),
    [
        ("arm", "base"),
        ("left/arm", "left/base"),
        ("right/arm", "right/base"),
        ("left/hand/arm", "left/hand/base"),
    ],
)
def test_prefix_selects_server_beside(network: Network, client: str, server: str) -> None:
    serve(network, *SERVERS)
    assert SERVERS[asked(network, client)] == server


@pytest.mark.parametrize(
    ("client", "there", "server"),
    [
        ("left/arm", ("base", "right/base"), "base"),
        ("left/hand/arm", ("base", "left/base", "right/base"), "left/base"),
        ("left/arm", ("left/hand/base", "base"), "base"),
        ("left/arm", ("left/hand/base", "right/base"), "left/hand/base"),
        ("arm", ("left/base",), "left/base"),
    ],
)
@pytest.mark.usefixtures("short_discovery_timeout")
def test_prefix_selects_outer_server_then_inner_server(
    network: Network, client: str, there: tuple[str, ...], server: str
) -> None:
    serve(network, *there)
    assert there[asked_when_all_are_known(network, client, len(there))] == server


@pytest.mark.usefixtures("short_discovery_timeout")
def test_prefix_excludes_server_on_another_branch(network: Network) -> None:
    serve(network, "right/base", "leftish/base")
    with pytest.raises(NoServer, match=r"no component serves Test::Probe, which left/arm requires"):
        asked_when_all_are_known(network, "left/arm", 2)


def test_prefix_reaches_server_on_another_branch_by_name(network: Network) -> None:
    serve(network, "left/base", "right/base")
    assert asked(network, "left/arm", "right/base") == 1
    assert asked(network, "left/arm2", "right/base.Probe") == 1


def test_prefix_waits_for_server_beside_that_starts_later(network: Network) -> None:
    serve(network, "base")
    client, beside = network.node("left/arm"), network.node("left/base")
    probe = client.probe()
    with ThreadPoolExecutor(1) as pool:
        answer = pool.submit(probe.add, 0, 0)
        beside.serve({"add": lambda *_: 7})
        assert answer.result(DEADLINE) == 7


def test_prefix_with_two_servers_beside_is_ambiguous_until_connected(network: Network) -> None:
    serve(network, "left/a", "left/b", "c")
    probe = network.node("left/arm").probe()
    wait_until(lambda: len(_known(network)) == 3)
    with pytest.raises(AmbiguousServer, match=r"left/a\.Probe, left/b\.Probe all .*=/left/a$"):
        probe.add(0, 0)


def _known(network: Network) -> list[PortRecord]:
    registry: PortRegistry = network.nodes[-1].ports.presence.registry
    return registry.find("server", PROBE.name)


def test_prefix_keeps_topics_on_their_branch(network: Network) -> None:
    names = ("base", "left/base", "right/base", "left/hand/base")
    received: dict[str, set[str]] = {"arm": set(), "left/arm": set(), "right/arm": set()}
    for name, into in received.items():
        network.node(name).subscribe(lambda who, _n, into=into: into.add(who))
    proxies = {name: network.node(name).news() for name in names}
    _publish(proxies, lambda: sum(map(len, received.values())) == 4 + 3 + 2)
    assert received["arm"] == set(names)
    assert received["left/arm"] == {"base", "left/base", "left/hand/base"}
    assert received["right/arm"] == {"base", "right/base"}


def _publish(proxies: dict[str, NewsProxy], condition: Callable[[], object]) -> None:
    """Publish on all proxies repeatedly, so that a message on a wrong branch is received, too."""

    def again() -> bool:
        for name, proxy in proxies.items():
            proxy.announced(name, 0)
        return bool(condition())

    wait_until(again)
    for _ in range(3):
        again()


def test_prefix_publisher_does_not_wait_for_another_branch(network: Network) -> None:
    network.node("right/arm").subscribe(lambda *_: None)
    publisher = network.node("left/base").news()
    assert not publisher.wait_for_server(0.2)
    network.node("left/arm").subscribe(lambda *_: None)
    assert publisher.wait_for_server(DEADLINE)


def test_prefix_selects_named_port_beside(network: Network) -> None:
    """What `--remap` gives: `*.front`."""
    for prefix, result in (("left", 1), ("right", 2)):
        base = network.node(f"{prefix}/base")
        base.serve({"add": lambda *_, r=result: r}, port="front")
        base.serve({"add": lambda *_: 99}, port="back")
    assert asked(network, "left/arm", "*.front") == 1
    assert asked(network, "right/arm", "*.front") == 2


def test_prefix_routes_publications_of_named_port(network: Network) -> None:
    received: set[str] = set()
    network.node("left/arm").subscribe(lambda who, _n: received.add(who), "*.scan")
    proxies = {}
    for name in ("left/base", "right/base"):
        node = network.node(name)
        for port in ("scan", "other"):
            proxies[f"{name}.{port}"] = node.news(port)
    _publish(proxies, lambda: received)
    assert received == {"left/base.scan"}
