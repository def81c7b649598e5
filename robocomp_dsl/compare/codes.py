"""The kinds of change, by whom they break."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

WIRE = Code(
    "RC641",
    Severity.ERROR,
    "a change breaks peers on the wire",
    """A component generated from the new version cannot talk to one generated from the old one: an
operation, a type or a pattern differs, or one side is gone. Calls fail with `InterfaceMismatch` or
`NoServer`, never with wrong data.

Generate all components that use the interface again and deploy them together. To change an
interface while others still run, give the new one another name and serve both for a while.""",
)

SOURCE = Code(
    "RC642",
    Severity.ERROR,
    "a change breaks code of users",
    """What goes over the wire is readable, but code that was written against the old version names
something that has another name now. `rcgen component` lists the places in a component.""",
)

CONFIGURATION = Code(
    "RC643",
    Severity.ERROR,
    "a change breaks configuration files",
    """A configuration that the old version accepts is refused by the new one: a parameter is gone,
takes other values, or must be given now. Give a new parameter a default, and widen ranges rather
than narrow them; a configuration in use elsewhere must be changed before the component is.""",
)

BEHAVIOUR = Code(
    "RC644",
    Severity.WARNING,
    "a change gives the same bytes another meaning",
    """Everything still loads and connects, but a unit, a default or another property differs: a
value that was meant in mm may now be read in m. No tool sees that at run
time, so it is said here.""",
)

WIRING = Code(
    "RC645",
    Severity.ERROR,
    "a change breaks the wiring of a deployment",
    """A deployment that was right with the components as they were is wrong with those of now: it
connects a port that is gone or has another interface, or a component requires what nobody in it
implements, or hears what nobody publishes any more. What is told is what `rcgen check` says of the
deployment; nothing is told of one that was changed along with its components.

Bring the deployment up to date, or give the component its port back.""",
)

VALUES = Code(
    "RC646",
    Severity.ERROR,
    "a change breaks parameter values of a deployment",
    """A deployment, or a configuration that its components read, gives parameters values that were
right and are not any more: the parameter is gone, is of another type, does not take the value, or
must be given now. The component would refuse to start.

Change the value, or widen the range of the parameter.""",
)
