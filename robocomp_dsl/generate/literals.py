"""Quote user text for source files, so that no comment, default or name can become code.

In: any text. Out: Python, YAML or Markdown that represents exactly this text; non-printable
characters (control, direction and line separator characters) are escaped.
"""

from __future__ import annotations

import math
import re
import textwrap
from collections.abc import Iterable, Iterator
from itertools import groupby

from robocomp_dsl.generate.python.layout import WIDTH
from robocomp_dsl.model.interface import Param
from robocomp_dsl.model.types import Field, Literal

_YAML_WORDS = {"", "~", "null", "true", "false", "yes", "no", "on", "off", "y", "n"}
_YAML_PLAIN = re.compile(r"[A-Za-z_/][A-Za-z0-9_./-]*")

_ITEM = re.compile(r" *([-*+|>#]|\d+[.)]) ")
"""A line that starts a list item or a block."""


def _escaped(character: str) -> str:
    code = ord(character)
    if code < 0x100:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def printable(text: str) -> str:
    """`text` with non-printable characters escaped, including tabs and newlines."""
    return "".join(c if c.isprintable() else _escaped(c) for c in text)


def quoted(text: str) -> str:
    """`text` in double quotes; valid in Python and in YAML, in ruff's format."""
    inner = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t")
    return f'"{printable(inner)}"'


def python_string(text: str) -> str:
    """`text` as a Python literal with the quotes that need fewer escapes, in ruff's format."""
    if text.count('"') <= text.count("'"):
        return quoted(text)
    inner = text.replace("\\", "\\\\").replace("'", "\\'")
    inner = inner.replace("\n", "\\n").replace("\t", "\\t")
    return f"'{printable(inner)}'"


def python_value(value: Literal) -> str:
    """A default as a Python literal."""
    if isinstance(value, str):
        return python_string(value)
    if isinstance(value, float) and not math.isfinite(value):
        return f'float("{value}")'
    return repr(value)


def yaml_value(value: Literal | tuple[Literal, ...]) -> str:
    """A default as YAML with the same value in YAML 1.1 and 1.2; a list in brackets."""
    match value:
        case tuple():
            return f"[{', '.join(map(yaml_value, value))}]"
        case bool():
            return str(value).lower()
        case float() if not math.isfinite(value):
            return {"inf": ".inf", "-inf": "-.inf"}.get(str(value), ".nan")
        case float():
            mantissa, _, exponent = repr(value).partition("e")
            point = "" if "." in mantissa or not exponent else ".0"
            return f"{mantissa}{point}{exponent and 'e' + exponent}"
        case int():
            return str(value)
    return quoted(value)


def yaml_key(name: str) -> str:
    """`name` as a key, quoted if a parser might read it as a boolean or null."""
    plain = _YAML_PLAIN.fullmatch(name) and name.lower() not in _YAML_WORDS
    return name if plain else quoted(name)


def unit_table(members: Iterable[Field | Param]) -> str:
    """`{"name": "unit"}` of those that have a unit, or an empty string."""
    rows = [f"{quoted(m.name)}: {quoted(m.unit)}" for m in members if m.unit]
    return f"{{{', '.join(rows)}}}" if rows else ""


def lines(text: str) -> list[str]:
    """The lines of a doc comment: dedented, ends trimmed, tabs expanded, everything printable."""
    # Only these newlines: other separators of splitlines() are escaped.
    raw = re.sub(r"\r\n?", "\n", text).expandtabs(4)
    first, _, rest = raw.strip().partition("\n")
    cleaned = [printable(line.rstrip()) for line in (first, *textwrap.dedent(rest).split("\n"))]
    while cleaned and not cleaned[-1]:
        cleaned.pop()
    return cleaned


def sentence(text: str) -> str:
    """The first line of a doc comment; empty for none."""
    return (lines(text) or [""])[0]


def docstring(text: str, indent: str, instead: str = "") -> str:
    """`text`, or `instead` if it is empty, as a docstring that the formatter does not change.

    The first indentation is omitted. `inspect.getdoc` of it returns `lines(text)`, with lines
    longer than `WIDTH` wrapped.
    """
    rows = lines(text) or lines(instead) or [""]
    width = WIDTH - len(indent) - len('"""')
    if len(rows) > 1 or len(rows[0]) + len('"""') > width:
        rows = list(_reflowed(rows, width))
    single = len(rows) == 1
    first = _docstring_row(rows[0], opens=True, closes=single)
    if single:
        return f'"""{first}"""'
    rest = [_docstring_row(row) for row in rows[1:]]
    body = "".join(f"{indent}{row}\n" if row else "\n" for row in rest)
    return f'"""{first}\n{body}{indent}"""'


def _reflowed(rows: list[str], width: int) -> Iterator[str]:
    """`rows` with each paragraph that has a longer line rewrapped; lists keep their lines."""
    for _, grouped in groupby(rows, key=lambda row: len(row) - len(row.lstrip(" ")) if row else -1):
        paragraph = list(grouped)
        is_text = not any(_ITEM.match(row) for row in paragraph)
        if is_text and any(len(row) > width for row in paragraph):
            first, *others = paragraph
            paragraph = [" ".join([first, *(row.lstrip(" ") for row in others)])]
        yield from (part for row in paragraph for part in wrapped(row, width))


def _docstring_row(row: str, *, opens: bool = False, closes: bool = False) -> str:
    """One line, with escapes for backslashes and for the quotes that could end the docstring."""
    risky = {i for run in re.finditer('"{3,}', row) for i in range(*run.span())}
    risky |= {0} if opens else set()
    risky |= {len(row) - 1} if closes else set()
    escapes = {"\\": "\\\\"}
    return "".join(
        '\\"' if c == '"' and i in risky else escapes.get(c, c) for i, c in enumerate(row)
    )


def comment(text: str, indent: str = "") -> list[str]:
    """`text` as comment lines for Python and YAML, without empty lines."""
    return [f"{indent}# {row}" for row in lines(text) if row]


def wrapped(row: str, width: int, hang: str = "") -> list[str]:
    """A line of text as lines of at most `width` characters, as far as its words permit.

    Continuation lines are indented by `hang` more than the first one.
    """
    text = row.lstrip(" ")
    indent = row[: len(row) - len(text)]
    if len(row) <= width:
        return [row]
    return textwrap.wrap(
        text,
        width,
        initial_indent=indent,
        subsequent_indent=indent + hang,
        break_long_words=False,
        break_on_hyphens=False,
    )


def markdown_cell(text: str) -> str:
    """`text` for one cell of a Markdown table."""
    flat = " ".join(lines(text))
    return re.sub(r"([\\|<>`*_\[\]{}])", r"\\\1", flat)


def markdown_code(text: str) -> str:
    """`text` as code in one cell of a Markdown table; empty for an empty text."""
    fence = "``" if "`" in text else "`"
    space = " " if "`" in text else ""
    inner = printable(text).replace("|", "\\|")
    return f"{fence}{space}{inner}{space}{fence}" if text else ""
