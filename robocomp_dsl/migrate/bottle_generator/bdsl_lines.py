"""The text of a bridge, line by line, with the position in the configuration of each line.

In: lines and spans. Out: the text, and diagnostics about it as diagnostics about the configuration.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.diagnostics import Diagnostic, Note
from robocomp_dsl.source import Source, Span


@dataclass(slots=True)
class BdslLines:
    """Lines in order; `origins` are the positions that they come from, or None."""

    lines: list[str] = field(default_factory=list)
    origins: list[Span | None] = field(default_factory=list)

    def add(self, line: str, origin: Span | None = None) -> None:
        """Add a line without its line end."""
        self.lines.append(line)
        self.origins.append(origin)

    @property
    def text(self) -> str:
        """The whole text."""
        return "\n".join(self.lines) + "\n"


@dataclass(frozen=True, slots=True)
class ConvertedBridge:
    """A bridge called `name` in BDSL; `file` is the position of a line without one of its own."""

    name: str
    text: str
    origins: tuple[Span | None, ...]
    file: Span

    def formatted(self) -> str:
        """The text as `rcgen fmt` lays it out."""
        from robocomp_dsl.format.formatter import format_source  # noqa: PLC0415 - for files only

        source = Source(Path(f"{self.name}.bdsl"), self.text)
        return format_source(source, ()) or self.text

    def original(self, diagnostic: Diagnostic) -> Diagnostic:
        """A diagnostic about the text, at the position in the configuration."""
        notes = tuple(Note(self._original(note.span), note.message) for note in diagnostic.notes)
        return Diagnostic(
            diagnostic.code,
            self._original(diagnostic.span),
            diagnostic.message,
            diagnostic.label,
            notes,
            diagnostic.help,
        )

    def _original(self, span: Span) -> Span:
        if span.source.text != self.text:
            return span
        line = span.start_position[0]
        origin = self.origins[line - 1] if line <= len(self.origins) else None
        return origin or self.file
