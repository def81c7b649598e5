"""The tables agree: what is offered is simulated, has a servant, and that knows every operation."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

from robocomp_dsl.check import check_idsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.simulator.offers import OF_THE_WORLD, OFFERS, TOPICS, Topic
from robocomp_dsl.hardware.mujoco.scene_devices import SINGLE
from robocomp_dsl.hardware.servants import SERVANTS
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.types import Declaration
from robocomp_dsl.resources import INTERFACES

OFFERED = sorted({one.interface for one in OFFERS} | set(OF_THE_WORLD))


def declared(name: str, file: str = "") -> Interface:
    modules = check_idsl(Path(INTERFACES) / f"{file or name}.idsl", Workspace(environ={}), Report())
    assert modules is not None
    return next(i for module in modules for i in module.interfaces if i.name == name)


def test_every_kind_that_is_offered_is_simulated() -> None:
    kinds = {one.kind for one in OFFERS} - {"joint", "prismaticjoint", "skin"}
    assert kinds == set(SINGLE)


@pytest.mark.parametrize("name", OFFERED)
def test_a_servant_has_every_operation_with_its_parameters(name: str) -> None:
    interface = declared(name)
    servant = SERVANTS[interface.qualified]
    for operation in interface.operations:
        given = list(inspect.signature(getattr(servant, operation.name)).parameters)[1:]
        assert len(given) == len(operation.inputs), operation.name


def test_no_servant_is_left_over() -> None:
    assert {declared(name).qualified for name in OFFERED} == set(SERVANTS)


@pytest.mark.parametrize(
    "topic", [one for one in TOPICS if not one.news], ids=lambda one: one.published
)
def test_a_topic_carries_what_its_port_answers(topic: Topic) -> None:
    asked = next(o for o in declared(topic.interface).operations if o.name == topic.asked)
    to = declared(topic.published, topic.file)
    told = next(o for o in to.operations if o.name == topic.operation)
    results = [asked.result] if asked.result else [one.type for one in asked.outputs]
    assert [named(one.type) for one in told.inputs] == [named(one) for one in results]


@pytest.mark.parametrize(
    "topic", [one for one in TOPICS if one.news], ids=lambda one: one.published
)
def test_a_topic_of_news_is_published_and_has_a_servant_that_tells_them(topic: Topic) -> None:
    to = declared(topic.published, topic.file)
    assert topic.operation in {one.name for one in to.operations}
    assert callable(SERVANTS[declared(topic.interface).qualified].news)  # type: ignore[attr-defined]


def named(type_: object) -> tuple[str, str]:
    """A type by its module and name: both sides have read it for themselves."""
    assert isinstance(type_, Declaration)
    return type_.module, type_.name
