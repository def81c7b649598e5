"""Every type of IDSL, with its limits, in queries, commands, publications and exceptions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import EncodeError, RemoteError
from tests.middleware.conformance.value_types import (
    READING,
    TYPES,
    VALUE_COMMANDS,
    VALUE_ECHO,
    VALUE_NEWS,
    VALUES,
    Color,
    Failure,
    PlainFailure,
    Point,
    PointList,
    Tree,
    identical,
)
from tests.middleware.network import DEADLINE, Network
from tests.support.waiting import wait_until

CASES = [
    pytest.param(name, value, id=f"{name}-{number}")
    for name, values in VALUES.items()
    for number, value in enumerate(values)
]
pytestmark = pytest.mark.feature("Types and values")
Received = list[tuple[str, tuple[Any, ...]]]


def fail(plain: bool) -> None:
    if plain:
        raise PlainFailure
    raise Failure("no such thing ñ", [1, -1], READING, Color.BLUE)


HANDLERS: dict[str, Callable[..., Any]] = {
    **{name: (lambda value: value) for name in TYPES},
    "several": lambda a, text, points: (a / 2, READING, Color.GREEN, [text, *map(str, points)]),
    "only_outputs": lambda: (7, "seven"),
    "unmarked": lambda value: None,
    "fail": fail,
}


@pytest.fixture(scope="module")
def shared_network(middleware: str) -> Iterator[Network]:
    opened = Network(middleware)
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def echo(shared_network: Network) -> Callable[..., Any]:
    """Calls an operation of a server that returns what it receives."""
    shared_network.node("echo_server").serve(HANDLERS, VALUE_ECHO, "ValueEcho")
    node = shared_network.node("echo_client")
    channel = node.ports.proxy(node.at(VALUE_ECHO, "ValueEcho"))
    assert channel.wait(DEADLINE)
    bound = {operation.name: channel.bind(operation) for operation in VALUE_ECHO.operations}
    return lambda name, *arguments: bound[name](*arguments)


@pytest.fixture(scope="module")
def command(shared_network: Network) -> tuple[Callable[..., Any], Received]:
    """Calls a command; and what its handlers received."""
    received: Received = []
    handlers = {
        operation.name: lambda *values, name=operation.name: received.append((name, values))
        for operation in VALUE_COMMANDS.operations
    }
    shared_network.node("commanded").serve(handlers, VALUE_COMMANDS, "ValueCommands")
    node = shared_network.node("commander")
    channel = node.ports.proxy(node.at(VALUE_COMMANDS, "ValueCommands"))
    bound = {operation.name: channel.bind(operation) for operation in VALUE_COMMANDS.operations}
    return lambda name, *arguments: bound[name](*arguments), received


@pytest.fixture(scope="module")
def publish(shared_network: Network) -> tuple[Callable[..., Any], Received]:
    """Publishes; and what a subscriber received."""
    received: Received = []
    handlers = {
        operation.name: lambda *values, name=operation.name: received.append((name, values))
        for operation in VALUE_NEWS.operations
    }
    listener = shared_network.node("listener")
    listener.ports.subscribe(
        listener.at(VALUE_NEWS, "ValueNews", qos=Qos(depth=1000)), handlers, listener.execution
    )
    node = shared_network.node("publisher")
    channel = node.ports.advertise(node.at(VALUE_NEWS, "ValueNews"))
    bound = {operation.name: channel.bind(operation) for operation in VALUE_NEWS.operations}
    assert channel.wait(DEADLINE)
    wait_until(lambda: bound["nothing"]() or ("nothing", ()) in received)
    return lambda name, *arguments: bound[name](*arguments), received


@pytest.mark.needs("services")
@pytest.mark.parametrize(("name", "value"), CASES)
def test_query_returns_value_of_every_type(
    echo: Callable[..., Any], name: str, value: object
) -> None:
    assert identical(echo(name, value), value)


@pytest.mark.needs("services")
def test_query_has_several_inputs_and_outputs(echo: Callable[..., Any]) -> None:
    points = PointList([Point(1.0, 2.0, 3)])
    assert identical(
        echo("several", 5, "text", points),
        (2.5, READING, Color.GREEN, ["text", str(points[0])]),
    )
    assert echo("only_outputs") == (7, "seven")
    assert echo("unmarked", 3) is None


@pytest.mark.needs("services")
def test_query_raises_declared_exception_with_all_its_fields(echo: Callable[..., Any]) -> None:
    with pytest.raises(Failure) as caught:
        echo("fail", False)
    error = caught.value
    assert (error.reason, list(error.codes), error.color) == (
        "no such thing ñ",
        [1, -1],
        Color.BLUE,
    )
    assert identical(error.at, READING)
    with pytest.raises(PlainFailure):
        echo("fail", True)


@pytest.mark.needs("services")
@pytest.mark.parametrize(("name", "value"), CASES)
def test_command_carries_value_of_every_type(
    command: tuple[Callable[..., Any], Received], name: str, value: object
) -> None:
    send, received = command
    received.clear()
    send(name, value)
    wait_until(lambda: received)
    assert [operation for operation, _ in received] == [name]
    assert identical(received[0][1], (value,))


@pytest.mark.needs("services")
def test_command_without_inputs_arrives(command: tuple[Callable[..., Any], Received]) -> None:
    send, received = command
    received.clear()
    send("nothing")
    wait_until(lambda: received == [("nothing", ())])


@pytest.mark.needs("topics")
@pytest.mark.parametrize(("name", "value"), CASES)
def test_publication_carries_value_of_every_type(
    publish: tuple[Callable[..., Any], Received], name: str, value: object
) -> None:
    send, received = publish
    received.clear()
    send(name, value)
    wait_until(lambda: [each for each in received if each[0] == name])
    assert identical(received[-1][1], (value,))


@pytest.mark.needs("topics")
def test_publication_has_several_inputs(publish: tuple[Callable[..., Any], Received]) -> None:
    send, received = publish
    received.clear()
    tree = Tree([READING], {"a": READING})
    send("several", 1, tree, 2**62)
    send("unmarked", 4)
    wait_until(lambda: len([each for each in received if each[0] != "nothing"]) == 2)
    values = dict(received)
    assert identical(values["several"], (1, tree, 2**62))
    assert values["unmarked"] == (4,)


@pytest.mark.feature("Errors of values")
@pytest.mark.needs("between_processes", "services")
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("int", 2**31),
        ("int", "text"),
        ("byte", -1),
        ("string", 3),
        ("string", "\ud800"),
        ("struct", 3),
        ("enum", 99),
        ("ints", [2**31]),
        ("points", [3]),
        ("by_name", {"a": 3}),
    ],
    ids=str,
)
def test_value_that_does_not_fit_raises_encode_error_at_caller(
    echo: Callable[..., Any],
    command: tuple[Callable[..., Any], Received],
    name: str,
    value: object,
) -> None:
    with pytest.raises(EncodeError):
        echo(name, value)
    with pytest.raises(EncodeError):
        command[0](name, value)
    assert echo("int", 3) == 3


@pytest.mark.feature("Errors of values")
@pytest.mark.needs("between_processes", "topics")
def test_publication_that_does_not_fit_raises_encode_error(
    publish: tuple[Callable[..., Any], Received],
) -> None:
    send, received = publish
    with pytest.raises(EncodeError):
        send("int", 2**31)
    received.clear()
    send("int", 5)
    wait_until(lambda: ("int", (5,)) in received)
    assert all(name in {"int", "nothing"} for name, _ in received)


@pytest.mark.feature("Errors of values")
@pytest.mark.needs("between_processes", "services")
def test_result_that_does_not_fit_is_remote_error(network: Network) -> None:
    results: list[object] = ["text", None, 2**40, 3]
    network.node("server").serve({"int": lambda _value: results.pop(0)}, VALUE_ECHO, "ValueEcho")
    node = network.node("client")
    call = node.ports.proxy(node.at(VALUE_ECHO, "ValueEcho")).bind(VALUE_ECHO.operation("int"))
    for _ in range(3):
        with pytest.raises(RemoteError, match="EncodeError"):
            call(0)
    assert call(0) == 3
