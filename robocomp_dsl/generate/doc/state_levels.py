"""Lay out the nested boxes of a state diagram.

In: a state machine. Out: `Level`s within levels. Each is a graph of its own. A transition that
leaves or enters a box has a point on the border: one part inside, one part outside. The side
of the box follows from the ranks outside, which need no sizes. So ranks are computed from the
outermost box inwards, sizes and positions on the way back.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.generate.doc.drawing import LINE_HEIGHT, text_width
from robocomp_dsl.generate.doc.graph import label_size
from robocomp_dsl.generate.doc.layered import layout as layered
from robocomp_dsl.generate.doc.state_words import StatePair, state_label, transition_labels
from robocomp_dsl.model.statemachine import State, StateMachine

MIN_STATE_WIDTH = 72.0
INITIAL_DOT_SIZE = 12.0
INSET = 18.0
HEADER_HEIGHT = LINE_HEIGHT + 10.0
"""Height of the header of a composite state."""


@dataclass(frozen=True, slots=True)
class Crossing:
    """A line through the border of a box; `inside` is the state in it that is or contains its end.

    `out` is its direction, `right` the side of the box; `ends`: it ends at the border.
    """

    pair: StatePair
    inside: str
    outgoing: bool
    right: bool
    ends_here: bool = False


@dataclass(frozen=True, slots=True)
class LevelEdge:
    """A line between two nodes of a level; `arrow`: it ends at its target."""

    source: int
    target: int
    pair: StatePair
    labels: tuple[str, ...] = ()
    arrow: bool = True


@dataclass(slots=True)
class Level:
    """The contents of one box. Its nodes: states, crossings, and the initial dot, if any.

    `width` and `height` are those of the whole box; `left` and `top` of its contents in it.
    """

    states: tuple[State, ...]
    crossings: list[Crossing]
    edges: list[LevelEdge]
    nodes: list[layered.LayoutNode] = field(default_factory=list)
    sublevels: dict[int, Level] = field(default_factory=dict)
    layout: layered.GraphLayout = field(default_factory=lambda: layered.layout((), ()))
    width: float = 0.0
    height: float = 0.0
    left: float = 0.0
    top: float = 0.0

    def crossing_offset(self, pair: StatePair) -> float | None:
        """Distance from the top of the box to where a line crosses its border; None without one."""
        for i, crossing in enumerate(self.crossings, len(self.states)):
            if crossing.pair == pair:
                return self.top + self.layout.nodes[i][1]
        return None


@dataclass(frozen=True, slots=True)
class LevelBuilder:
    """Lays out the boxes of a machine. `parents` has the box of each state, "" is the outermost."""

    parents: Mapping[str, str]
    labels: Mapping[StatePair, tuple[str, ...]]

    def level(self, name: str, states: tuple[State, ...], passing: Sequence[Crossing]) -> Level:
        """The box `name`, whose border the lines `passing` cross; its size is set later."""
        crossings = [*passing, *self._boundary_crossings(name)]
        level = Level(states, crossings, [])
        index = {state.name: i for i, state in enumerate(states)}
        level.edges = [
            *self._inner_edges(name, index),
            *_crossing_edges(crossings, index, self.labels),
        ]
        nodes = [_layout_node(state) for state in states]
        nodes += [
            layered.LayoutNode(0, 0, "last" if crossing.right else "first")
            for crossing in crossings
        ]
        begins = [i for i, state in enumerate(states) if state.initial and not state.history]
        if begins:
            level.edges += [LevelEdge(len(nodes), i, ("", states[i].name)) for i in begins]
            nodes.append(layered.LayoutNode(INITIAL_DOT_SIZE, INITIAL_DOT_SIZE))
        bare = [layered.LayoutEdge(edge.source, edge.target) for edge in level.edges]
        ranks = layered.assign_ranks(nodes, bare)
        level.nodes = layered.fit_ports(nodes, bare, ranks)
        for i, state in enumerate(states):
            if state.substates:
                inside = self._passing_crossings(i, state.name, level.edges, ranks)
                inner = _set_size(
                    self.level(state.name, state.substates, inside), state_label(state)
                )
                level.sublevels[i] = inner
                level.nodes[i] = layered.LayoutNode(inner.width, inner.height)
        level.layout = layered.layout(
            level.nodes, [_layout_edge(edge, level) for edge in level.edges], ranks
        )
        return level

    def _boundary_crossings(self, name: str) -> list[Crossing]:
        """Lines between this state and states inside it; they end at the border's inner side."""
        crossings = []
        for pair in self.labels:
            source, target = pair
            if target == name and source != name and name in self._ancestors(source):
                crossings.append(Crossing(pair, self._ancestor_in(source, name), True, True, True))
            elif source == name and target != name and name in self._ancestors(target):
                crossings.append(
                    Crossing(pair, self._ancestor_in(target, name), False, False, True)
                )
        return crossings

    def _inner_edges(self, name: str, index: Mapping[str, int]) -> list[LevelEdge]:
        """Lines between two states of this box, or between their contents."""
        edges = []
        for pair, labels in self.labels.items():
            source, target = (self._ancestor_in(state, name) for state in pair)
            if (
                source in index
                and target in index
                and (source != target or pair[0] == pair[1] == source)
            ):
                arrow = target == pair[1]
                edges.append(LevelEdge(index[source], index[target], pair, labels, arrow))
        return edges

    def _passing_crossings(
        self, node: int, name: str, edges: Sequence[LevelEdge], ranks: layered.Ranks
    ) -> list[Crossing]:
        """The lines that cross the border of a state in the level."""
        crossings = []
        for i, edge in enumerate(edges):
            if edge.source == edge.target:
                continue
            turned = i in ranks.reversed_edges
            if edge.source == node and edge.pair[0] not in ("", name):
                crossings.append(
                    Crossing(edge.pair, self._ancestor_in(edge.pair[0], name), True, not turned)
                )
            if edge.target == node and edge.pair[1] != name:
                crossings.append(
                    Crossing(edge.pair, self._ancestor_in(edge.pair[1], name), False, turned)
                )
        return crossings

    def _ancestors(self, state: str) -> list[str]:
        """The boxes that contain a state, the innermost first."""
        ancestors = []
        while state:
            state = self.parents.get(state, "")
            ancestors.append(state)
        return ancestors

    def _ancestor_in(self, state: str, box: str) -> str:
        """The state in `box` that is `state` or contains it; "" if there is none."""
        while state and self.parents.get(state, "") != box:
            state = self.parents.get(state, "")
        return state


def _crossing_edges(
    crossings: Sequence[Crossing],
    index: Mapping[str, int],
    lines: Mapping[StatePair, tuple[str, ...]],
) -> list[LevelEdge]:
    """The lines between the border and the contents; the label is at the innermost part.

    A line that continues outside has its label there.
    """
    edges = []
    for i, crossing in enumerate(crossings, len(index)):
        labels = lines[crossing.pair] if crossing.ends_here else ()
        inside = index[crossing.inside]
        if crossing.outgoing:
            edges.append(LevelEdge(inside, i, crossing.pair, labels, crossing.ends_here))
        else:
            edges.append(
                LevelEdge(i, inside, crossing.pair, labels, crossing.inside == crossing.pair[1])
            )
    return edges


def _layout_edge(edge: LevelEdge, level: Level) -> layered.LayoutEdge:
    source, target = level.sublevels.get(edge.source), level.sublevels.get(edge.target)
    leaves = source.crossing_offset(edge.pair) if source else None
    enters = target.crossing_offset(edge.pair) if target else None
    size = label_size([(label, None) for label in edge.labels])
    return layered.LayoutEdge(edge.source, edge.target, *size, leaves, enters)


def _layout_node(state: State) -> layered.LayoutNode:
    return layered.LayoutNode(
        max(MIN_STATE_WIDTH, text_width(state_label(state)) + 28), LINE_HEIGHT + 17
    )


def _set_size(level: Level, title: str = "") -> Level:
    """Set the size of a box with its header; the outermost box has no header and no border."""
    inner = level.layout
    room = INSET if title else 0.0
    level.width = max(inner.width, text_width(title)) + 2 * room
    level.left = (level.width - inner.width) / 2
    level.top = HEADER_HEIGHT + room * 0.8 if title else 0.0
    level.height = level.top + inner.height + room
    return level


def build_levels(machine: StateMachine) -> Level:
    """The outermost box of a machine, with all others in it."""
    home: dict[str, str] = {}
    todo = [("", child) for child in machine.states]
    while todo:
        box, state = todo.pop()
        home[state.name] = box
        todo += [(state.name, substate) for substate in state.substates]
    return _set_size(LevelBuilder(home, transition_labels(machine)).level("", machine.states, ()))
