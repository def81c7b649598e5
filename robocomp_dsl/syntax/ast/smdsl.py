"""The tree of an SMDSL file: one machine and its substates."""

from __future__ import annotations

from robocomp_dsl.syntax.ast.base import Duration, Name, Node


class Edge(Node):
    """`a => b, c;`, `a => b on found;`, `a => b after 2 s;`.

    Without `on` an edge is triggered by the event `<source>_to_<target>`; with `after` and no event
    it is triggered by time only.
    """

    source: Name
    targets: tuple[Name, ...]
    event: Name | None = None
    after: Duration | None = None
    doc: str = ""


class Block(Node):
    """A block of states; `name` is the name of the machine or of the parent state.

    Initial and end state are not repeated in `states`. `state_docs` maps states to doc comments.
    """

    name: Name
    states: tuple[Name, ...] = ()
    initial: Name | None = None
    end: Name | None = None
    edges: tuple[Edge, ...] = ()
    doc: str = ""
    state_docs: tuple[tuple[str, str], ...] = ()

    @property
    def all_states(self) -> tuple[Name, ...]:
        """Initial, other and end states, in that order."""
        first = (self.initial,) if self.initial else ()
        last = (self.end,) if self.end else ()
        return (*first, *self.states, *last)


class Machine(Block):
    """`name { … };`: the top-level states."""


class Substates(Block):
    """`:parent { … };` or `:parent parallel { … };`, where all states are active simultaneously."""

    parallel: bool = False


class File(Node):
    """One SMDSL file; `machine` is None if the file has none.

    `complete` is False if syntax errors were reported, so parts may be missing.
    """

    machine: Machine | None
    substates: tuple[Substates, ...] = ()
    complete: bool = True
