"""The middlewares that descriptions may name.

In: names as written. Out: names and descriptions of the registry of the runtime. Built-in names are
known without loading anything; those of other distributions are looked up only if a name is not
built in, because that takes long.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robocomp_dsl.runtime.middleware.capabilities import MiddlewareDescription


class KnownMiddlewares:
    """The middlewares of the registry; `further` middlewares are known, too."""

    def __init__(self, further: Sequence[MiddlewareDescription] = ()) -> None:
        self._further = {description.name: description for description in further}
        self._found: dict[str, str | None] = {}

    def find(self, written: str) -> str | None:
        """The name of a middleware, which may be written in any case; None if it is unknown."""
        if written not in self._found:
            from robocomp_dsl.runtime.middleware.registry import BUILT_IN  # noqa: PLC0415 - on first use

            built_in = _match(written, (*self._further, *BUILT_IN))
            self._found[written] = built_in or _match(written, self.names())
        return self._found[written]

    def names(self) -> list[str]:
        """The names of all middlewares, sorted."""
        from robocomp_dsl.runtime.middleware.registry import middleware_names  # noqa: PLC0415

        return sorted({*self._further, *middleware_names()})

    def describe(self, name: str) -> MiddlewareDescription | None:
        """The description of a middleware; None if it is unknown or cannot be loaded."""
        if name in self._further:
            return self._further[name]
        from robocomp_dsl.runtime.middleware.registry import description_of  # noqa: PLC0415

        return description_of(name)

    def problem(self, name: str) -> str:
        """Why a middleware of another distribution cannot be used; empty if it can."""
        from robocomp_dsl.runtime.middleware import registry  # noqa: PLC0415

        if name in self._further or name in registry.BUILT_IN:
            return ""
        try:
            registry.capabilities_of(name)
        except registry.UnknownMiddleware as error:
            return str(error)
        return ""


def _match(written: str, names: Sequence[str]) -> str | None:
    return next((name for name in names if name.lower() == written.lower()), None)
