"""The tree of an SMDSL file: one machine and the states inside its states."""

from __future__ import annotations

from robocomp_dsl.syntax.ast_base import Duration, Name, Node


class Edge(Node):
    """`a => b, c;`, `a => b on found;`, `a => b after 2 s;`.

    Without `on` an edge is fired by the event `<source>_to_<target>`; one with `after` and no event
    is fired by time alone.
    """

    source: Name
    targets: tuple[Name, ...]
    event: Name | None = None
    after: Duration | None = None
    doc: str = ""


class Block(Node):
    """States that belong together; `name` is the machine's, or that of the state they are inside.

    Initial and end state are not repeated in `states`. `docs` maps states to their doc comments.
    """

    name: Name
    states: tuple[Name, ...] = ()
    initial: Name | None = None
    end: Name | None = None
    edges: tuple[Edge, ...] = ()
    doc: str = ""
    docs: tuple[tuple[str, str], ...] = ()

    @property
    def all_states(self) -> tuple[Name, ...]:
        """Initial, other and end states, in that order."""
        first = (self.initial,) if self.initial else ()
        last = (self.end,) if self.end else ()
        return (*first, *self.states, *last)


class Machine(Block):
    """`name { … };`: the outermost states."""


class Substates(Block):
    """`:parent { … };` or `:parent parallel { … };`, where all states are active at once."""

    parallel: bool = False


class File(Node):
    """One SMDSL file; `machine` is None when there is none to be seen.

    `complete` is False when form errors were reported, so that something may be missing here.
    """

    machine: Machine | None
    substates: tuple[Substates, ...] = ()
    complete: bool = True
