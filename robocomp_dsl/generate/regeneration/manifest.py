"""The manifest `.rcgen/methods.json`: previously generated methods with their signatures.

In: the folder. Out: the signatures that the user's methods were written for; the file to write.
The entry of a method stays while the user's class has the method, to detect stale ones.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.output import MANIFEST_FOLDER, OutputFile
from robocomp_dsl.generate.regeneration.compare_signatures import matches_signature
from robocomp_dsl.generate.regeneration.methods import Method, Signature
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.source import Source, UnreadableSource

FILE = f"{MANIFEST_FOLDER}methods.json"


def read(folder: Path, report: Report, name: str = FILE) -> dict[str, Signature]:
    """The recorded signatures by method; empty without a readable manifest `name`."""
    path = folder / name
    try:
        source = Source.read(path)
        return {method: _signature(value) for method, value in json.loads(source.text).items()}
    except UnreadableSource:
        return {}
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        report.add(
            codes.UNREADABLE_MANIFEST,
            source.file_span,
            f"`{name}` is damaged; changed and stale methods are unknown",
            help="rcgen writes it again; keep the folder `.rcgen` under version control",
        )
        return {}


def of_now(
    methods: Mapping[str, Method], known: Mapping[str, Signature], user: UserModule | None
) -> dict[str, Signature]:
    """The new entries; `user` None: the user's file is written in this run."""
    has = user.members if user else {}
    signatures = {name: signature for name, signature in known.items() if name in has}
    for name, method in methods.items():
        member = has.get(name)
        old = known.get(name)
        if (
            member is None
            or old is None
            or matches_signature(member.function, old, method.signature)
        ):
            signatures[name] = method.signature
    return signatures


def file_of(known: Mapping[str, Signature], path: str = FILE) -> OutputFile:
    """The manifest as a file."""
    rows = {
        name: {"arguments": [list(a) for a in signature.arguments], "returns": signature.returns}
        for name, signature in sorted(known.items())
    }
    return OutputFile(path, json.dumps(rows, indent=1, ensure_ascii=False) + "\n")


def _signature(value: dict[str, object]) -> Signature:
    arguments, returns = value["arguments"], value["returns"]
    if not isinstance(arguments, list) or not isinstance(returns, str):
        raise TypeError
    return Signature(tuple((str(name), str(type_)) for name, type_ in arguments), returns)
