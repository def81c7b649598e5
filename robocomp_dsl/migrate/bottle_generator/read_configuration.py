"""Reads a configuration of yarp-bottle-generator.

In: the sections of a file. Out: a `BottleConfiguration`, or None with findings. Everything that the
original accepts silently, though it cannot mean it, is an error.
"""

from __future__ import annotations

import re

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.configuration import (
    FUNCTIONS,
    BottleConfiguration,
    IniName,
    Mux,
)
from robocomp_dsl.migrate.bottle_generator.ini_file import IniSection, IniValue, read_ini
from robocomp_dsl.migrate.bottle_generator.keys import SectionReader
from robocomp_dsl.migrate.bottle_generator.message_fields import FieldsReader
from robocomp_dsl.source import Source

_MUX = re.compile(r"mux(\d+)")
_GENERAL = ("output_name", "to_ros", "from_ros_topics", "num_mux", "rate", "ros_msg_name")
_MUX_KEYS = ("num_ports", "ports", "function", "verbose")
_MAX_RATE = 10_000.0


def read_configuration(source: Source, report: Report) -> BottleConfiguration | None:
    """The configuration of a file."""
    findings = Report()
    configuration = _Reader(source, findings).read()
    report.extend(findings)
    return None if findings.has_errors else configuration


class _Reader:
    def __init__(self, source: Source, report: Report) -> None:
        self._source = source
        self._report = report
        self._sections = read_ini(source, report)

    def read(self) -> BottleConfiguration | None:
        """All of it; None if a part is missing without which nothing can be said."""
        general = self._section("general", _GENERAL)
        top = self._sections.get("message")
        muxes = self._muxes(general)
        output = self._name(general.required("output_name"))
        if top is None:
            self._missing_section("message", "the fields of the output")
            return None
        to_ros = self._direction(general, top)
        message = FieldsReader(self._sections, muxes, self._report, to_ros=to_ros)
        fields = message.read(top)
        self._report_unknown_sections(message.used)
        if output is None:
            return None
        return BottleConfiguration(
            output,
            to_ros,
            self._rate(general),
            self._message_type(general) if to_ros else None,
            muxes,
            fields,
            top.entries["num_fields"].span if "num_fields" in top.entries else top.span,
        )

    def _section(self, name: str, keys: tuple[str, ...]) -> SectionReader:
        section = self._sections.get(name)
        if section is None:
            self._missing_section(name, "the name and direction of the output")
            section = IniSection(name, self._source.file_span)
            return SectionReader(section, keys, Report())
        return SectionReader(section, keys, self._report)

    def _missing_section(self, name: str, what: str) -> None:
        self._report.add(
            codes.MISSING_KEY,
            self._source.file_span,
            f"the section `[{name}]` is missing",
            help=f"it states {what}",
        )

    def _direction(self, general: SectionReader, top: IniSection) -> bool:
        """Whether the output is a topic of ROS. Reports inputs of the same middleware."""
        to_ros, from_ros = general.flag("to_ros"), general.flag("from_ros_topics")
        entries = general.section.entries
        for key, value, other in (
            ("to_ros", to_ros, from_ros),
            ("from_ros_topics", from_ros, to_ros),
        ):
            if value is None and key not in entries and entries:
                assumed = not other if other is not None else _builds_header(self._sections, top)
                assumed = assumed if key == "to_ros" or other is not None else not assumed
                text = "true" if assumed else "false"
                self._report.add(
                    codes.ASSUMED_KEY,
                    general.section.span,
                    f"`{key}` is missing; `{key} = {text}` is assumed",
                    help=f"add `{key} = {text}`",
                )
        if to_ros is None and from_ros is None:
            return _builds_header(self._sections, top)
        if to_ros is not None and to_ros == from_ros:
            name = "ROS" if to_ros else "YARP"
            self._report.add(
                codes.DIRECTION,
                entries["from_ros_topics"].span,
                f"the inputs and the output are both of {name}",
                notes=(Note(entries["to_ros"].span, "the output is stated here"),),
                help="change one of them, or write the bridge in BDSL, which joins any two",
            )
        return to_ros if to_ros is not None else not from_ros

    def _rate(self, general: SectionReader) -> float | None:
        entry = general.section.entries.get("rate")
        if entry is None:
            if general.section.entries:
                self._report.add(
                    codes.ASSUMED_KEY,
                    general.section.span,
                    "`rate` is missing; every set of inputs is sent",
                    help="add `rate = 60` to limit it (Hz)",
                )
            return None
        try:
            rate = float(entry.text)
        except ValueError:
            rate = 0.0
        if not 0 < rate <= _MAX_RATE:
            self._report.add(
                codes.INVALID_VALUE,
                entry.span if entry.text else entry.key_span,
                f"`{entry.text}` is no rate",
                help="write a number of Hz greater than 0, such as `rate = 60`",
            )
        return rate

    def _message_type(self, general: SectionReader) -> IniName | None:
        entry = general.section.entries.get("ros_msg_name")
        if entry is None:
            return None
        if not re.fullmatch(r"(?:[A-Za-z]\w*/)?(?:msg/)?[A-Za-z]\w*", entry.text):
            self._report.add(
                codes.INVALID_VALUE,
                entry.span if entry.text else entry.key_span,
                f"`{entry.text}` is no type of ROS",
                help="write the package and the type, such as `sensor_msgs/JointState`",
            )
        return IniName(entry.text, entry.span)

    def _muxes(self, general: SectionReader) -> tuple[Mux, ...]:
        """The sections `[mux1]` to `[mux<num_mux>]`."""
        count = general.number("num_mux")
        present = {
            int(found[1]): section
            for name, section in self._sections.items()
            if (found := _MUX.fullmatch(name))
        }
        entry = general.section.entries.get("num_mux")
        for number, section in sorted(present.items()):
            if count is not None and entry is not None and not 1 <= number <= count:
                self._report.add(
                    codes.COUNT_MISMATCH,
                    section.span,
                    f"`[{section.name}]` is not read: num_mux is {count}",
                    notes=(Note(entry.span, "num_mux is stated here"),),
                    help=f"write `num_mux = {len(present)}`, or delete the section",
                )
        missing = [n for n in range(1, (count or 0) + 1) if n not in present]
        if missing and entry is not None:
            self._report.add(
                codes.COUNT_MISMATCH,
                entry.span,
                f"num_mux is {count}, but the section `[mux{missing[0]}]` is missing",
                help=f"add the section, or write `num_mux = {len(present)}`",
            )
        return tuple(self._mux(number, present[number]) for number in sorted(present))

    def _mux(self, number: int, section: IniSection) -> Mux:
        reader = SectionReader(section, _MUX_KEYS, self._report)
        reader.flag("verbose")
        function = reader.required("function")
        if function and function.text not in FUNCTIONS:
            reader.not_one_of(function, "function", FUNCTIONS)
        count, ports = reader.number("num_ports"), reader.required("ports")
        names = self._port_names(section, ports, count) if ports else ()
        text = function.text if function else FUNCTIONS[0]
        return Mux(number, names, text, section.span)

    def _port_names(
        self, section: IniSection, ports: IniValue, count: int | None
    ) -> tuple[IniName, ...]:
        names: list[IniName] = []
        at = ports.span.start
        parts = ports.text.split(",")
        for index, part in enumerate(parts):
            begin = at + len(part) - len(part.lstrip())
            span = ports.span.subspan(begin, begin + len(part.strip()))
            at += len(part) + 1
            if part.strip():
                names.append(IniName(part.strip(), span))
                self._check_name(names[-1])
            elif index == len(parts) - 1 and names:
                comma = ports.span.subspan(ports.span.end - 1, ports.span.end)
                message = "a comma behind the last name"
                self._report.add(codes.UNUSUAL, comma, message, help="delete it")
            else:
                self._report.add(
                    codes.COUNT_MISMATCH,
                    ports.span if ports.text else ports.key_span,
                    "a name is missing in `ports`",
                    help="delete the comma, or write the name",
                )
        entry = section.entries.get("num_ports")
        if names and count is not None and entry is not None and count != len(names):
            number = len(names)
            self._report.add(
                codes.COUNT_MISMATCH,
                entry.span,
                f"num_ports is {count}, but `ports` has {number} name{'s' * (number != 1)}",
                notes=(Note(ports.span, "the names are here"),),
                help=f"write `num_ports = {number}`",
            )
        return tuple(names)

    def _name(self, value: IniValue | None) -> IniName | None:
        if value is None:
            return None
        name = IniName(value.text, value.span)
        self._check_name(name)
        return name

    def _check_name(self, name: IniName) -> None:
        if re.search(r"\s", name.text):
            what, help_ = "has a blank", "names are separated by commas"
        elif not name.text.startswith("/") or name.text.endswith("/"):
            what, help_ = "is not the name of a port or topic", f"write `/{name.text.strip('/')}`"
        else:
            return
        self._report.add(codes.INVALID_VALUE, name.span, f"`{name.text}` {what}", help=help_)

    def _report_unknown_sections(self, used: set[str]) -> None:
        for name, section in self._sections.items():
            known = name in {"general", "message"} or _MUX.fullmatch(name) or name in used
            if not known:
                self._report.add(
                    codes.COUNT_MISMATCH,
                    section.span,
                    f"`[{name}]` is not read: no field names it",
                    help="name it by a field of type `msg`, or delete the section",
                )


def _builds_header(sections: dict[str, IniSection], top: IniSection) -> bool:
    """Whether the first field is a nested message that starts with a counter: a header of ROS."""
    if top.entries.get("1_type") is None or top.entries["1_type"].text != "msg":
        return False
    name = top.entries.get("1_msg")
    header = sections.get(name.text) if name else None
    first = header.entries.get("1_type") if header else None
    return first is not None and first.text == "counter"
