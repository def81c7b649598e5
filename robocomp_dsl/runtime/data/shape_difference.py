"""How the shapes of an operation on two sides differ, for the message of `InterfaceMismatch`.

In: two shapes of `type_hash.operation_shape`, which may come from a peer. Out: a text that names
the parameter or field, with both types.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import zip_longest

_HEAD = re.compile(r"(\w+) (\w+)\(")
_WORD = re.compile(r"\w*")
_UNIT = re.compile(r"\[([^\[\]]*)\]")
_OPENING, _CLOSING = "({<", ")}>"
_SHOWN = 60


@dataclass(frozen=True, slots=True)
class ShapeMember:
    """A parameter or field: name, type without unit, unit."""

    name: str
    type: str
    unit: str = ""

    @property
    def text(self) -> str:
        """Its type with the unit, cut if it is long."""
        text = _readable(self.type)
        return f"{text} [{self.unit}]" if self.unit else text


def describe_difference(here: str, there: str) -> str:
    """What differs in the shape `there` of a peer from the own one `here`; "" if nothing does."""
    if here == there:
        return ""
    try:
        return next(_differences(here, there), "its types differ")
    except (ValueError, IndexError):  # a peer may send anything
        return "its types differ"


def _differences(here: str, there: str) -> Iterator[str]:
    own, other = _parts(here), _parts(there)
    if own[0] != other[0]:
        yield f"it is a {own[0]} here, but a {other[0]} there"
    for what, mine, theirs in (("input", own[1], other[1]), ("output", own[2], other[2])):
        yield from _members(mine, theirs, f"the {what} ", "")
    yield from _throws(own[3], other[3])


def _parts(shape: str) -> tuple[str, list[ShapeMember], list[ShapeMember], list[str]]:
    """Pattern, inputs, outputs and exceptions."""
    head = _HEAD.match(shape)
    if head is None:
        raise ValueError(shape)
    inputs, rest = _inside(shape, head.end() - 1)
    outputs, rest = _inside(shape, rest + len("->"))
    throws, _ = _inside(shape, rest + len(" throws"))
    return head[1], _read_members(inputs), _read_members(outputs), list(_split(throws))


def _inside(text: str, start: int) -> tuple[str, int]:
    """The text in the brackets that open at `start`, and the index after them."""
    depth = 0
    for index in range(start, len(text)):
        depth += text[index] in _OPENING
        depth -= text[index] in _CLOSING and text[index - 1 : index + 1] != "->"
        if depth == 0:
            return text[start + 1 : index], index + 1
    raise ValueError(text)


def _split(text: str) -> Iterator[str]:
    """The parts between commas that are in no brackets."""
    depth = start = 0
    for index, character in enumerate(text):
        depth += character in _OPENING
        depth -= character in _CLOSING
        if character == "," and not depth:
            yield text[start:index]
            start = index + 1
    if text:
        yield text[start:]


def _read_members(text: str) -> list[ShapeMember]:
    members = []
    for part in _split(text):
        name, _, type_ = part.partition(":")
        unit = _UNIT.search(type_[_end_of_type(type_) :])
        members.append(ShapeMember(name, type_[: _end_of_type(type_)], unit[1] if unit else ""))
    return members


def _end_of_type(text: str) -> int:
    """The index after a type, before its unit."""
    word = _WORD.match(text)
    end = word.end() if word else 0
    return _inside(text, end)[1] if text[end : end + 1] in ("{", "<") else end


def _members(
    here: list[ShapeMember], there: list[ShapeMember], kind: str, inside: str
) -> Iterator[str]:
    """How lists of parameters or fields differ; `inside` is the path of the struct."""
    what = "" if inside else kind
    where = f" of `{inside}`" if inside else ""
    own, other = [m.name for m in here], [m.name for m in there]
    for member in there:
        if member.name not in own:
            place = _neighbours(other, member.name)
            yield f"{what}`{member.name}`{where} (`{member.text}`) is new there{place}"
    for member in here:
        if member.name not in other:
            place = _neighbours(own, member.name)
            yield f"{what}`{member.name}`{where} (`{member.text}`) is missing there{place}"
    if own != other:
        orders = f"{_list(own)} here, {_list(other)} there"
        yield f"the order of {kind.strip()}s{where} differs: {orders}"
    for mine, theirs in zip(here, there, strict=True):
        path = f"{inside}.{mine.name}" if inside else mine.name or "the result"
        yield from _types(mine, theirs, kind, path)


def _types(here: ShapeMember, there: ShapeMember, kind: str, path: str) -> Iterator[str]:
    if here.type != there.type:
        words = [_WORD.match(m.type) for m in (here, there)]
        if all(word and word[0] == "struct" for word in words):
            yield from _members(
                _read_members(_inside(here.type, len("struct"))[0]),
                _read_members(_inside(there.type, len("struct"))[0]),
                "field ",
                path,
            )
        elif all(word and word[0] == "sequence" for word in words):
            mine, theirs = (
                list(_split(_inside(m.type, len("sequence"))[0])) for m in (here, there)
            )
            if mine[1:] == theirs[1:]:
                yield from _types(
                    ShapeMember("", mine[0]), ShapeMember("", theirs[0]), kind, f"{path}[]"
                )
        elif all(word and word[0] == "enum" for word in words):
            yield from _enumerators(here.type, there.type, path)
        yield f"`{path}` is `{here.text}` here, but `{there.text}` there"
    if here.unit != there.unit:
        units = [f"in {m.unit}" if m.unit else "without unit" for m in (here, there)]
        yield f"`{path}` is {units[0]} here, but {units[1]} there"


def _enumerators(here: str, there: str, path: str) -> Iterator[str]:
    own, other = (_values(text) for text in (here, there))
    for name in other:
        if name not in own:
            yield f"the value `{name}` of `{path}` is new there{_neighbours(list(other), name)}"
    for name, value in own.items():
        if name not in other:
            yield f"the value `{name}` of `{path}` is missing there{_neighbours(list(own), name)}"
        elif other[name] != value:
            yield f"the value `{name}` of `{path}` is {value} here, but {other[name]} there"


def _values(enum: str) -> Mapping[str, str]:
    return dict(part.split("=") for part in _split(_inside(enum, len("enum"))[0]))


def _throws(here: list[str], there: list[str]) -> Iterator[str]:
    for number, (mine, theirs) in enumerate(zip_longest(here, there), 1):
        if mine is None or theirs is None:
            yield f"it throws {len(here)} exceptions here, but {len(there)} there"
        elif mine != theirs:
            yield from _types(
                ShapeMember("", mine), ShapeMember("", theirs), "field ", f"exception {number}"
            )


def _neighbours(names: list[str], name: str) -> str:
    """Between which names of a list one stands."""
    at = names.index(name)
    before, after = names[at - 1 : at] if at else [], names[at + 1 : at + 2]
    if before and after:
        return f" between `{before[0]}` and `{after[0]}`"
    return f" after `{before[0]}`" if before else f" before `{after[0]}`" if after else ""


def _list(names: list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _readable(type_: str) -> str:
    """A type as users write it, as far as it is in the shape."""
    word = _WORD.match(type_)
    name = word[0] if word else ""
    rest = type_[len(name) :]
    if name == "array":
        element, _, size = _inside(rest, 0)[0].rpartition(",")
        return f"{_readable(element)}[{size}]"
    if name in ("sequence", "dictionary"):
        parts = (_readable(part) for part in _split(_inside(rest, 0)[0]))
        return f"{name}<{', '.join(parts)}>"
    if name in ("struct", "enum") and len(type_) > _SHOWN:
        return f"{name} {{{_inside(rest, 0)[0][:_SHOWN]}…}}"
    return _WRITTEN.get(name, name) + rest


_WRITTEN = {"uint16": "unsigned short", "uint32": "unsigned int", "uint64": "unsigned long"}
