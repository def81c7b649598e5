"""Reads the fields of `[message]` and of nested sections."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from robocomp_dsl.check.literals import join_names
from robocomp_dsl.diagnostics import Note, Report, did_you_mean
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.configuration import (
    ConstantField,
    CounterField,
    ListField,
    MessageField,
    Mux,
    MuxField,
    NestedField,
    TimeField,
)
from robocomp_dsl.migrate.bottle_generator.ini_file import IniSection, IniValue
from robocomp_dsl.migrate.bottle_generator.keys import SectionReader
from robocomp_dsl.migrate.bottle_generator.literals import read_constant, read_constants

TYPES = ("single_value", "list", "timestamp", "counter", "mux", "msg")
_KEY = re.compile(r"(\d+)_(type|msg|mux)")
_RESERVED = re.compile(r"general|message|mux\d*")
_USED_KEYS = {"single_value": "msg", "list": "msg", "msg": "msg", "mux": "mux"}


class FieldsReader:
    """Reads fields recursively; `used` are the names of the nested sections that were read."""

    def __init__(
        self,
        sections: Mapping[str, IniSection],
        muxes: Sequence[Mux],
        report: Report,
        *,
        to_ros: bool,
    ) -> None:
        self.used: set[str] = set()
        self._sections = sections
        self._muxes = {mux.number: mux for mux in muxes}
        self._report = report
        self._to_ros = to_ros
        self._timestamp: TimeField | None = None
        self._path: list[IniSection] = []

    def read(self, section: IniSection) -> tuple[MessageField, ...]:
        """The fields of a section, without those that are invalid."""
        reader = SectionReader(section, (), self._report)
        count = reader.number("num_fields")
        self._report_other_keys(section, count)
        self._path.append(section)
        fields = [self._field(section, number) for number in range(1, (count or 0) + 1)]
        self._path.pop()
        return tuple(field for field in fields if field is not None)

    def _report_other_keys(self, section: IniSection, count: int | None) -> None:
        for name, entry in section.entries.items():
            found = _KEY.fullmatch(name)
            if name == "num_fields":
                continue
            if found is None:
                self._report.add(
                    codes.INVALID_LINE,
                    entry.key_span,
                    f"`[{section.name}]` has no key `{name}`",
                    label=did_you_mean(name, ("num_fields", "1_type", "1_msg", "1_mux")),
                    help="its keys are `num_fields`, and `N_type`, `N_msg`, `N_mux` of field N",
                )
            elif count is not None and not 1 <= int(found[1][:9]) <= count:
                self._report.add(
                    codes.COUNT_MISMATCH,
                    entry.key_span,
                    f"`{name}` is not read: num_fields is {count}",
                    notes=(Note(section.entries["num_fields"].span, "it is stated here"),),
                    help="correct num_fields, or delete the line",
                )

    def _field(self, section: IniSection, number: int) -> MessageField | None:
        entry = section.entries.get(f"{number}_type")
        if entry is None:
            self._report.add(
                codes.MISSING_KEY,
                section.entries["num_fields"].span,
                f"`{number}_type` is missing in `[{section.name}]`",
                help="number the fields from 1 without a gap, and correct num_fields",
            )
            return None
        if entry.text not in TYPES:
            self._report.add(
                codes.INVALID_FIELD,
                entry.span if entry.text else entry.key_span,
                f"there is no type of field `{entry.text:.40}`",
                label=did_you_mean(entry.text, TYPES),
                help=f"the types are {join_names(TYPES)}; the values of an input are a `mux`",
            )
            return None
        self._report_unused_key(section, number, entry)
        match entry.text:
            case "counter":
                return CounterField(entry.span)
            case "timestamp":
                return self._time(entry)
        key = f"{number}_{_USED_KEYS[entry.text]}"
        value = section.entries.get(key)
        if value is None:
            self._report.add(
                codes.MISSING_KEY,
                entry.span,
                f"`{key}` is missing: the field has the type `{entry.text}`",
                help=f"add `{key} = …`",
            )
            return None
        return self._valued(entry, value)

    def _report_unused_key(self, section: IniSection, number: int, entry: IniValue) -> None:
        for name in ("msg", "mux"):
            other = section.entries.get(f"{number}_{name}")
            if other is not None and _USED_KEYS.get(entry.text) != name:
                self._report.add(
                    codes.INVALID_FIELD,
                    other.key_span,
                    f"a field of type `{entry.text}` has no `{number}_{name}`",
                    notes=(Note(entry.span, "its type is stated here"),),
                    help="delete the line, or correct the type",
                )

    def _time(self, entry: IniValue) -> TimeField:
        field = TimeField(entry.span)
        if self._timestamp is not None and self._to_ros:
            self._report.add(
                codes.INVALID_FIELD,
                entry.span,
                "a message for ROS has one timestamp",
                notes=(Note(self._timestamp.span, "the first one is here"),),
                help="in BDSL, `now` may be used as often as you like",
            )
        self._timestamp = self._timestamp or field
        return field

    def _valued(self, entry: IniValue, value: IniValue) -> MessageField | None:
        match entry.text:
            case "single_value":
                constant = read_constant(value, self._report)
                return ConstantField(constant, constant.span) if constant else None
            case "list":
                constants = read_constants(value, self._report)
                span = value.span if value.text else value.key_span
                return None if constants is None else ListField(constants, span)
            case "mux":
                return self._mux(value)
            case _:
                return self._nested(value)

    def _mux(self, value: IniValue) -> MuxField | None:
        found = re.fullmatch(r"mux(\d{1,9})", value.text)
        names = [f"mux{number}" for number in sorted(self._muxes)]
        if found is None or int(found[1]) not in self._muxes:
            self._report.add(
                codes.INVALID_FIELD,
                value.span if value.text else value.key_span,
                f"there is no section `[{value.text:.40}]`",
                label=did_you_mean(value.text, names),
                help=f"the inputs are in {join_names(names)}" if names else "",
            )
            return None
        if not self._to_ros and len(self._path) > 1:
            self._report.add(
                codes.INVALID_FIELD,
                value.span,
                "a nested message for YARP has no `mux`",
                help="put it into `[message]`, or write the bridge in BDSL",
            )
            return None
        return MuxField(int(found[1]), value.span)

    def _nested(self, value: IniValue) -> NestedField | None:
        section = self._sections.get(value.text)
        problem, help_ = "", ""
        if _RESERVED.fullmatch(value.text):
            problem = f"`[{value.text}]` is no nested message"
            help_ = "give the nested message a name of its own"
        elif section is None:
            problem = f"there is no section `[{value.text:.40}]`"
            help_ = "add it with `num_fields` and its fields"
        elif section in self._path:
            problem = f"`[{value.text}]` contains itself"
            help_ = "a message contains only other messages"
        if problem or section is None:
            span = value.span if value.text else value.key_span
            known = [name for name in self._sections if not _RESERVED.fullmatch(name)]
            label = did_you_mean(value.text, known) if section is None else ""
            self._report.add(codes.INVALID_FIELD, span, problem, label=label, help=help_)
            return None
        self.used.add(section.name)
        return NestedField(section.name, self.read(section), value.span)
