"""Interfaces of IDSL, resolved."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path

from robocomp_dsl.model.types import Alias, Declaration, ExceptionType, Literal, Struct, Type
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span


class Pattern(StrEnum):
    """The communication pattern of an operation (paper "Progress in RoboComp", section V).

    `COMMAND`: one way, one to one. `QUERY`: request and reply. `PUBLISH`: one way, one to many.
    `UNMARKED` (a void operation without outputs or exceptions): publish where the interface is a
    topic, otherwise a query with an empty reply.
    """

    COMMAND = "command"
    QUERY = "query"
    PUBLISH = "publish"
    UNMARKED = "unmarked"


class Param(Record):
    """A parameter of an operation. Only arguments of a Thrift service have a `default`."""

    name: str
    type: Type
    span: Span
    unit: str = ""
    default: Literal | None = None


class Operation(Record):
    """An operation. `outputs` are its `out` parameters in order; `result` is None for void.

    `marked` says whether the pattern was written or inferred.
    """

    name: str
    span: Span
    pattern: Pattern
    inputs: tuple[Param, ...]
    outputs: tuple[Param, ...]
    result: Type | None
    throws: tuple[ExceptionType, ...]
    idempotent: bool
    marked: bool
    doc: str = ""

    @property
    def optional_inputs(self) -> tuple[Param, ...]:
        """The last inputs that all have a default: callers may leave them out."""
        count = 0
        while count < len(self.inputs) and self.inputs[-1 - count].default is not None:
            count += 1
        return self.inputs[len(self.inputs) - count :]

    @property
    def ros_service(self) -> str:
        """`std_srvs/srv/SetBool` if its input and result are those of one ROS service, or ""."""
        outputs = [*([self.result] if self.result else []), *(p.type for p in self.outputs)]
        types = [*(p.type for p in self.inputs), *outputs]
        names = [t.ros_name for t in types if isinstance(t, Struct)]
        if len(self.inputs) != 1 or len(types) != 2 or len(names) != 2 or self.throws:
            return ""
        name = names[0].removesuffix("_Request")
        is_service = "/srv/" in name and names == [f"{name}_Request", f"{name}_Response"]
        return name if is_service else ""

    @property
    def ros_topic(self) -> str:
        """`std_msgs/msg/String` if its only parameter is that ROS message, or ""."""
        if len(self.inputs) != 1 or self.result or self.outputs or self.throws:
            return ""
        type_ = self.inputs[0].type
        return type_.ros_name if isinstance(type_, Struct) else ""

    def as_topic(self) -> Pattern:
        """The pattern if the interface is published or subscribed to."""
        return Pattern.PUBLISH if self.pattern is Pattern.UNMARKED else self.pattern

    def as_service(self) -> Pattern:
        """The pattern if the interface is implemented or required."""
        return Pattern.QUERY if self.pattern is Pattern.UNMARKED else self.pattern


class Interface(Declaration):
    """An interface of a module. `style` is "thrift" for a service of a Thrift definition, else "".

    A middleware may have a wire form for a style: YARP carries calls as yarpidl_thrift does.
    The first of its operations are those of its `base`.
    """

    operations: tuple[Operation, ...]
    style: str = ""
    base: Interface | None = None

    @property
    def own_operations(self) -> tuple[Operation, ...]:
        """The operations that are declared in the interface itself."""
        return self.operations[len(self.base.operations) if self.base else 0 :]


class Module(Record):
    """One IDSL file, resolved. `declarations` holds types, exceptions and interfaces in order.

    `imports` are the modules it imports, resolved, in order of writing; `aliases` are other names
    of types, which only Thrift definitions have. `origin` is the language of an imported
    definition, "ros", "thrift" or "bottle", else "".
    """

    name: str
    path: Path
    span: Span
    doc: str
    imports: tuple[Module, ...]
    declarations: tuple[Declaration, ...]
    aliases: tuple[Alias, ...] = ()
    origin: str = ""

    @property
    def interfaces(self) -> tuple[Interface, ...]:
        """The interfaces of the module."""
        return tuple(d for d in self.declarations if isinstance(d, Interface))

    @property
    def is_ros(self) -> bool:
        """Whether it is a ROS definition."""
        return self.origin == "ros"

    def closure(self) -> tuple[Module, ...]:
        """The module and all its direct and indirect imports, imported modules first."""
        seen: dict[int, Module] = {}

        def visit(module: Module) -> None:
            for imported in module.imports:
                if id(imported) not in seen:
                    visit(imported)
            seen[id(module)] = module

        visit(self)
        return tuple(seen.values())
