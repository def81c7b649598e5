"""Builds the quality of service of a connection: settings that DDSL and BDSL share.

In: the rules that the parser recognised. Out: settings for the fields of `ast.ddsl.Qos`.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Duration, Name, Number
from robocomp_dsl.syntax.languages.builder import BlockSetting, Builder

_KEEPS = ("depth", "keep_all")


class QosBuilder(Builder):
    """The part of a builder for the quality of service."""

    def without_second_length(self, items: Iterable[Any]) -> list[Any]:
        """The items without a second length of the queue, which is reported."""
        length: BlockSetting | None = None
        valid: list[Any] = []
        for item in items:
            if isinstance(item, BlockSetting) and item.field in _KEEPS:
                first = length
                length = self.first_of(length, item, "the length of the queue")
                if first is not None:
                    continue
            valid.append(item)
        return valid

    def reliability(self, span: Span, word: Name) -> BlockSetting:
        """`reliable;` or `best_effort;`."""
        return BlockSetting(span, "reliability", word)

    def priority(self, span: Span, word: Name) -> BlockSetting:
        """`priority high;`."""
        return BlockSetting(span, "priority", word)

    def depth(self, span: Span, value: Number) -> BlockSetting:
        """`keep last 1;`, or `depth 1;`."""
        return BlockSetting(span, "depth", value)

    def keep_all(self, span: Span, word: Name) -> BlockSetting:
        """`keep all;`."""
        return BlockSetting(span, "keep_all", word)

    def latched(self, span: Span, word: Name) -> BlockSetting:
        """`latched;`."""
        return BlockSetting(span, "latched", word)

    def deadline(self, span: Span, value: Duration) -> BlockSetting:
        """`deadline 40 ms;`."""
        return BlockSetting(span, "deadline", value)

    def liveliness(self, span: Span, value: Duration) -> BlockSetting:
        """`liveliness 500 ms;`."""
        return BlockSetting(span, "liveliness", value)
