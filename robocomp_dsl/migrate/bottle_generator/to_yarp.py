"""The bridge of a configuration that sends messages of ROS topics to a port of YARP.

In: a configuration, and the types of the topics. Out: the inputs, hubs and the output as lines of
BDSL. The output is a list of items; each field of a message is an item.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.bdsl_lines import BdslLines
from robocomp_dsl.migrate.bottle_generator.bdsl_values import (
    RADIANS,
    format_constant,
    format_list,
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
from robocomp_dsl.migrate.bottle_generator.message_types import MessageTypes, RosMessage
from robocomp_dsl.migrate.bottle_generator.names import identifier, unique
from robocomp_dsl.model.types import DOUBLE, Field, Primitive


class YarpOutput:
    """Writes the lines; `imports` are the definitions that they use."""

    def __init__(
        self,
        configuration: BottleConfiguration,
        messages: MessageTypes,
        types: Mapping[str, str],
        lookup: Callable[[str], str] | None,
        report: Report,
    ) -> None:
        self.imports: list[str] = []
        self._configuration = configuration
        self._messages = messages
        self._types = types
        self._lookup = lookup
        self._report = report
        self._names: set[str] = set()
        self._hubs = {m.number: unique(f"mux{m.number}", self._names) for m in configuration.muxes}
        self._inputs: dict[str, tuple[str, RosMessage]] = {}

    def lines(self) -> BdslLines | None:
        """The lines in the block of the bridge; None, with findings, if a type is not known."""
        lines = BdslLines()
        used = {field.number for field in self._configuration.fields if isinstance(field, MuxField)}
        muxes = [mux for mux in self._configuration.muxes if mux.number in used]
        for mux in muxes:
            for port in mux.ports:
                self._add_input(port, lines)
        if self._report.has_errors:
            return None
        lines.add("")
        for mux in muxes:
            values = ", ".join(self._inputs[port.text][0] for port in mux.ports)
            lines.add(f"hub {self._hubs[mux.number]} = {values} {{ policy all; }};", mux.span)
        if muxes:
            lines.add("")
        output = self._configuration.output
        name = unique(identifier(output.text), self._names)
        lines.add(f'output {name} over yarp at "{output.text}"', output.span)
        lines.add("{")
        if self._configuration.rate is not None:
            lines.add(f"    rate {format_rate(self._configuration.rate)};")
        for field in self._configuration.fields:
            for item in self._items(field):
                lines.add(f"    item {item};", field.span)
        lines.add("};")
        return None if self._report.has_errors else lines

    def _add_input(self, port: IniName, lines: BdslLines) -> None:
        if port.text in self._inputs:
            return
        stated = self._types.get(port.text) or (self._lookup(port.text) if self._lookup else "")
        if not stated:
            self._report.add(
                codes.MESSAGE_TYPE,
                port.span,
                f"the type of the topic `{port.text}` is not known",
                help=f"add `--type {port.text}=PACKAGE/TYPE`, or start a node that publishes it",
            )
            return
        message = self._messages.named(IniName(stated, port.span))
        if message is None:
            return
        if message.definition not in self.imports:
            self.imports.append(message.definition)
        name = unique(identifier(port.text), self._names)
        self._inputs[port.text] = (name, message)
        type_ = f"{message.struct.module}::{message.struct.name}"
        lines.add(f'input {name} : {type_} over ros1 at "{port.text}";', port.span)

    def _items(self, field: MessageField) -> list[str]:
        """The items that a field of `[message]` gives."""
        if not isinstance(field, MuxField):
            return [_value(field)]
        mux = next(m for m in self._configuration.muxes if m.number == field.number)
        hub = self._hubs[mux.number]
        fields = [f for port in mux.ports for f in self._inputs[port.text][1].struct.fields]
        return [self._converted(mux, f, f"{hub}[{n}]") for n, f in enumerate(fields)]

    def _converted(self, mux: Mux, field: Field, value: str) -> str:
        """A field of a message, converted as the mux says."""
        if mux.function == "none":
            return value
        if not isinstance(field.type, Primitive):
            self._report.add(
                codes.MESSAGE_TYPE,
                mux.span,
                f"`{mux.function}` converts numbers, but `{field.name}` is a list",
                help="use `function = none`, or write the bridge in BDSL",
            )
            return value
        number = value if field.type == DOUBLE else f"number({value})"
        return f"{number} * {RADIANS!r}" if mux.function == "deg_to_rad" else number


def _value(field: MessageField) -> str:
    match field:
        case ConstantField():
            return format_constant(field.constant)
        case ListField():
            return format_list(field.constants)
        case TimeField():
            return "{ counter, now }"
        case CounterField():
            return "counter"
        case NestedField():
            values = ", ".join(_value(inner) for inner in field.fields)
            return f"{{ {values} }}" if values else "{}"
        case MuxField():
            return f"mux{field.number}"
