"""Data of the check of monitors: operations in, findings out."""

from __future__ import annotations

import ast
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class MonitoredOperation:
    """An operation of the interface: its inputs as name and Python type.

    The type is `bool`, `int`, `float` or `str`; "" for any other type, which is not checked.
    """

    name: str
    inputs: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class MonitorFinding:
    """What is wrong at a place of a Python file; lines and columns count from 1, in characters.

    `parameter` is the parameter of the deployment that the finding is about, or "".
    """

    line: int
    column: int
    end_line: int
    end_column: int
    message: str
    help: str = ""
    parameter: str = ""

    @classmethod
    def at(
        cls, node: ast.AST, lines: list[str], message: str, help_text: str = "", parameter: str = ""
    ) -> MonitorFinding:
        """A finding at a node; of a definition, at its name."""
        line, start = getattr(node, "lineno", 1), getattr(node, "col_offset", 0)
        end_line = getattr(node, "end_lineno", line)
        end = getattr(node, "end_col_offset", start)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            text = lines[line - 1].encode()
            found = text.find(node.name.encode(), start)
            start = max(found, start)
            end_line, end = line, start + len(node.name.encode())
        column = _column(lines, line, start)
        end_column = _column(lines, end_line, end)
        return cls(line, column, end_line, end_column, message, help_text, parameter)


def _column(lines: list[str], line: int, byte: int) -> int:
    """The column of a byte of a line."""
    text = lines[line - 1] if line <= len(lines) else ""
    return len(text.encode()[:byte].decode("utf-8", "replace")) + 1
