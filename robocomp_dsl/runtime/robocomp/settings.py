"""The parameters as old workers read them.

In: the parameters of the component, the table of old keys. Out: `params` of `setParams`: strings by
dotted key, or tables of typed values as in TOML.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from robocomp_dsl.runtime.parameters import Parameters

Setting: TypeAlias = tuple[tuple[str, ...], str, bool, tuple[str, str]]
"""Old key, path of the parameter, whether it is a list, the old spelling of true and false."""


def old_settings(
    params: Parameters, settings: tuple[Setting, ...], *, tables: bool
) -> dict[str, Any]:
    """The values of `params` with the old keys."""
    values = params.values()
    result: dict[str, Any] = {}
    for key, path, listed, texts in settings:
        value: Any = values.get(path)
        if listed:
            value = [v for name, v in values.items() if name.startswith(f"{path}[")]
        if not tables:
            result[".".join(key)] = _text(value, texts)
            continue
        table = result
        for part in key[:-1]:
            table = table.setdefault(part, {})
        table[key[-1]] = value
    return result


def _text(value: object, texts: tuple[str, str]) -> str:
    if isinstance(value, bool):
        return texts[0] if value else texts[1]
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)
