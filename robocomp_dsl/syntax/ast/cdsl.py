"""The tree of a CDSL file: one component with its ports and settings."""

from __future__ import annotations

from typing import Literal, TypeAlias

from robocomp_dsl.syntax.ast.base import Duration, Import, Name, Node, Number, QualifiedName, Text

Role: TypeAlias = Literal["implements", "requires", "subscribesTo", "publishes"]


class Port(Node):
    """One interface of a list: `requires Laser(ice) as front optional` gives a port.

    `role` is spelled as in `Role` whatever case the user wrote; `middlewares` are in order of
    preference; `optional` is the keyword, if present.
    """

    role: Role
    interface: QualifiedName
    alias: Name | None = None
    middlewares: tuple[Name, ...] = ()
    optional: Name | None = None


class Gui(Node):
    """`gui Qt(QWidget);`; the legacy `gui QWidget;` has no toolkit."""

    widget: Name
    toolkit: Name | None = None


class StateMachine(Node):
    """`statemachine "path";`, optionally with `visual`."""

    path: Text
    visual: bool = False


class Component(Node):
    """`Component Name { … };`; settings that were not written are None.

    `parameters` is the path of the PDSL file; `period` in ms. If a setting is repeated, the first
    one is stored (the second was reported).
    """

    name: Name
    ports: tuple[Port, ...]
    language: Name | None = None
    gui: Gui | None = None
    options: tuple[Name, ...] = ()
    statemachine: StateMachine | None = None
    parameters: Text | None = None
    period: Number | None = None
    threads: Number | None = None
    watchdog: Duration | None = None
    middleware: Name | None = None
    doc: str = ""


class File(Node):
    """One CDSL file; `component` is None if the file has none.

    `complete` is False if syntax errors were reported, so parts may be missing.
    """

    imports: tuple[Import, ...]
    component: Component | None
    complete: bool = True
