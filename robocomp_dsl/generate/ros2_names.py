"""Names as the interface generators of ROS 2 take them (rosidl, "Interface definition", naming).

In: names of IDSL. Out: packages and members as `lower_snake`, messages and services as `CamelCase`,
constants as `UPPER_SNAKE`; words of C++ and Python get an end, since members of theirs are made.
"""

from __future__ import annotations

import keyword
import re

_CPP = """alignas alignof and and_eq asm auto bitand bitor bool break case catch char class compl
concept const consteval constexpr constinit continue co_await co_return co_yield
decltype default delete do double else enum explicit export extern false float for
friend goto if inline int long mutable namespace new noexcept not not_eq nullptr
operator or or_eq private protected public register requires return short signed sizeof
static struct switch template this throw true try typedef typeid typename union unsigned
using virtual void volatile wchar_t while xor xor_eq"""
WORDS = frozenset((*_CPP.split(), *(word.lower() for word in keyword.kwlist), "self"))
"""What no member may be called in the code that is made from a message."""

MACROS = frozenset(("EOF", "FALSE", "INFINITY", "NAN", "NULL", "TRUE"))
"""What no constant may be called: the preprocessor of C would replace it."""


def words(name: str) -> list[str]:
    """`getLaserHTTPData2` as get, laser, http, data2; a run of capitals is one word."""
    whole = name.replace("RoboComp", "Robocomp")
    spaced = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", whole)
    return [word.lower() for word in spaced.split("_") if word]


def snake(name: str) -> str:
    """`name` as the name of a package."""
    joined = "_".join(words(name)) or "n"
    return f"n{joined}" if joined[0].isdigit() else joined


def member(name: str) -> str:
    """`name` as a member of a message."""
    found = snake(name)
    return f"{found}_value" if found in WORDS else found


def constant(name: str) -> str:
    """`name` as a constant."""
    found = snake(name).upper()
    return f"{found}_VALUE" if found in MACROS else found


def camel(name: str) -> str:
    """`name` as a message or a service. What is in capitals or has digits stays so."""
    joined = "".join(part[0].upper() + part[1:] for part in name.split("_") if part) or "N"
    found = f"N{joined}" if joined[0].isdigit() else joined
    # A `Header` is taken for that of std_msgs, as in ROS 1.
    return "HeaderData" if found == "Header" else found


def folded(name: str) -> str:
    """The same for names whose files would be the same on some system, or in C++ headers."""
    return name.replace("_", "").lower()
