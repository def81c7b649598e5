"""Names that the interface generators of ROS 2 accept (rosidl, "Interface definition", naming).

In: names of IDSL. Out: packages and members as `lower_snake`, messages and services as `CamelCase`,
constants as `UPPER_SNAKE`; keywords of C++ and Python get a suffix.
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
RESERVED_WORDS = frozenset((*_CPP.split(), *(word.lower() for word in keyword.kwlist), "self"))
"""Keywords that are not valid members in generated code."""

MACROS = frozenset(("EOF", "FALSE", "INFINITY", "NAN", "NULL", "TRUE"))
"""Invalid constants: macros of the C preprocessor."""


def split_words(name: str) -> list[str]:
    """`getLaserHTTPData2` as get, laser, http, data2; a run of capitals is one word."""
    whole = name.replace("RoboComp", "Robocomp")
    spaced = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", whole)
    return [word.lower() for word in spaced.split("_") if word]


def package_name(name: str) -> str:
    """`name` as the name of a package."""
    joined = "_".join(split_words(name)) or "n"
    return f"n{joined}" if joined[0].isdigit() else joined


def member_name(name: str) -> str:
    """`name` as a member of a message."""
    snake = package_name(name)
    return f"{snake}_value" if snake in RESERVED_WORDS else snake


def constant_name(name: str) -> str:
    """`name` as a constant."""
    upper = package_name(name).upper()
    return f"{upper}_VALUE" if upper in MACROS else upper


def message_name(name: str) -> str:
    """`name` as a message or a service. Capitals and digits are unchanged."""
    joined = "".join(part[0].upper() + part[1:] for part in name.split("_") if part) or "N"
    valid = f"N{joined}" if joined[0].isdigit() else joined
    # ROS tools take `Header` for the type of std_msgs, as in ROS 1.
    return "HeaderData" if valid == "Header" else valid


def fold_name(name: str) -> str:
    """A key that is equal for names whose files or C++ headers would be the same."""
    return name.replace("_", "").lower()
