"""Templates filled in. In: a template's name and its context. Out: the text of a file.

A name that the context lacks is a mistake of ours and raises. HTML and SVG are escaped; in other
texts nothing is, because the context holds finished source texts (see `literals.py`). Compiled
templates are kept in the user's cache folder, as compiled modules are by Python, because compiling
takes longer than all the rest.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import BytecodeCache, Environment, FileSystemLoader, StrictUndefined, select_autoescape
from jinja2.bccache import Bucket

from robocomp_dsl.generate.python.line_breaking import break_lines
from robocomp_dsl.resources import TEMPLATES

MARKED_UP = ("html.jinja", "svg.jinja")
"""Templates whose context is escaped."""


def cache_folder() -> Path:
    """Where compiled templates are kept (XDG Base Directory Specification)."""
    configured = os.environ.get("XDG_CACHE_HOME")
    try:
        home = Path(configured) if configured else Path.home() / ".cache"
    except RuntimeError:  # a user without a home
        home = Path(os.devnull)
    return home / "robocomp_dsl" / "templates"


class _FileCache(BytecodeCache):
    """Compiled templates in files; what cannot be read or written is compiled again each time.

    Jinja2 itself checks that a file was made from the same source by the same version.
    """

    def load_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError), (cache_folder() / bucket.key).open("rb") as stream:
            bucket.load_bytecode(stream)

    def dump_bytecode(self, bucket: Bucket) -> None:
        if sys.dont_write_bytecode:
            return
        path = cache_folder() / bucket.key
        temporary = path.with_suffix(f".{os.getpid()}")
        with suppress(OSError):
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            try:
                with temporary.open("wb") as stream:
                    bucket.write_bytecode(stream)
                temporary.replace(path)
            finally:
                temporary.unlink(missing_ok=True)


@cache
def _environment() -> Environment:
    return Environment(
        autoescape=select_autoescape(MARKED_UP, default_for_string=False),
        loader=FileSystemLoader(TEMPLATES),
        bytecode_cache=_FileCache(),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        auto_reload=False,
    )


def render(template: str, **context: Any) -> str:
    """The text of `templates/<template>`; Python with its long lines broken."""
    text = _environment().get_template(template).render(context)
    return break_lines(text) if template.endswith(".py.jinja") else text
