"""The parameters as old workers read them.

In: the parameters of the component, the table of old keys. Out: `params` of `setParams`: strings by
dotted key, or tables of typed values as in TOML.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from robocomp_dsl.runtime.parameters import Parameters

Setting: TypeAlias = tuple[tuple[str, ...], str, bool, dict[Any, str]]
"""Old key, path of the parameter, whether it is a list, values that the old file spelled otherwise:
`1.50`, `TRUE`."""


def old_settings(
    params: Parameters, settings: tuple[Setting, ...], *, tables: bool
) -> dict[str, Any]:
    """The values of `params` with the old keys."""
    values = params.values()
    result: dict[str, Any] = {}
    for key, path, listed, texts in settings:
        value: Any = values.get(path)
        if listed and value is None:  # migrated when PDSL had lists of groups only
            value = [v for name, v in values.items() if name.startswith(f"{path}[")]
        if not tables:
            result[".".join(key)] = _text(value, texts)
            continue
        table = result
        for part in key[:-1]:
            table = table.setdefault(part, {})
        table[key[-1]] = value
    return result


def _text(value: Any, texts: dict[Any, str]) -> str:
    """The text of a value; with the spelling of the old file, unless the value was changed."""
    if texts and not isinstance(value, list) and value in texts:
        return texts[value]
    if isinstance(value, bool):
        return str(value).lower()
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)
