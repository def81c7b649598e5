"""RC7xx: the states of a component."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_STATE = Code(
    "RC701",
    Severity.ERROR,
    "there is no such state",
    """\
A transition leads between states of its own block, or from there to a state of a block around it;
`:name { … };` stands for the states inside the state `name`.

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
    "nothing says which state comes first",
    """\
A machine begins in its initial state, and so do the states inside a state, unless they are
parallel: then all of them are active at once, and none is the first.

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

PARALLEL_ENDS = Code(
    "RC703",
    Severity.ERROR,
    "parallel states have no first and no last",
    """\
All states of a parallel block are active at once, from the moment its state is entered until it is
left.

Wrong:

    :playing parallel { initial_state music; states lights; };

Right:

    :playing parallel { states music, lights; };
""",
)

UNREACHABLE_STATE = Code(
    "RC704",
    Severity.WARNING,
    "no way leads to a state",
    """\
No transition leads to the state from the initial one, so it will never be entered.

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

END_WITH_WAY_OUT = Code(
    "RC705",
    Severity.ERROR,
    "an end state has a way out",
    """\
In its end state a machine has ended. A state that can be left is an ordinary one.

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

REPEATED_TRANSITION = Code(
    "RC706",
    Severity.WARNING,
    "a transition is written twice",
    """\
Two transitions from one state by the same event: only the first one will ever be taken.

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
    "this is not SCXML, or not here",
    """\
An SCXML file is made of the elements and attributes of the W3C recommendation (State Chart XML,
2015), each in its place. What is not known is left out, and what it would have meant is lost.

Wrong:

    <scxml version="1.0"> <stat id="waiting"/> </scxml>

Right:

    <scxml version="1.0"> <state id="waiting"/> </scxml>
""",
)

SCXML_UNUSED = Code(
    "RC708",
    Severity.WARNING,
    "a part of the SCXML file does nothing",
    """\
The element is understood, or an extension, but a component does nothing with it: it invokes no
other machines, and nobody waits for the data of an end state.

Wrong:

    <state id="working"> <invoke type="scxml" src="other.scxml"/> </state>

Right:

    <state id="working"> <onentry> <send event="begin"/> </onentry> </state>
""",
)

DEEP_STATES = Code(
    "RC709",
    Severity.ERROR,
    "states are nested too deeply",
    """\
States nest at most 200 deep, in SMDSL and in SCXML; no machine that anybody follows needs ten. A
generated file may have put the steps of one after the other into each other: steps that follow each
other are states of one block with transitions between them.
""",
)

SCXML_UNSAFE = Code(
    "RC710",
    Severity.ERROR,
    "a component cannot run this part of the SCXML file",
    """\
Components run SCXML without running code of the file: no scripts, no files, no calls. Expressions
compare and compute with Python's operators; `&&`, `||`, `===`, `true` and `null` of ECMAScript are
understood in conditions. The component would not start, or fail when it comes to this place.

Wrong:

    <transition event="go" cond="count++ &lt; limit()" target="done"/>

Right:

    <transition event="go" cond="count &lt; 3" target="done"/>

What needs more is a method of the worker: `on_enter_<state>` calls `self.machine.go("done")`.
""",
)
