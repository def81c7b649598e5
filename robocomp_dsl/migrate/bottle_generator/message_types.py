"""Finds the ROS messages that a configuration names, or that its fields describe.

In: a name such as `sensor_msgs/JointState` or `JointState`. Out: the struct of the message, from
the same places as an import (`check/workspace/ros_definitions.py`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.ros_definitions import canonical_name
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.configuration import (
    BottleConfiguration,
    ConstantField,
    CounterField,
    IniConstant,
    IniName,
    ListField,
    MessageField,
    MuxField,
    NestedField,
    TimeField,
)
from robocomp_dsl.model.types import STRING, Primitive, Sequence, Struct, Type
from robocomp_dsl.source import UnreadableSource

_MOST_SHOWN = 6


@dataclass(frozen=True, slots=True)
class RosMessage:
    """A message; `definition` is what an import of it names, `std_msgs/msg/String.msg`."""

    struct: Struct
    definition: str


def is_time(type_: Type) -> bool:
    """Whether a type is the time of ROS."""
    return isinstance(type_, Struct) and type_.ros_name == "builtin_interfaces/msg/Time"


class MessageTypes:
    """The messages that the file `beside` can import."""

    def __init__(self, workspace: Workspace, beside: Path, report: Report) -> None:
        self._workspace = workspace
        self._beside = beside
        self._report = report

    def named(self, name: IniName) -> RosMessage | None:
        """The message of a name as written; None, with a finding, if there is none."""
        written = f"{name.text}.msg"
        if "/" in written:
            return self._with_package(name, written)
        names = self._workspace.import_resolver.ros.importable(self._beside, self._beside)
        found = [n for n in names if n.rpartition("/")[2] == written and "/msg/" in n]
        known = [n.replace("/msg/", "/").removesuffix(".msg") for n in found]
        if len(found) == 1:
            self._report.add(
                codes.UNUSUAL,
                name.span,
                f"`{name.text}` has no package; it is `{known[0]}`",
                help=f"write `ros_msg_name = {known[0]}`",
            )
            return self._load(found[0], name)
        if not found:
            self._report_unknown(name, name.text)
        else:
            message = f"`{name.text}` is in several packages: {join_names(known)}"
            self._report.add(codes.MESSAGE_TYPE, name.span, message, help="write the package, too")
        return None

    def _with_package(self, name: IniName, written: str) -> RosMessage | None:
        definition = canonical_name(written)
        message = self._load(definition, name)
        if message is None:
            self._report_unknown(name, written.removesuffix(".msg"))
        return message

    def _report_unknown(self, name: IniName, written: str) -> None:
        ros = self._workspace.import_resolver.ros
        guesses = ros.suggest(f"{written}.msg", self._beside, self._beside)
        shown = [g.replace("/msg/", "/").removesuffix(".msg") for g in guesses]
        self._report.add(
            codes.MESSAGE_TYPE,
            name.span,
            f"cannot find the ROS message `{written}`",
            label=f"did you mean {join_names(shown, most=3)}?" if shown else "",
            help="`-I FOLDER` and ROS_PACKAGE_PATH name folders with packages, such as "
            "FOLDER/my_msgs/msg/Pose.msg",
        )

    def _load(self, definition: str, name: IniName) -> RosMessage | None:
        struct = self._struct(definition)
        if struct is None:
            return None
        if not struct.fields:
            message = f"`{struct.name}` has no fields"
            self._report.add(codes.MESSAGE_TYPE, name.span, message)
        return RosMessage(struct, definition)

    def _struct(self, definition: str) -> Struct | None:
        ros = self._workspace.import_resolver.ros
        path = ros.find(definition, self._beside, self._beside)
        if path is None:
            return None
        self._workspace.modules.start_run(self._beside)
        try:
            loaded = self._workspace.modules.load(path)
        except UnreadableSource:
            return None
        self._report.extend(loaded.diagnostics)
        stem = path.stem
        structs = (d for m in loaded.modules for d in m.declarations if isinstance(d, Struct))
        return next((struct for struct in structs if struct.name == stem), None)

    def described(self, configuration: BottleConfiguration) -> RosMessage | None:
        """The only message that fits the fields; None, with a finding, if there is not one."""
        fitting = list(self._fitting(configuration))
        shown = [m.definition.replace("/msg/", "/").removesuffix(".msg") for m in fitting]
        span = configuration.output.span
        if len(fitting) == 1:
            self._report.add(
                codes.ASSUMED_KEY,
                span,
                f"`ros_msg_name` is missing; only `{shown[0]}` fits the fields",
                help=f"add `ros_msg_name = {shown[0]}`",
            )
            return fitting[0]
        names = join_names(shown, most=_MOST_SHOWN)
        help_ = f"the fields fit {names}" if shown else "no known message fits the fields"
        self._report.add(
            codes.MISSING_KEY, span, "`ros_msg_name` is missing in `[general]`", help=help_
        )
        return None

    def _fitting(self, configuration: BottleConfiguration) -> Iterator[RosMessage]:
        for definition in self._workspace.import_resolver.ros.importable(
            self._beside, self._beside
        ):
            if "/msg/" not in definition:
                continue
            struct = self._struct(definition)
            if struct is not None and fits(configuration.fields, struct):
                yield RosMessage(struct, definition)


def without_sequence_number(
    fields: tuple[MessageField, ...], struct: Struct
) -> tuple[MessageField, ...]:
    """The fields of a header without the first, if `struct` is one without `seq`.

    The header of ROS 1 starts with a number that the middleware counts; that of ROS 2 has none.
    """
    is_header = struct.ros_name == "std_msgs/msg/Header"
    if is_header and len(fields) == len(struct.fields) + 1 == 3 and _is_number(fields[0]):
        return fields[1:]
    return fields


def _is_number(field: MessageField) -> bool:
    match field:
        case CounterField():
            return True
        case ConstantField(IniConstant(value)):
            return isinstance(value, int)
    return False


def fits(fields: tuple[MessageField, ...], struct: Struct) -> bool:
    """Whether fields may be those of a message."""
    fields = without_sequence_number(fields, struct)
    if len(fields) != len(struct.fields):
        return False
    pairs = zip(fields, struct.fields, strict=True)
    return all(_fits(field, target.type) for field, target in pairs)


def _fits(field: MessageField, type_: Type) -> bool:
    match type_:
        case Struct():
            return _fits_struct(field, type_)
        case Primitive():
            number = isinstance(field, CounterField) and not type_.is_text
            return number or (isinstance(field, ConstantField) and _has_type(field.constant, type_))
        case Sequence(element=Primitive() as element):
            if isinstance(field, ListField):
                return all(_has_type(constant, element) for constant in field.constants)
            return isinstance(field, MuxField) and element is not STRING
    return False


def _fits_struct(field: MessageField, struct: Struct) -> bool:
    match field:
        case NestedField():
            return fits(field.fields, struct)
        case TimeField():
            return is_time(struct)
        case MuxField():
            plain = [f.type for f in struct.fields]
            return all(isinstance(t, Primitive) and not t.is_text for t in plain)
    return False


def _has_type(constant: IniConstant, type_: Primitive) -> bool:
    return isinstance(constant.value, str) == type_.is_text
