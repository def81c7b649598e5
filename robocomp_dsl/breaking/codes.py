"""The kinds of breaking changes."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

WIRE = Code(
    "RC641",
    Severity.ERROR,
    "a change breaks communication with peers",
    """A component generated from the new version cannot talk to one generated from the old one: an
operation, a type or a pattern differs, or one side was removed. Calls fail with `InterfaceMismatch`
or `NoServer`, never with wrong data.

Generate all components that use the interface again and deploy them together. To change an
interface while old components still run, give the new interface another name and serve both.""",
)

SOURCE = Code(
    "RC642",
    Severity.ERROR,
    "a change breaks user code",
    """Messages stay compatible, but code that was written for the old version uses a name that has
changed. `rcgen component` lists these places in a component.""",
)

CONFIGURATION = Code(
    "RC643",
    Severity.ERROR,
    "a change breaks configuration files",
    """The new version rejects a configuration that the old one accepts: a parameter was removed,
accepts other values, or is now required. Give a new parameter a default, and widen ranges rather
than narrow them; update existing configurations before you deploy the component.""",
)

BEHAVIOUR = Code(
    "RC644",
    Severity.WARNING,
    "a change gives the same data another meaning",
    """Everything still loads and connects, but a unit, a default or another property differs: a
value in mm may now be interpreted in m. This cannot be detected at run time, so it is reported
here.""",
)

WIRING = Code(
    "RC645",
    Severity.ERROR,
    "a change breaks a connection of a deployment",
    """A deployment that was valid with the old components is invalid with the new ones: it connects
a port that was removed or has another interface, a required interface has no server, or a
subscribed topic has no publisher any more. The message is that of `rcgen check`. A deployment that
was updated together with its components is not reported.

Update the deployment, or restore the port of the component.""",
)

VALUES = Code(
    "RC646",
    Severity.ERROR,
    "a change breaks parameter values of a deployment",
    """A deployment, or a configuration file of its components, has parameter values that the new
version rejects: the parameter was removed, has another type, does not accept the value, or is now
required. The component would not start.

Change the value, or widen the range of the parameter.""",
)
