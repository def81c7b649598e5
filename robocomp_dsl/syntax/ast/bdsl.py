"""The tree of a BDSL file: a bridge with its inputs, hubs, outputs and services."""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.syntax.ast.base import (
    Duration,
    Import,
    Name,
    Node,
    Number,
    QualifiedName,
    Text,
    Unit,
)
from robocomp_dsl.syntax.ast.ddsl import Qos


class NumberValue(Node):
    """`90 [deg]`."""

    value: int | float
    unit: Unit | None = None


class TextValue(Node):
    """`"rover_base"`, without quotes and escapes."""

    value: str


class BoolValue(Node):
    """`true` or `false`."""

    value: bool


class ListValue(Node):
    """`{ a, b }`."""

    items: tuple[Expression, ...]


class Reference(Node):
    """`wheels`, `now`, `counter` or `request`."""

    name: Name


class Member(Node):
    """`imu.angular_velocity`."""

    value: Expression
    name: Name


class Selection(Node):
    """`wheels[0]`, `wheels[2,0,1]` or `wheels[0:3]`.

    One index selects an item, several a list. `bounds` is set for `[start:stop]`, each None if it
    is not written; `indices` is empty then.
    """

    value: Expression
    indices: tuple[int, ...]
    bounds: tuple[int | None, int | None] | None = None


class FunctionCall(Node):
    """`mirror(wheels)`; the name may be that of a built-in function."""

    name: Name
    arguments: tuple[Expression, ...]


class Operation(Node):
    """`a * b`; the operator is `+`, `-`, `*` or `/`."""

    operator: str
    left: Expression
    right: Expression


class Negation(Node):
    """`-a`."""

    value: Expression


class Conversion(Node):
    """`wheels to [rad]`."""

    value: Expression
    unit: Unit


Expression: TypeAlias = (
    NumberValue
    | TextValue
    | BoolValue
    | ListValue
    | Reference
    | Member
    | Selection
    | FunctionCall
    | Operation
    | Negation
    | Conversion
)


class ShapeField(Node):
    """`double x [m]`: a field of an inline type or a parameter; the unit is that of the type."""

    type: TypeRef
    name: Name


class TypeRef(Node):
    """`double[3] [mm]`, `sensor_msgs::Imu`, `Module::Interface.operation` or `(double x, int y)`.

    Exactly one of `name` and `shape` is set. `lengths` has one item for each pair of brackets, the
    outermost list last; None for `[]`.
    """

    name: QualifiedName | None = None
    operation: Name | None = None
    shape: tuple[ShapeField, ...] | None = None
    lengths: tuple[Number | None, ...] = ()
    unit: Unit | None = None


class Place(Node):
    """`over ros2 at "/imu"`; `span` is empty if neither is written."""

    middleware: Name | None = None
    address: Text | None = None


class PathPart(Node):
    """`points[0]`."""

    name: Name
    index: Number | None = None


class Path(Node):
    """`header.stamp`: a field of a message."""

    parts: tuple[PathPart, ...]

    @property
    def text(self) -> str:
        """As users write it, without blanks."""
        return ".".join(
            f"{part.name.text}[{part.index.value}]" if part.index else part.name.text
            for part in self.parts
        )


class Rate(Node):
    """`50 Hz`."""

    hertz: float


class Input(Node):
    """`input imu : sensor_msgs::Imu over ros2 at "/imu" { best_effort; stamp header.stamp; };`."""

    name: Name
    type: TypeRef
    place: Place
    qos: Qos | None = None
    stamp: Path | None = None
    doc: str = ""


class Function(Node):
    """`function mirror(double[] values [rad]) -> double[] [rad];`."""

    name: Name
    parameters: tuple[ShapeField, ...]
    result: TypeRef
    doc: str = ""


class Hub(Node):
    """`hub pair = left, imu.z { policy synchronised within 20 ms; max_age 500 ms; length 2; };`.

    `policy.text` is `latest`, `all`, `synchronised` or `synchronized` in any case.
    """

    name: Name
    values: tuple[Expression, ...]
    policy: Name | None = None
    tolerance: Duration | None = None
    max_age: Duration | None = None
    length: Number | None = None
    doc: str = ""


class Assignment(Node):
    """`header.stamp = now;`."""

    path: Path
    value: Expression


class Item(Node):
    """`item target.finger;`: the next item of a message without a type."""

    value: Expression


class Output(Node):
    """`output states : sensor_msgs::JointState over ros1 at "/states" = value { … };`."""

    name: Name
    type: TypeRef | None
    place: Place
    value: Expression | None = None
    rate: Rate | None = None
    qos: Qos | None = None
    fields: tuple[Assignment | Item, ...] = ()
    doc: str = ""


class Call(Node):
    """`call motors : Motors.setPower over ice at "motors" { on = request.data; };`."""

    name: Name
    type: TypeRef
    place: Place
    fields: tuple[Assignment, ...] = ()


class Service(Node):
    """`service enable : std_srvs::SetBool over ros1 at "/enable" { … };`."""

    name: Name
    type: TypeRef
    place: Place
    calls: tuple[Call, ...] = ()
    fields: tuple[Assignment, ...] = ()
    doc: str = ""


class Command(Node):
    """`command close : (string verb) over yarp at "/hand:i" on cancel { verb = "stop"; };`."""

    name: Name
    type: TypeRef | None
    place: Place
    is_on_cancel: bool = False
    fields: tuple[Assignment | Item, ...] = ()


class Comparison(Node):
    """`hand.width < 0.02 [m]`; without an operator the value `left`, a bool.

    The operator is `==`, `!=`, `<`, `<=`, `>` or `>=`.
    """

    left: Expression
    operator: Name | None = None
    right: Expression | None = None


class Condition(Node):
    """`moving == false and width < 0.02 [m]`: all comparisons hold."""

    comparisons: tuple[Comparison, ...]


class Action(Node):
    """`action grasp : my_msgs::Grasp over ros1 at "/grasp" { … };`.

    The paths of `fields` begin with `feedback` or `result`. One of the conditions in `succeed` or
    `abort` ends the goal.
    """

    name: Name
    type: TypeRef
    place: Place
    commands: tuple[Command, ...] = ()
    states: tuple[Input, ...] = ()
    fields: tuple[Assignment, ...] = ()
    succeed: tuple[Condition, ...] = ()
    abort: tuple[Condition, ...] = ()
    timeout: Duration | None = None
    doc: str = ""


class Bridge(Node):
    """`Bridge name { … };`."""

    name: Name
    middleware: Name | None = None
    rate: Rate | None = None
    inputs: tuple[Input, ...] = ()
    functions: tuple[Function, ...] = ()
    hubs: tuple[Hub, ...] = ()
    outputs: tuple[Output, ...] = ()
    services: tuple[Service, ...] = ()
    actions: tuple[Action, ...] = ()
    doc: str = ""


class File(Node):
    """One BDSL file; `bridge` is None if the file has none.

    `complete` is False if syntax errors were reported, so parts may be missing.
    """

    imports: tuple[Import, ...]
    bridge: Bridge | None
    complete: bool = True
