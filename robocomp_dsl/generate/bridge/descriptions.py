"""The descriptions of the component that a bridge becomes: IDSL, CDSL, PDSL and DDSL.

In: a bridge and its wiring. Out: `OutputFile`s, rewritten by each run.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.generate.bridge.wiring import BridgeWiring, ForeignPeer
from robocomp_dsl.generate.literals import lines, printable
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_ports import BridgePort
from robocomp_dsl.model.bridge_values import HubPolicy
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.deployment import Qos
from robocomp_dsl.model.interface import Module, Operation, Param, Pattern
from robocomp_dsl.model.types import Enum, Field, Primitive, Sequence, Struct, Type
from robocomp_dsl.model.units import unknown_words
from robocomp_dsl.record import ValueRecord

FOLDER = "python/bridge/"
MAX_RATE_HZ = 10_000
STATUS_RATE_HZ = 5.0
"""How often an action publishes the status of its goals."""


class DescriptionCode(ValueRecord):
    """The data of the templates. `connected` are the names of ports with a foreign peer."""

    bridge: Bridge
    name: str
    source: str
    doc: str
    imports: tuple[str, ...]
    period: int
    wiring: BridgeWiring
    connected: frozenset[str]


def description_files(bridge: Bridge, wiring: BridgeWiring, folder: Path) -> list[OutputFile]:
    """All descriptions, for the folder of the component.

    In another folder than the bridge's, they include copies of the interfaces beside the bridge.
    """
    code = DescriptionCode(
        bridge,
        bridge.name,
        printable(bridge.path.name),
        comment_text(bridge.doc) or f"Bridge of {printable(bridge.path.name)}.",
        tuple(_imports(bridge)),
        period_of(bridge),
        wiring,
        frozenset(peer.port.name for peer in wiring.peers),
    )
    context = {
        "code": code,
        "ports": [_port_line(port, code) for port in bridge.ports],
        "groups": list(_parameter_groups(bridge)),
        "own": {p.name: p for p in wiring.own_addresses},
        "externs": [_extern_line(peer) for peer in wiring.peers],
        "connects": [_connect_line(peer, bridge.name) for peer in wiring.peers],
    }
    files = [
        OutputFile(f"{bridge.name}.{kind}", render(f"{FOLDER}bridge.{kind}.jinja", **context))
        for kind in ("cdsl", "pdsl", "ddsl")
    ]
    files += _copies(bridge, folder)
    if bridge.types is None:
        return files
    text = idsl_text(bridge.types, code.source)
    return [OutputFile(types_file(bridge.types), text), *files]


def _copies(bridge: Bridge, folder: Path) -> Iterator[OutputFile]:
    """The imported files beside the bridge, which a component in another folder does not find."""
    home = bridge.path.resolve().parent
    if folder.resolve() == home:
        return
    modules = {m.path: m for direct in bridge.modules for m in direct.closure()}
    for path, module in modules.items():
        if path.resolve().parent == home and not module.is_ros:
            yield OutputFile(path.name, module.span.source.text)


def types_file(types: Module) -> str:
    """The name of the IDSL file of the types of a bridge."""
    return f"{types.name}.idsl"


def comment_text(doc: str) -> str:
    """A doc comment as one line inside of a comment."""
    return " ".join(lines(doc)).replace("*/", "* /")


def period_of(bridge: Bridge) -> int:
    """The period of the component in ms; 0: all outputs are sent on events."""
    rates = [output.rate_hz for output in bridge.outputs if output.rate_hz]
    rates += [STATUS_RATE_HZ] if bridge.actions else []
    return max(int(1000 / max(rates)), 1) if rates else 0


def _imports(bridge: Bridge) -> Iterator[str]:
    if bridge.types is not None:
        yield types_file(bridge.types)
    used = {port.interface.module for port in bridge.ports if not port.is_own}
    for module in bridge.modules:
        for found in module.closure():
            if found.name in used:
                used.discard(found.name)
                yield import_text(found)


def import_text(module: Module) -> str:
    """How a file imports a module: a ROS definition with its package, others by the file's name."""
    if module.is_ros:
        struct = next(d for d in module.declarations if isinstance(d, Struct) and d.ros_name)
        package, kind, name = struct.ros_name.split("/")
        for suffix in ("_Request", "_Response", "_Goal", "_Result", "_Feedback"):
            name = name.removesuffix(suffix) if kind != "msg" else name
        return f"{package}/{kind}/{name}.{kind}"
    return module.path.name


def _port_line(port: BridgePort, code: DescriptionCode) -> str:
    """`subscribesTo RoverTypes::Left (yarp) as left;`."""
    role = port.role.value
    free = port.role in (Role.SUBSCRIBES, Role.REQUIRES) and port.name not in code.connected
    optional = " optional" * free
    return f"{role} {port.interface.qualified}({port.middleware}) as {port.name}{optional};"


def _parameter_groups(bridge: Bridge) -> Iterator[tuple[str, str, list[tuple[str, str]]]]:
    """Name, comment and parameters of each group; a parameter is its comment and its line."""
    for output in bridge.outputs:
        about = f"The output `{output.name}`."
        comment = "Messages per second; 0: a message whenever its inputs are complete."
        line = f"rate float {_number(output.rate_hz or 0)} [Hz] 0:{MAX_RATE_HZ} live;"
        yield output.name, about, [(comment, line)]
    for hub in bridge.hubs:
        members = [
            (
                "Messages that are older are not used; 0: any age.",
                f"max_age float {_number(hub.max_age_s)} [s] 0: live;",
            )
        ]
        if hub.policy is HubPolicy.SYNCHRONISED:
            comment = "The largest difference of time stamps in one set."
            line = f"tolerance float {_number(hub.tolerance_s)} [s] 0: live;"
            members.insert(0, (comment, line))
        yield hub.name, f"The hub `{hub.name}`.", members


def _number(value: float) -> str:
    """The shortest text of a number that reads as the same number."""
    return str(int(value)) if float(value).is_integer() else repr(float(value))


def _extern_line(peer: ForeignPeer) -> str:
    address = f' at "{_escaped(peer.address)}"' if peer.address else ""
    return f"extern {peer.name} over {peer.middleware}{address} {peer.role.value} {peer.interface};"


def _connect_line(peer: ForeignPeer, component: str) -> str:
    foreign = f"{peer.name}.{peer.interface.rpartition('::')[2]}"
    own = f"{component}.{peer.port.name}"
    is_source = peer.role in (Role.PUBLISHES, Role.REQUIRES)
    ends = f"{foreign} -> {own}" if is_source else f"{own} -> {foreign}"
    items = " ".join(_qos_items(peer.port.qos))
    return f"connect {ends} {{ {items} }};" if items else f"connect {ends};"


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _qos_items(qos: Qos) -> Iterator[str]:
    """The quality of service as in the body of a connection."""
    if qos.reliable is not None:
        yield "reliable;" if qos.reliable else "best_effort;"
    if qos.keep_all:
        yield "keep all;"
    if qos.depth is not None:
        yield f"depth {qos.depth};"
    if qos.latched:
        yield "latched;"
    if qos.priority is not None:
        yield f"priority {qos.priority};"
    if qos.deadline_ms is not None:
        yield f"deadline {qos.deadline_ms:g} ms;"
    if qos.liveliness_ms is not None:
        yield f"liveliness {qos.liveliness_ms:g} ms;"


def idsl_text(module: Module, source: str) -> str:
    """The types of a bridge as IDSL; the lengths of sequences are left to the bridge."""
    printer = _IdslPrinter(module)
    rows = [f"// Code generated by rcgen from {source}. DO NOT EDIT."]
    imports = [f'import "{import_text(imported)}";' for imported in module.imports]
    body = "\n".join(printer.declarations())
    head = "\n".join([*rows, *imports, ""])
    about = f"/** The messages of the bridge in {source}. */"
    return f"{head}\n{about}\nmodule {module.name}\n{{\n{body}}};\n"


class _IdslPrinter:
    """Prints the declarations of one module."""

    def __init__(self, module: Module) -> None:
        self._module = module

    def declarations(self) -> Iterator[str]:
        """All declarations in order, each as some lines."""
        for declaration in self._module.declarations:
            match declaration:
                case Struct():
                    fields = "".join(f"        {self._field(f)}\n" for f in declaration.fields)
                    yield f"    struct {declaration.name}\n    {{\n{fields}    }};\n"
                case Sequence():
                    yield f"    sequence<{self._type(declaration.element)}> {declaration.name};\n"
                case Enum():
                    names = ", ".join(e.name for e in declaration.enumerators)
                    yield f"    enum {declaration.name} {{ {names} }};\n"
        for interface in self._module.interfaces:
            operations = "".join(f"        {self._operation(o)}\n" for o in interface.operations)
            yield f"    interface {interface.name}\n    {{\n{operations}    }};\n"

    def _type(self, type_: Type) -> str:
        if isinstance(type_, Primitive):
            return type_.name
        is_own = type_.module == self._module.name
        return type_.name if is_own else type_.qualified

    def _field(self, field: Field) -> str:
        unit = _known_unit(field.unit)
        return f"{self._type(field.type)} {field.name}{unit};"

    def _operation(self, operation: Operation) -> str:
        marks = f"[{operation.pattern.value}] " if operation.marked else ""
        if operation.pattern in (Pattern.PUBLISH, Pattern.COMMAND):
            marks = f"[{operation.pattern.value}] "
        result = self._type(operation.result) if operation.result is not None else "void"
        parameters = [self._parameter(p) for p in operation.inputs]
        parameters += [f"out {self._parameter(p)}" for p in operation.outputs]
        return f"{marks}{result} {operation.name}({', '.join(parameters)});"

    def _parameter(self, parameter: Param) -> str:
        unit = _known_unit(parameter.unit)
        return f"{self._type(parameter.type)} {parameter.name}{unit}"


def _known_unit(text: str) -> str:
    """A unit in brackets; "" for a unit of a program's own, which IDSL does not have."""
    return f" [{text}]" if text and not unknown_words(text) else ""
