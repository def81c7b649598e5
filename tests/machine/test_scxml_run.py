"""SCXML documents in the library's safe mode: what the standard shows, and what is refused.

The documents follow the examples and assertions of the W3C recommendation "State Chart XML",
1 September 2015; each is written anew for the part of it that it shows.
"""

from __future__ import annotations

from typing import NamedTuple

import pytest

from robocomp_dsl.runtime.machine import Machine, MachineSpec, StateSpec
from robocomp_dsl.runtime.machine.machine import EndlessTransitions
from tests.machine.machine_samples import ManualClock, Worker

OPEN = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript"'


class Case(NamedTuple):
    """A document, what happens (an event, or `+s` for time that goes by), where it leads."""

    body: str
    states: str
    events: str
    ways: list[tuple[str, str]]


CASES = {
    "3.2 the first state of the document": Case(
        ">{0}<state id='a'/><state id='b'/>", "a b", "", [("", "a")]
    ),
    "3.2 a first state that is named": Case(
        " initial='b'><state id='a'/><state id='b'/>", "a b", "", [("", "b")]
    ),
    "3.3 states within a state": Case(
        "><state id='a' initial='c'><state id='b'/><state id='c'/></state>",
        "a b c",
        "",
        [("", "a c")],
    ),
    "3.4 parallel states are active together": Case(
        "><parallel id='p'><state id='a'><transition event='e' target='z'/></state>"
        "<state id='b'/></parallel><state id='z'/>",
        "p a b z",
        "e",
        [("", "p a b"), ("e", "z")],
    ),
    "3.5 the first transition in document order": Case(
        "><state id='a'><transition event='e' target='b'/><transition event='e' target='c'/>"
        "</state><state id='b'/><state id='c'/>",
        "a b c",
        "e",
        [("e", "b")],
    ),
    "3.7 done.state of a compound state": Case(
        "><state id='a'><transition event='done.state.a' target='z'/>"
        "<state id='b'><transition event='e' target='c'/></state><final id='c'/></state>"
        "<state id='z'/>",
        "a b c z",
        "e",
        [("", "a b"), ("e", "z")],
    ),
    "3.10 history": Case(
        " initial='a'><state id='a' initial='b'><history id='h'><transition target='b'/></history>"
        "<state id='b'><transition event='next' target='c'/></state><state id='c'/>"
        "<transition event='out' target='z'/></state>"
        "<state id='z'><transition event='back' target='h'/></state>",
        "a b c z",
        "next out back",
        [("next", "a c"), ("out", "z"), ("back", "a c")],
    ),
    "3.12.1 prefixes of events": Case(
        "><state id='a'><transition event='error' target='b'/></state><state id='b'>"
        "<transition event='x.*' target='a'/></state>",
        "a b",
        "error x.*",
        [("error.send", "b"), ("x.y", "a")],
    ),
    "3.13 transitions without an event": Case(
        "><state id='a'><transition event='e' target='b'/></state>"
        "<state id='b'><transition target='c'/></state><state id='c'/>",
        "a b c",
        "e",
        [("e", "c")],
    ),
    "4.2 raise, before other events": Case(
        "><state id='a'><transition event='e' target='b'/></state>"
        "<state id='b'><onentry><raise event='f'/></onentry>"
        "<transition event='f' target='c'/></state><state id='c'/>",
        "a b c",
        "e f",
        [("e", "c")],
    ),
    "4.3 if, elseif, else": Case(
        "><datamodel><data id='n' expr='2'/><data id='r' expr='0'/></datamodel>"
        "<state id='a'><onentry><if cond='n == 1'><assign location='r' expr='1'/>"
        "<elseif cond='n == 2'/><assign location='r' expr='2'/><else/>"
        "<assign location='r' expr='3'/></if></onentry>"
        "<transition event='e' cond='r == 2' target='b'/></state><state id='b'/>",
        "a b",
        "e",
        [("e", "b")],
    ),
    "5.3 data and conditions": Case(
        "><datamodel><data id='n' expr='0'/></datamodel><state id='a'>"
        "<transition event='e' cond='n &lt; 2'><assign location='n' expr='n + 1'/></transition>"
        "<transition event='e' target='b'/></state><state id='b'/>",
        "a b",
        "e",
        [("e", "a"), ("e", "a"), ("e", "b")],
    ),
    "6.2 send with a delay": Case(
        "><state id='a'><onentry><send event='t' delay='2s'/></onentry>"
        "<transition event='t' target='b'/></state><state id='b'/>",
        "a b",
        "t",
        [("", "a"), ("+1.9", "a"), ("+0.1", "b")],
    ),
    "6.3 cancel": Case(
        "><state id='a'><onentry><send id='s' event='t' delay='2s'/></onentry>"
        "<transition event='stop'><cancel sendid='s'/></transition>"
        "<transition event='t' target='b'/></state><state id='b'/>",
        "a b",
        "stop t",
        [("stop", "a"), ("+5", "a")],
    ),
    "the microwave of appendix G": Case(
        " initial='off'><datamodel><data id='cook' expr='2'/><data id='closed' expr='True'/>"
        "<data id='timer' expr='0'/></datamodel>"
        "<state id='off'><transition event='turn.on' target='on'/></state>"
        "<state id='on'><initial><transition target='idle'/></initial>"
        "<transition event='turn.off' target='off'/>"
        "<transition cond='timer >= cook' target='off'/>"
        "<state id='idle'><transition cond='closed' target='cooking'/>"
        "<transition event='door.close' target='cooking'>"
        "<assign location='closed' expr='True'/></transition></state>"
        "<state id='cooking'><transition event='door.open' target='idle'>"
        "<assign location='closed' expr='False'/></transition>"
        "<transition event='time'><assign location='timer' expr='timer + 1'/></transition>"
        "</state></state>",
        "off on idle cooking",
        "turn.on turn.off door.open door.close time",
        [
            ("", "off"),
            ("turn.on", "on cooking"),
            ("door.open", "on idle"),
            ("time", "on idle"),
            ("door.close", "on cooking"),
            ("time", "on cooking"),
            ("time", "off"),
        ],
    ),
}


def spec(body: str, states: str, events: str) -> MachineSpec:
    document = f"{OPEN}{body.replace('{0}', '')}</scxml>"
    return MachineSpec(
        "doc", tuple(map(StateSpec, states.split())), (), tuple(events.split()), document
    )


@pytest.mark.parametrize("name", CASES)
def test_scxml_document_runs_as_specified(name: str) -> None:
    case = CASES[name]
    clock = ManualClock()
    machine = Machine(spec(case.body, case.states, case.events), Worker(), clock, lambda: None)
    machine.start()
    for event, leads in case.ways:
        if event.startswith("+"):
            clock.moment += float(event)
            machine.fire_due()
        elif event:
            machine.send(event)
        assert machine.states == tuple(leads.split()), f"behind {event or 'the start'}"


REFUSED = {
    "a script": "><script>open('x')</script><state id='a'/>",
    "code in an expression": "><datamodel><data id='n' expr='().__class__'/></datamodel>"
    "<state id='a'/>",
    "a file": "><datamodel><data id='n' src='file:///etc/passwd'/></datamodel><state id='a'/>",
}


@pytest.mark.parametrize("name", REFUSED)
def test_scxml_executes_no_code_of_document(name: str) -> None:
    machine = Machine(spec(REFUSED[name], "a", ""), Worker(), ManualClock(), lambda: None)
    with pytest.raises(Exception, match=r".") as failed:
        machine.start()
    assert not isinstance(failed.value, AssertionError)


ENDLESS = {
    "states": "<state id='b'><transition target='c'/></state>"
    "<state id='c'><transition target='b'/></state>",
    "actions": "<state id='b'><transition cond='1 &lt; 2'><raise event='x'/></transition></state>",
    "raised events": "<state id='b'><onentry><raise event='x'/></onentry>"
    "<transition event='x' target='b'/></state>",
}


@pytest.mark.parametrize("name", ENDLESS)
def test_machine_ends_endless_loop_of_transitions(name: str) -> None:
    body = f"><state id='a'><transition event='e' target='b'/></state>{ENDLESS[name]}"
    machine = Machine(spec(body, "a b c", "e x"), Worker(), ManualClock(), lambda: None)
    machine.start()
    with pytest.raises(EndlessTransitions, match=r"more than 1000 transitions, last from `[bc]`"):
        machine.send("e")
