"""A position in the tokens of a Thrift definition, and the report of what is wrong there.

In: tokens. Out: the next token, or `SyntaxMistake` after the mistake was reported.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.base import Name
from robocomp_dsl.syntax.codes import yarp as codes
from robocomp_dsl.syntax.file_diagnostics import LIMIT
from robocomp_dsl.syntax.thrift.tokens import END, TEXT, WORD, ThriftToken, tokenize

TOP = frozenset(
    ("include", "cpp_include", "namespace", "const", "typedef", "enum", "senum", "struct", "union",
     "exception", "service")
)  # fmt: skip
"""The first words of statements outside braces."""


class SyntaxMistake(Exception):
    """A statement that cannot be read; it is reported."""


class Cursor:
    """The tokens that are not read yet; `failed`: there was an error."""

    def __init__(self, source: Source, report: Report) -> None:
        read = tokenize(source)
        self.source = source
        self.failed = False
        self._report = report
        self._tokens = read.tokens
        self._behind = read.behind
        self._at = 0
        self._count = 0
        if read.open_comment:
            self.report(codes.THRIFT_STATEMENT, read.open_comment, "this comment has no end")

    @property
    def token(self) -> ThriftToken:
        """The next token."""
        return self._tokens[self._at]

    @property
    def following(self) -> ThriftToken:
        """The token after the next one."""
        return self._tokens[min(self._at + 1, len(self._tokens) - 1)]

    @property
    def last(self) -> ThriftToken:
        """The token that was read last."""
        return self._tokens[max(self._at - 1, 0)]

    @property
    def is_at_end(self) -> bool:
        """Whether all tokens are read."""
        return self.token.kind == END

    def behind(self) -> str:
        """The comment behind the last token on its line."""
        return self._behind.get(self.last.span.end, "")

    def next(self) -> ThriftToken:
        """Read a token; the end stays the next token."""
        token = self.token
        self._at = min(self._at + 1, len(self._tokens) - 1)
        return token

    def accept(self, *texts: str) -> bool:
        """Read the next token if it is one of these words or signs."""
        if self.token.kind in (END, TEXT) or self.token.text not in texts:
            return False
        self.next()
        return True

    def expect(self, text: str) -> ThriftToken:
        """Read this word or sign."""
        if self.token.kind == TEXT or self.token.text != text:
            self.fail(f"expected `{text}`")
        return self.next()

    def expect_kind(self, kind: str, what: str) -> ThriftToken:
        """Read a token of this kind; `what` names it for messages."""
        if self.token.kind != kind or self._starts_statement():
            self.fail(f"expected {what}")
        return self.next()

    def name(self, what: str) -> Name:
        """Read a name without dots."""
        token = self.token
        if token.kind != WORD or "." in token.text or self._starts_statement():
            self.fail(f"expected {what}")
        self.next()
        return Name(token.span, token.text)

    def fail(self, message: str, help_: str = "") -> SyntaxMistake:
        """Report what is expected instead of the next token, and raise `SyntaxMistake`."""
        token = self.token
        shown = token.text if len(token.text) <= 40 else f"{token.text[:39]}…"
        found = "the end of the file" if token.kind == END else f"`{shown}`"
        self.report(codes.THRIFT_STATEMENT, token.span, f"{message}, not {found}", help_)
        raise SyntaxMistake

    def report(self, code: Code, span: Span, message: str, help_: str = "") -> None:
        """Report a finding; of very many the first ones."""
        self.failed = self.failed or code is not codes.THRIFT_LEFT_OUT
        self._count += 1
        if self._count <= LIMIT:
            self._report.add(code, span, message, help=help_)

    def _starts_statement(self) -> bool:
        """Whether the next token is a keyword at the start of a line: another statement."""
        token = self.token
        return token.is_first and token.text in TOP and self.following.kind in (WORD, TEXT)

    def skip_statement(self, *, inside: bool) -> None:
        """Continue behind a mistake: at the next statement or, `inside` braces, the next member."""
        while not self.is_at_end:
            token = self.token
            if self._starts_statement():
                return
            if inside and (token.text == "}" or (token.is_first and token.kind != TEXT)):
                return
            self.next()
            if inside and token.text in (",", ";"):
                return
