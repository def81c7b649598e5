"""The grammar file of a language: its checksum, and the name of the end of the input."""

from __future__ import annotations

from zlib import crc32

from robocomp_dsl.resources import GRAMMARS

SHARED = GRAMMARS / "terminals.lark"
END = "$END"


def fingerprint(language: str) -> int:
    """Checksum of the grammar files of `language`."""
    grammar = GRAMMARS / f"{language}.lark"
    return crc32(grammar.read_bytes(), crc32(SHARED.read_bytes()))
