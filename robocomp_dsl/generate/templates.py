"""Templates filled in. In: a template's name and its context. Out: the text of a file.

A name that the context lacks is a mistake of ours and raises; nothing is escaped here, because the
context holds finished source texts (see `literals.py`).
"""

from __future__ import annotations

from functools import cache
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from robocomp_dsl.resources import TEMPLATES


@cache
def _environment() -> Environment:
    return Environment(  # noqa: S701 - it writes Python and YAML, not HTML
        loader=FileSystemLoader(TEMPLATES),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        auto_reload=False,
    )


def render(template: str, **context: Any) -> str:
    """The text of `templates/<template>`."""
    return _environment().get_template(template).render(context)
