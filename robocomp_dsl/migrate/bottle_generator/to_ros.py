"""The bridge of a configuration that sends values of YARP ports to a topic of ROS.

In: a configuration. Out: the inputs, hubs and the output as lines of BDSL. The type of each input
follows from its converter and from the field of the message that takes it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.bdsl_lines import BdslLines
from robocomp_dsl.migrate.bottle_generator.bdsl_values import (
    RADIANS,
    format_constant,
    format_list,
    format_primitive,
    format_rate,
)
from robocomp_dsl.migrate.bottle_generator.configuration import (
    BottleConfiguration,
    ConstantField,
    CounterField,
    IniName,
    ListField,
    MessageField,
    Mux,
    MuxField,
    NestedField,
    TimeField,
)
from robocomp_dsl.migrate.bottle_generator.message_types import (
    MessageTypes,
    RosMessage,
    is_time,
    without_sequence_number,
)
from robocomp_dsl.migrate.bottle_generator.names import identifier, unique
from robocomp_dsl.model.types import DOUBLE, Primitive, Sequence, Struct, Type
from robocomp_dsl.source import Span


@dataclass(slots=True)
class _MuxUse:
    """What the fields of the message make of a mux: `length` values of `element`; 0: any."""

    element: str
    length: int
    span: Span


class RosOutput:
    """Writes the lines; `imports` are the definitions that they use."""

    def __init__(
        self,
        configuration: BottleConfiguration,
        messages: MessageTypes,
        types: Mapping[str, str],
        report: Report,
    ) -> None:
        self.imports: list[str] = []
        self._configuration = configuration
        self._messages = messages
        self._types = types
        self._report = report
        self._muxes = {mux.number: mux for mux in configuration.muxes}
        self._uses: dict[int, _MuxUse] = {}
        self._names: set[str] = set()
        self._hubs = {n: unique(f"mux{n}", self._names) for n in self._muxes}

    def lines(self) -> BdslLines | None:
        """The lines in the block of the bridge; None, with findings, if the fields do not fit."""
        message = self._message()
        if message is None:
            return None
        self.imports.append(message.definition)
        assignments = BdslLines()
        self._assign(self._configuration.fields, message.struct, "", assignments)
        if self._report.has_errors:
            return None
        lines = BdslLines()
        self._add_inputs(lines)
        self._add_output(message, assignments, lines)
        return lines

    def _message(self) -> RosMessage | None:
        output = self._configuration.output
        stated = self._types.get(output.text)
        if stated:
            return self._messages.named(IniName(stated, output.span))
        if self._configuration.message_type is not None:
            return self._messages.named(self._configuration.message_type)
        return self._messages.described(self._configuration)

    def _assign(
        self, fields: tuple[MessageField, ...], struct: Struct, path: str, lines: BdslLines
    ) -> None:
        """Assign the fields to those of a struct, in order."""
        fields = without_sequence_number(fields, struct)
        if len(fields) != len(struct.fields):
            names = ", ".join(field.name for field in struct.fields)
            self._report.add(
                codes.MESSAGE_TYPE,
                self._fields_span(path, fields),
                f"`{struct.module}/{struct.name}` has {len(struct.fields)} fields, "
                f"the configuration gives {len(fields)}",
                help=f"its fields are {names}",
            )
            return
        for field, target in zip(fields, struct.fields, strict=True):
            self._assign_field(field, target.type, f"{path}{target.name}", lines)

    def _fields_span(self, path: str, fields: tuple[MessageField, ...]) -> Span:
        if not path or not fields:
            return self._configuration.fields_span
        return fields[-1].span

    def _assign_field(self, field: MessageField, type_: Type, path: str, lines: BdslLines) -> None:
        match field, type_:
            case (NestedField(), Struct()):
                self._assign(field.fields, type_, f"{path}.", lines)
            case (TimeField(), Struct()) if is_time(type_):
                lines.add(f"{path} = now;", field.span)
            case (CounterField(), Primitive()) if not type_.is_text:
                lines.add(f"{path} = counter;", field.span)
            case (ConstantField(), Primitive()):
                lines.add(f"{path} = {format_constant(field.constant)};", field.span)
            case (ListField(), Sequence() | Struct()):
                lines.add(f"{path} = {format_list(field.constants)};", field.span)
            case (MuxField(), Sequence() | Struct()) if self._use(field, type_, path):
                lines.add(f"{path} = {self._hub_value(self._muxes[field.number])};", field.span)
            case (MuxField(), Sequence() | Struct()):
                pass
            case _:
                self._report.add(
                    codes.MESSAGE_TYPE,
                    field.span,
                    f"the field `{path}` is {_describe(type_)}, not {_KINDS[type(field)]}",
                    help=_advice(field, type_),
                )

    def _use(self, field: MuxField, type_: Sequence | Struct, path: str) -> bool:
        """Note which values the field takes; False, with a finding, if a mux cannot give them."""
        mux = self._muxes[field.number]
        if isinstance(type_, Sequence):
            element, length = type_.element, type_.size
        else:
            element, length = DOUBLE, len(type_.fields)
        plain = isinstance(element, Primitive)
        if isinstance(type_, Struct):
            plain = all(isinstance(f.type, Primitive) and not f.type.is_text for f in type_.fields)
        if not plain or (mux.function != "none" and element.is_text):  # type: ignore[union-attr]
            self._report.add(
                codes.MESSAGE_TYPE,
                field.span,
                f"the field `{path}` is {_describe(type_)}, which `mux{field.number}` cannot give",
                help="a mux gives numbers or texts; write the bridge in BDSL to select its values",
            )
            return False
        name = "double" if mux.function != "none" else format_primitive(element)  # type: ignore[arg-type]
        use = _MuxUse(name, length, field.span)
        earlier = self._uses.setdefault(field.number, use)
        if (earlier.element, earlier.length) != (use.element, use.length):
            self._report.add(
                codes.MESSAGE_TYPE,
                field.span,
                f"`mux{field.number}` cannot give both {_amount(earlier)} and {_amount(use)}",
                help="use two muxes with the same ports",
            )
            return False
        return True

    def _hub_value(self, mux: Mux) -> str:
        name = self._hubs[mux.number]
        if mux.function != "deg_to_rad":
            return name
        return f"{name} to [rad]" if self._in_degrees(mux) else f"{name} * {RADIANS!r}"

    def _in_degrees(self, mux: Mux) -> bool:
        """Whether no other converter reads the ports of a mux that converts degrees."""
        ports = {port.text for port in mux.ports}
        return mux.function == "deg_to_rad" and not any(
            other.function != "deg_to_rad" and ports & {port.text for port in other.ports}
            for other in self._muxes.values()
        )

    def _add_inputs(self, lines: BdslLines) -> None:
        """Add an input for each port, and the hubs."""
        inputs: dict[str, tuple[str, str]] = {}
        hubs = []
        for number, use in sorted(self._uses.items()):
            mux = self._muxes[number]
            size = _port_length(use.length, len(mux.ports))
            type_ = f"{use.element}[{size or ''}]"
            type_ += " [deg]" if self._in_degrees(mux) else ""
            for port in mux.ports:
                name, earlier = inputs.setdefault(
                    port.text, (unique(identifier(port.text), self._names), type_)
                )
                if earlier != type_:
                    message = f"`{port.text}` cannot be both `{earlier}` and `{type_}`"
                    self._report.add(codes.MESSAGE_TYPE, port.span, message)
                if earlier == type_ and not any(f" {name} :" in line for line in lines.lines):
                    lines.add(f'input {name} : {type_} over yarp at "{port.text}";', port.span)
            hubs.append(self._hub(mux, use, [inputs[port.text][0] for port in mux.ports]))
        lines.add("")
        for hub, span in hubs:
            lines.add(hub, span)
        lines.add("")

    def _hub(self, mux: Mux, use: _MuxUse, inputs: list[str]) -> tuple[str, Span]:
        length = ""
        if use.length and not _port_length(use.length, len(mux.ports)):
            length = f" length {use.length};"
        name = self._hubs[mux.number]
        return f"hub {name} = {', '.join(inputs)} {{ policy all;{length} }};", mux.span

    def _add_output(self, message: RosMessage, assignments: BdslLines, lines: BdslLines) -> None:
        output = self._configuration.output
        name = unique(identifier(output.text), self._names)
        type_ = f"{message.struct.module}::{message.struct.name}"
        lines.add(f'output {name} : {type_} over ros1 at "{output.text}"', output.span)
        lines.add("{")
        if self._configuration.rate is not None:
            lines.add(f"    rate {format_rate(self._configuration.rate)};")
        for line, origin in zip(assignments.lines, assignments.origins, strict=True):
            lines.add(f"    {line}", origin)
        lines.add("};")


def _port_length(length: int, ports: int) -> int:
    """How many values each of the ports gives; 0: not known before they arrive."""
    if ports == 1:
        return length
    return 1 if length == ports else 0


def _describe(type_: Type) -> str:
    match type_:
        case Primitive():
            return f"one {type_.name}"
        case Sequence():
            return f"an array of {getattr(type_.element, 'name', 'values')}"
        case Struct():
            return f"a `{type_.module}/{type_.name}`"
    return "of another type"


_KINDS: dict[type[MessageField], str] = {
    ConstantField: "one constant",
    ListField: "a list",
    TimeField: "a timestamp",
    CounterField: "a number",
    MuxField: "the list of a mux",
    NestedField: "a nested message",
}


def _advice(field: MessageField, type_: Type) -> str:
    """How a field of `type_` is written."""
    if isinstance(field, MuxField):
        return "write the bridge in BDSL, where `mux1[0]` is the first value of a mux"
    if is_time(type_):
        return "use the type `timestamp`"
    match type_:
        case Struct():
            return "use the type `msg` and a nested section with its fields"
        case Sequence():
            return "use the type `list`, or `mux`"
    return "use the type `single_value`, or `counter`"


def _amount(use: _MuxUse) -> str:
    return f"{use.length or 'any number of'} values of {use.element}"
