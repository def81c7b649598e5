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
