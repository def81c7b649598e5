"""Reads the keys of one section: required values, flags, numbers; reports the others."""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.literals import join_names
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.ini_file import IniSection, IniValue

_FLAGS = {"true": True, "1": True, "false": False, "0": False}
_MAX_COUNT = 10_000


class SectionReader:
    """The values of a section; a key that is not in `keys` is reported. `keys` empty: any."""

    def __init__(self, section: IniSection, keys: Sequence[str], report: Report) -> None:
        self.section = section
        self._report = report
        for name, entry in section.entries.items():
            if keys and name not in keys:
                report.add(
                    codes.INVALID_LINE,
                    entry.key_span,
                    f"`[{section.name}]` has no key `{name}`",
                    label=did_you_mean(name, keys),
                    help=f"its keys are {join_names(keys)}",
                )

    def required(self, key: str) -> IniValue | None:
        """The value of `key`; None, with a finding, if it is missing or empty."""
        entry = self.section.entries.get(key)
        if entry is None:
            self._report.add(
                codes.MISSING_KEY,
                self.section.span,
                f"`{key}` is missing in `[{self.section.name}]`",
                help=f"add `{key} = …`",
            )
        elif not entry.text:
            message = f"`{key}` has no value"
            self._report.add(codes.MISSING_KEY, entry.key_span, message)
            return None
        return entry

    def flag(self, key: str) -> bool | None:
        """The value of an optional flag."""
        entry = self.section.entries.get(key)
        if entry is None:
            return None
        if entry.text not in _FLAGS:
            self.not_one_of(entry, key, tuple(_FLAGS))
        return _FLAGS.get(entry.text)

    def number(self, key: str) -> int | None:
        """The value of a required count, from 1."""
        entry = self.required(key)
        if entry is None:
            return None
        text = entry.text
        if not (text.isascii() and text.isdigit() and 1 <= int(text[:9]) <= _MAX_COUNT):
            self._report.add(
                codes.INVALID_VALUE,
                entry.span,
                f"`{text:.40}` is no number for {key}",
                help=f"write a whole number from 1 to {_MAX_COUNT}",
            )
            return None
        return int(text)

    def not_one_of(self, entry: IniValue, key: str, known: Sequence[str]) -> None:
        """Report a value that is none of the known ones."""
        self._report.add(
            codes.INVALID_VALUE,
            entry.span if entry.text else entry.key_span,
            f"`{key}` is `{entry.text:.40}`",
            label=did_you_mean(entry.text, known),
            help=f"it is one of {join_names(known)}",
        )
