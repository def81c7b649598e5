"""The tree of an IDSL file: modules with their types, exceptions and interfaces.

Definitions of ROS (`.msg`, `.srv`, `.action`) and YARP (`.thrift`, `.bottle`) have the same tree.
Only those of ROS have bounded strings, only those of Thrift other names of types and interfaces
that extend another one; both have constants.
"""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.syntax.ast.base import Import, Literal, Name, Node, Number, QualifiedName, Unit


class Array(Node):
    """`[36]` behind the name of a field; `[36]`, `[<=3]` or `[]` behind a type of ROS.

    0: no limit.
    """

    size: int = 0
    bound: int = 0


class Field(Node):
    """A field of a struct or exception: `float x = 0 [mm];`.

    `string_bound` is the 10 of ROS's `string<=10`; `items` is a default in brackets.
    """

    type: QualifiedName
    name: Name
    default: Literal | None = None
    unit: Unit | None = None
    doc: str = ""
    array: Array | None = None
    string_bound: int = 0
    items: tuple[Literal, ...] = ()


class Constant(Node):
    """`uint8 ERROR=2` in a ROS definition."""

    type: QualifiedName
    name: Name
    value: Literal
    doc: str = ""


class Struct(Node):
    """`struct Name { fields };`. `ros_name` is `sensor_msgs/msg/Image` in a ROS definition."""

    name: Name
    fields: tuple[Field, ...]
    doc: str = ""
    constants: tuple[Constant, ...] = ()
    ros_name: str = ""


class ExceptionDecl(Node):
    """`exception Name { fields };`."""

    name: Name
    fields: tuple[Field, ...]
    doc: str = ""


class Enumerator(Node):
    """One name of an enumeration with its optional value."""

    name: Name
    value: Number | None = None
    doc: str = ""


class Enum(Node):
    """`enum Name { A, B = 2 };`."""

    name: Name
    enumerators: tuple[Enumerator, ...]
    doc: str = ""


class Sequence(Node):
    """`sequence<element> Name;`, `sequence<element, bound> Name;`; `bound` is 0 without one.

    `is_implicit`: it stands for Thrift's `list<element>`, which has no name in its file.
    """

    name: Name
    element: QualifiedName
    doc: str = ""
    is_implicit: bool = False
    bound: int = 0


class Dictionary(Node):
    """`dictionary<key, value> Name;`; `is_implicit` as for a sequence: `map<key, value>`."""

    name: Name
    key: QualifiedName
    value: QualifiedName
    doc: str = ""
    is_implicit: bool = False


class Alias(Node):
    """`typedef i32 Port` in a Thrift definition: another name of a type."""

    name: Name
    target: QualifiedName
    doc: str = ""


class Param(Node):
    """A parameter of an operation.

    A parameter without a name (legacy syntax) is called `arg1`, `arg2`, … by its position; the span
    of its name is that of the type. Only arguments of a Thrift service have defaults.
    """

    type: QualifiedName
    name: Name
    out: bool = False
    unit: Unit | None = None
    default: Literal | None = None


class Operation(Node):
    """`[query] idempotent float distance(int sensor, out State state) throws Failed;`.

    `pattern` is the optional keyword in brackets (`command`, `query` or `publish`); `result` is
    None for `void`.
    """

    name: Name
    result: QualifiedName | None
    params: tuple[Param, ...] = ()
    throws: tuple[QualifiedName, ...] = ()
    idempotent: bool = False
    pattern: Name | None = None
    doc: str = ""


class Interface(Node):
    """`interface Name { operations };`; `base` is the A of Thrift's `service B extends A`."""

    name: Name
    operations: tuple[Operation, ...]
    doc: str = ""
    base: QualifiedName | None = None


Declaration: TypeAlias = Struct | ExceptionDecl | Enum | Sequence | Dictionary | Alias | Interface


class Module(Node):
    """`module Name { declarations };`.

    `origin` is the language of an imported definition, "ros", "thrift" or "bottle", else ""; these
    have the built-in types of ROS.
    """

    name: Name
    declarations: tuple[Declaration, ...]
    doc: str = ""
    origin: str = ""


class File(Node):
    """One IDSL file. There may be no module (an empty file) or several (legacy).

    `complete` is False if syntax errors were reported, so parts may be missing.
    """

    imports: tuple[Import, ...]
    modules: tuple[Module, ...]
    complete: bool = True
