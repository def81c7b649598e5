"""Plain data as YAML, JSON lines and CSV. In: dicts, lists and scalars. Out: text.

YAML is written here: this takes a fraction of the time of loading a YAML library.
"""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Iterator
from typing import Any

MAX_ITEMS = 32
"""Longer lists are shortened in texts."""
_PLAIN = re.compile(r"[A-Za-z_/](?:[A-Za-z0-9_/.:-]*[A-Za-z0-9_/.-])?(?: [A-Za-z0-9_/.()-]+)*")
_WORDS = frozenset(("true", "false", "yes", "no", "on", "off", "null"))


def to_yaml(value: Any, *, full: bool = True) -> str:
    """`value` as a YAML document without a final newline. `full`: lists of any length."""
    return "\n".join(_yaml(value, full))


def _yaml(value: Any, full: bool) -> Iterator[str]:
    if isinstance(value, dict) and value:
        for key, item in value.items():
            yield from _entry(f"{_scalar(key)}:", item, full)
    elif isinstance(value, list) and any(isinstance(item, dict | list) for item in value):
        for item in value if full else value[:MAX_ITEMS]:
            lines = list(_yaml(item, full))
            yield f"- {lines[0]}"
            yield from (f"  {line}" for line in lines[1:])
        if not full and len(value) > MAX_ITEMS:
            yield f"# {len(value) - MAX_ITEMS} more; --full shows all"
    else:
        yield _inline(value, full)


def _entry(head: str, item: Any, full: bool) -> Iterator[str]:
    is_block = isinstance(item, list) and any(isinstance(each, dict | list) for each in item)
    if is_block or (isinstance(item, dict) and item):
        yield head
        yield from (f"  {line}" for line in _yaml(item, full))
    else:
        yield f"{head} {_inline(item, full)}"


def _inline(value: Any, full: bool) -> str:
    if isinstance(value, list):
        items = [_scalar(item) for item in (value if full else value[:MAX_ITEMS])]
        more = len(value) - len(items)
        return f"[{', '.join(items)}]" + (f"  # {more} more; --full shows all" if more else "")
    return "{}" if isinstance(value, dict) else _scalar(value)


def _scalar(value: Any) -> str:
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        if not math.isfinite(value):
            return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"
        return repr(value)
    if isinstance(value, str):
        is_plain = _PLAIN.fullmatch(value) and value.lower() not in _WORDS
        return value if is_plain else json.dumps(value)
    return str(value)


def to_json(value: Any) -> str:
    """`value` on one line. JSON has no NaN and no infinity: they are null."""
    try:
        return json.dumps(value, allow_nan=False)
    except ValueError:
        return json.dumps(_without_nan(value))


def _without_nan(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


class CsvWriter:
    """CSV with a column for each number or text of the first message."""

    def __init__(self) -> None:
        self._columns: list[str] = []

    def rows(self, value: Any) -> str:
        """The row of `value`, behind the header if it is the first. Absent values are empty."""
        cells = dict(_flatten("", value))
        buffer = io.StringIO()
        writer = csv.writer(buffer, lineterminator="\n")
        if not self._columns:
            self._columns = list(cells)
            writer.writerow(self._columns)
        writer.writerow([cells.get(column, "") for column in self._columns])
        return buffer.getvalue()


def _flatten(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _flatten(f"{path}.{key}" if path else str(key), item)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _flatten(f"{path}[{index}]", item)
    elif isinstance(value, bool):
        yield path or "value", "true" if value else "false"
    else:
        yield path or "value", value
