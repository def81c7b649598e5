"""Plain Ice programs call a component of ours."""

from __future__ import annotations

import contextlib
import random
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace
from typing import Any

import pytest

from robocomp_dsl.runtime.codec.ice import codec
from tests.middleware.ice.ice_component import IceComponent
from tests.middleware.ice.peers import Ice, PlainProgram, free_port
from tests.support.waiting import wait_until

pytestmark = pytest.mark.peers
EIGHT_MB = 8_000_000


class Store:
    """The handlers of the component."""

    def __init__(self, types: Any) -> None:
        self.types = types
        self.received: list[str] = []
        self.items = [types.Item("a", types.Kind.Huge, 0.5), types.Item("b", types.Kind.Small)]

    def find(self, name: str) -> Any:
        if name == "silent":
            raise self.types.Silent
        if name != "a":
            raise self.types.NotThere(name, 404)
        return self.items[0]

    def split(self, number: int, by: int) -> Any:
        return number // by, number % by, {"seen": number, "": -1}

    def fail(self, why: str) -> None:
        raise KeyError(why)

    def put(self, item: Any) -> None:
        self.received.append(item.name)

    def handlers(self) -> dict[str, Callable[..., Any]]:
        return {
            "find": self.find,
            "split": self.split,
            "all": lambda: self.items,
            "describe": lambda: (self.items, {"n": 2}),
            "scale": lambda values, factor: values * factor,
            "echo": lambda pixels: pixels,
            "empty": lambda nothing: nothing,
            "fail": self.fail,
            "put": self.put,
            "list": lambda number: number + 1,
            "__hidden": lambda value: -value,
        }


@pytest.fixture
def served(component: Callable[..., IceComponent], generated: Any) -> SimpleNamespace:
    """A component that serves Store at a port that RoboComp's configurations would name."""
    port = free_port()
    own = component(addresses={("ice", "Store"): f"tcp -h 127.0.0.1 -p {port}"})
    store = Store(generated)
    own.serve(generated.STORE, store.handlers())
    address = f"store:tcp -h localhost -p {port}"
    return SimpleNamespace(address=address, store=store, component=own)


@pytest.fixture
def client(
    served: SimpleNamespace, plain: Callable[..., PlainProgram], slices: SimpleNamespace
) -> Any:
    """The proxy of a plain program, after Ice has asked for the type of the object."""
    proxy = plain(MessageSizeMax="0").proxy(served.address)
    return slices.store.StorePrx.checkedCast(proxy)


def test_ice_servant_answers_what_every_object_does(client: Any) -> None:
    assert client
    client.ice_ping()
    assert client.ice_id() == "::RoboCompStore::Store"
    assert client.ice_ids() == ["::Ice::Object", "::RoboCompStore::Store"]
    assert client.ice_isA("::Ice::Object")
    assert not client.ice_isA("::RoboCompStore::StorePub")


def test_plain_client_gets_results_and_out_parameters(client: Any, slices: SimpleNamespace) -> None:
    item = client.find("a")
    assert (item.name, item.kind, item.weight) == ("a", slices.store.Kind.Huge, 0.5)
    assert client.split(17, 5) == (3, 2, {"seen": 17, "": -1})
    assert [each.name for each in client.all()] == ["a", "b"]
    items, counts = client.describe()
    assert (len(items), counts) == (2, {"n": 2})
    assert client.scale([1.0, 2.0], 1.5) == [1.5, 3.0]
    assert client.empty(slices.store.Nothing()) == slices.store.Nothing()
    assert client.reset() is None
    assert client.list(4) == 5
    assert client.hidden(4) == -4


def test_plain_client_gets_declared_exceptions(client: Any, slices: SimpleNamespace) -> None:
    with pytest.raises(slices.faults.NotThere) as caught:
        client.find("z")
    assert (caught.value.name, caught.value.code) == ("z", 404)
    with pytest.raises(slices.faults.Silent):
        client.find("silent")


def test_plain_client_gets_failure_of_handler_as_unknown_exception(
    client: Any, served: SimpleNamespace
) -> None:
    with pytest.raises(Ice.UnknownException) as caught:
        client.fail("no reason")
    assert "KeyError: 'no reason'" in caught.value.unknown
    assert "Traceback" not in caught.value.unknown
    assert client.list(1) == 2
    assert served.component.statistics.of("Store", "fail").failures == 1


def test_plain_client_exchanges_8_mb(client: Any) -> None:
    pixels = bytes(EIGHT_MB)
    assert client.echo(pixels) == pixels


def test_plain_client_sends_commands_in_order(client: Any, served: SimpleNamespace) -> None:
    from RoboCompStore import Item, Kind  # noqa: PLC0415

    oneway = client.ice_oneway()
    names = [str(i) for i in range(300)]
    for index, name in enumerate(names):
        (client if index % 7 == 0 else oneway).put(Item(name, Kind.Small, 0.0))
    wait_until(lambda: len(served.store.received) == len(names))
    assert served.store.received == names


def test_plain_clients_call_concurrently(client: Any) -> None:
    with ThreadPoolExecutor(16) as pool:
        assert list(pool.map(client.list, range(200))) == list(range(1, 201))


def test_plain_client_with_other_interface_gets_ices_own_errors(
    client: Any, served: SimpleNamespace
) -> None:
    empty = bytes.fromhex("060000000101")
    with pytest.raises(Ice.OperationNotExistException):
        client.ice_invoke("unknown", Ice.OperationMode.Normal, empty)
    with pytest.raises(Ice.UnknownLocalException) as caught:
        client.ice_invoke("list", Ice.OperationMode.Normal, empty)
    assert "field self, byte 6: 4 bytes expected, 0 left" in caught.value.unknown
    assert served.component.statistics.of("Store", "list").malformed == 1


def test_own_client_and_plain_client_use_the_same_port(
    client: Any, component: Callable[..., IceComponent], generated: Any
) -> None:
    caller = component("caller")
    proxy = generated.StoreProxy(caller.ports.proxy(caller.endpoint(generated.STORE)))
    assert proxy.find("a") == generated.Item("a", generated.Kind.Huge, 0.5)
    with pytest.raises(generated.NotThere, match="404"):
        proxy.find("b")


def test_component_survives_mutated_requests(
    client: Any, served: SimpleNamespace, generated: Any
) -> None:
    put = next(o for o in generated.STORE.operations if o.name == "put")
    split = next(o for o in generated.STORE.operations if o.name == "split")
    requests = {
        "put": codec.request_encoder(put)((generated.Item("name", generated.Kind.Large, 1.0),)),
        "split": codec.request_encoder(split)((17, 5)),
        "ice_isA": bytes.fromhex("0b0000000101 04 3a3a4142"),
    }
    source = random.Random(7)
    for _ in range(3000):
        name, request = source.choice(list(requests.items()))
        data = bytearray(request)
        for _ in range(source.randint(1, 3)):
            data[source.randrange(len(data))] = source.randrange(256)
        with contextlib.suppress(Ice.Exception):
            client.ice_invoke(name, Ice.OperationMode.Normal, bytes(data))
    assert client.list(1) == 2
    assert served.component.statistics.of("Store", "split").malformed > 100
