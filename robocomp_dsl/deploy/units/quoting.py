"""Writes values into unit files so that systemd reads them back unchanged. Pure.

systemd.syntax(7), systemd.service(5): words are separated by space, C escapes hold within quotes,
`%` begins a specifier, and `$` in a command line a variable.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

_SAFE = re.compile(r"[A-Za-z0-9_@%+=:,./-]+")
_UNESCAPED = re.compile(r"[A-Za-z0-9_@+=:,./ -]*")
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")
_ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "%": "%%"}
_ENVIRONMENT_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_PATH_CHARACTER = r"[A-Za-z0-9_.\-]"


class UnitValueError(Exception):
    """systemd cannot hold the value; the message says why."""


@dataclass(frozen=True, slots=True)
class PathMap:
    """Where local files and folders are on a host.

    `pairs`: a local absolute path, and the path on the host as in a unit file (`%h/…`). Of nested
    folders the innermost counts.
    """

    pairs: tuple[tuple[str, str], ...] = ()

    def split(self, text: str) -> Iterable[tuple[str, str]]:
        """`text` in parts: literal text and the path on the host that follows it, or ""."""
        table = dict(self.pairs)
        if not table:
            return [(text, "")]
        names = "|".join(re.escape(name) for name in sorted(table, key=len, reverse=True))
        found = re.compile(rf"(?<![A-Za-z0-9_./\-])({names})(?!{_PATH_CHARACTER})")
        parts = found.split(text)
        literals, paths = parts[::2], [*(table[name] for name in parts[1::2]), ""]
        return list(zip(literals, paths, strict=True))


NO_PATHS = PathMap()


def argument(text: str, paths: PathMap = NO_PATHS) -> str:
    """One word of a command line."""
    return _word(text, paths, variables=True)


def command_line(words: Iterable[str], paths: PathMap = NO_PATHS) -> str:
    """The words of a command line, the first of which is an absolute path."""
    return " ".join(argument(word, paths) for word in words)


def assignment(name: str, value: str, paths: PathMap = NO_PATHS) -> str:
    """`NAME=VALUE` for `Environment=`. Raises `UnitValueError`."""
    if not _ENVIRONMENT_NAME.fullmatch(name):
        raise UnitValueError(f"`{name}` is not a name of an environment variable")
    if control := _CONTROL.search(value):
        raise UnitValueError(
            f"the value of `{name}` contains the control character U+{ord(control[0]):04X}"
        )
    return _word(f"{name}={value}", paths, variables=False)


def path(text: str, paths: PathMap = NO_PATHS) -> str:
    """The value of a setting that is one path. Raises `UnitValueError`."""
    if any(ord(character) < 0x20 for character in text):
        raise UnitValueError(f"the path {text!r} contains a control character")
    _check_text(text)
    if text != text.strip() or text.endswith("\\"):
        raise UnitValueError(f"the path {text!r} begins or ends with a space or a backslash")
    return "".join(literal.replace("%", "%%") + to for literal, to in paths.split(text))


def _word(text: str, paths: PathMap, *, variables: bool) -> str:
    _check_text(text)
    word = "".join(_escape(literal, variables=variables) + to for literal, to in paths.split(text))
    return word if _SAFE.fullmatch(word) else f'"{word}"'


def _escape(text: str, *, variables: bool) -> str:
    if _UNESCAPED.fullmatch(text):
        return text
    return "".join(_escape_character(character, variables=variables) for character in text)


def _escape_character(character: str, *, variables: bool) -> str:
    if character == "$":
        return "$$" if variables else "$"
    if escaped := _ESCAPES.get(character):
        return escaped
    code = ord(character)
    return f"\\x{code:02x}" if code < 0x20 or code == 0x7F else character


def _check_text(text: str) -> None:
    if "\0" in text:
        raise UnitValueError(f"{text!r} contains a zero byte")
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        raise UnitValueError(f"{text!r} is not valid UTF-8") from None
