"""Signatures: objects of the model as a few lines of their own language, for hover and completion.

In: objects of the model. Out: text.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.language_server.signatures import (
    signatures_bdsl,
    signatures_components,
    signatures_idsl,
    signatures_innermodel,
    signatures_smdsl,
)
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import Instance

_SIGNATURES: dict[type, Callable[[Any], str]] = {
    **signatures_idsl.SIGNATURES,
    **signatures_components.SIGNATURES,
    **signatures_smdsl.SIGNATURES,
    **signatures_innermodel.SIGNATURES,
    **signatures_bdsl.SIGNATURES,
}


def signature(model_object: object) -> str:
    """The signature of an object of the model; empty for other objects."""
    return _SIGNATURES.get(type(model_object), lambda _: "")(model_object)


def doc_of(model_object: object) -> str:
    """The doc comment; an instance without one has that of its component."""
    doc: str = getattr(model_object, "doc", "")
    match model_object:
        case Instance() if not doc:
            return model_object.component.doc
        case Port():
            return model_object.interface.doc
    return doc
