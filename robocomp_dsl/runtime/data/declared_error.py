"""The base class of the exceptions that an IDSL file declares."""

from __future__ import annotations

from robocomp_dsl.runtime.data.struct import Struct


class DeclaredError(Struct, Exception):
    """Base of the exceptions that an IDSL file declares; carries fields as a struct does."""

    __slots__ = ()
    _fields_ = ()

    def __str__(self) -> str:
        return repr(self)
