"""The tables agree: what is offered is simulated, has a servant, and that knows every operation."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.simulator.served_interfaces import OF_THE_WORLD, SERVED, TOPICS, Topic
from robocomp_dsl.hardware.servants.registry import SERVANTS
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.types import Declaration
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.simulation.scene.scene_devices import SINGLE
from robocomp_dsl.simulation.servants.registry import WORLD_SERVANTS

ALL_SERVANTS = {**SERVANTS, **WORLD_SERVANTS}

OFFERED = sorted({served.interface for served in SERVED} | set(OF_THE_WORLD))


def declared(name: str, file: str = "") -> Interface:
    modules = check_idsl(Path(INTERFACES) / f"{file or name}.idsl", Workspace(environ={}), Report())
    assert modules is not None
    return next(i for module in modules for i in module.interfaces if i.name == name)


def test_servant_tables_simulate_every_offered_kind() -> None:
    kinds = {offer.kind for offer in SERVED} - {"joint", "prismaticjoint", "skin"}
    assert kinds == set(SINGLE)


@pytest.mark.parametrize("name", OFFERED)
def test_servant_has_every_operation_with_its_parameters(name: str) -> None:
    interface = declared(name)
    servant = ALL_SERVANTS[interface.qualified]
    for operation in interface.operations:
        values = list(inspect.signature(getattr(servant, operation.name)).parameters)[1:]
        assert len(values) == len(operation.inputs), operation.name


def test_servant_tables_list_every_servant() -> None:
    assert {declared(name).qualified for name in OFFERED} == set(ALL_SERVANTS)


@pytest.mark.parametrize(
    "topic", [topic for topic in TOPICS if not topic.on_change], ids=lambda topic: topic.published
)
def test_topic_table_type_matches_port_operation(topic: Topic) -> None:
    asked = next(o for o in declared(topic.interface).operations if o.name == topic.query)
    to = declared(topic.published, topic.file)
    received = next(o for o in to.operations if o.name == topic.operation)
    results = [asked.result] if asked.result else [output.type for output in asked.outputs]
    assert [named(argument.type) for argument in received.inputs] == [
        named(result) for result in results
    ]


@pytest.mark.parametrize(
    "topic", [topic for topic in TOPICS if topic.on_change], ids=lambda topic: topic.published
)
def test_topic_table_of_change_topics_has_servants(topic: Topic) -> None:
    to = declared(topic.published, topic.file)
    assert topic.operation in {operation.name for operation in to.operations}
    assert callable(ALL_SERVANTS[declared(topic.interface).qualified].poll)  # type: ignore[attr-defined]


def named(type_: object) -> tuple[str, str]:
    """A type by its module and name: both sides have read it for themselves."""
    assert isinstance(type_, Declaration)
    return type_.module, type_.name
