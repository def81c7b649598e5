"""RC7xx: state machines."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_STATE = Code(
    "RC701",
    Severity.ERROR,
    "unknown state",
    """\
The source of a transition is a state of its block; the target is a state of the same block or of an
enclosing one. `:name { … };` contains the substates of the state `name`.

Wrong:

    game
    {
        initial_state waiting;
        states playing;
        transitions { waiting => plying; };
    };

Right:

    game
    {
        initial_state waiting;
        states playing;
        transitions { waiting => playing; };
    };
""",
)

NO_INITIAL_STATE = Code(
    "RC702",
    Severity.ERROR,
    "no initial state",
    """\
A machine and every block of substates need an initial state. Parallel substates have none: all of
them are active simultaneously.

Wrong:

    game
    {
        states waiting, playing;
        transitions { waiting => playing; };
    };

Right:

    game
    {
        initial_state waiting;
        states playing;
        transitions { waiting => playing; };
    };
""",
)

PARALLEL_INITIAL_OR_FINAL = Code(
    "RC703",
    Severity.ERROR,
    "a parallel block has no initial and no end state",
    """\
All states of a parallel block are active simultaneously while its parent state is active.

Wrong:

    :playing parallel { initial_state music; states lights; };

Right:

    :playing parallel { states music, lights; };
""",
)

UNREACHABLE_STATE = Code(
    "RC704",
    Severity.WARNING,
    "unreachable state",
    """\
No sequence of transitions leads from the initial state to this state, so it is never entered.

Wrong:

    game
    {
        initial_state waiting;
        states playing, paused;
        transitions { waiting => playing; };
    };

Right:

    game
    {
        initial_state waiting;
        states playing, paused;
        transitions
        {
            waiting => playing;
            playing => paused;
        };
    };
""",
)

FINAL_STATE_LEFT = Code(
    "RC705",
    Severity.ERROR,
    "an end state has an outgoing transition",
    """\
A machine terminates in its end state. A state with outgoing transitions is an ordinary state.

Wrong:

    game
    {
        initial_state waiting;
        end_state over;
        transitions
        {
            waiting => over;
            over => waiting;
        };
    };

Right:

    game
    {
        initial_state waiting;
        states over;
        transitions
        {
            waiting => over;
            over => waiting;
        };
    };
""",
)

DUPLICATE_TRANSITION = Code(
    "RC706",
    Severity.WARNING,
    "duplicate transition",
    """\
Two transitions from one state have the same event and condition; only the first one is ever taken.

Wrong:

    transitions
    {
        waiting => playing;
        waiting => playing;
    };

Right:

    transitions { waiting => playing; };
""",
)

SCXML_TAG = Code(
    "RC707",
    Severity.ERROR,
    "unknown or misplaced SCXML element or attribute",
    """\
An SCXML file consists of the elements and attributes of the W3C recommendation (State Chart XML,
2015). Unknown ones are ignored, so the machine may behave differently than intended.

Wrong:

    <scxml version="1.0"> <stat id="waiting"/> </scxml>

Right:

    <scxml version="1.0"> <state id="waiting"/> </scxml>
""",
)

SCXML_UNUSED = Code(
    "RC708",
    Severity.WARNING,
    "SCXML element without effect",
    """\
The element is valid or an extension, but components ignore it: they do not invoke other machines
and do not use the data of a final state.

Wrong:

    <state id="working"> <invoke type="scxml" src="other.scxml"/> </state>

Right:

    <state id="working"> <onentry> <send event="begin"/> </onentry> </state>
""",
)

STATES_TOO_DEEP = Code(
    "RC709",
    Severity.ERROR,
    "states are nested too deeply",
    """\
States nest at most 200 deep in SMDSL and SCXML; readable machines need fewer than ten levels. If
the file is generated, check that consecutive steps are states of one block with transitions between
them, and not nested in each other.
""",
)

SCXML_UNSAFE = Code(
    "RC710",
    Severity.ERROR,
    "a component cannot run this part of the SCXML file",
    """\
Components do not run code from SCXML files: no scripts, no files, no calls. Expressions use
Python's operators; conditions also support `&&`, `||`, `===`, `true` and `null` of ECMAScript. With
this element the component would fail at start or when it reaches the element.

Wrong:

    <transition event="go" cond="count++ &lt; limit()" target="done"/>

Right:

    <transition event="go" cond="count &lt; 3" target="done"/>

What needs more is a method of the worker: `on_enter_<state>` calls `self.machine.send("done")`.
""",
)

EVENTLESS_CYCLE = Code(
    "RC711",
    Severity.ERROR,
    "endless loop of transitions without events",
    """\
A transition without an event is taken as soon as its source is active. A cycle of such transitions
without conditions never ends: the component would hang when it reaches one of these states. At run
time, more than 1000 transitions without an event are an error, too.

Wrong:

    <state id="ask"> <transition target="wait"/> </state>
    <state id="wait"> <transition target="ask"/> </state>

Right:

    <state id="ask"> <transition target="wait"/> </state>
    <state id="wait"> <transition event="timeout" target="ask"/> </state>
""",
)
