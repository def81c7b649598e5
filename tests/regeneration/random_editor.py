"""Random edits of `specificworker.py`; the file stays valid Python."""

from __future__ import annotations

import ast
import random
import re

SNIPPETS = (
    "    def helper_{n}(self) -> int:\n        return {n}  # mine\n",
    "    # a remark of {n}, with ünïcödé\n",
    "    constant_{n} = [\n        {n},\n    ]\n",
    "    @staticmethod\n    def static_{n}(x=({n},)):\n        '''Mine.'''\n        return x\n",
    "    @property\n    def prop_{n}(self):\n        return self.constant\n",
    "    class Inner{n}:\n        x: int = {n}\n",
    "    def of_parameters_{n}(self):\n        return self.params.p{n}\n",
    "    async def later_{n}(self): return {n}\n",
)
OUTSIDE = (
    "\n\nclass Helper{n}:\n    '''Not of the component.'''\n\n    def Talk_do1(self): ...\n",
    "\n\ndef function_{n}():\n    return '''\nclass SpecificWorker:\n    pass\n'''\n",
    "\nvalue_{n} = {n}\n# the end of {n}",
)
IMPORTS = (
    "import math\n",
    "from typing import Any\n",
    "import talker_generated.interfaces as gi\n",
)


class RandomEditor:
    """Makes random edits of a text."""

    def __init__(self, rng: random.Random) -> None:
        self.rng = rng

    def edit(self, text: str) -> str:
        """One edit; the unchanged text if the edit breaks the syntax."""
        change = self.rng.choice(
            [
                self.add,
                self.add,
                self.outside,
                self.remark,
                self.body,
                self.rename,
                self.blank,
                self.delete,
                self.line_ends,
                self.tabs,
                self.add_import,
            ]
        )
        plain = text.replace("\r\n", "\n")
        edited = change(plain) if change != self.line_ends else self.line_ends(text)
        if "\r\n" in text and change != self.line_ends:
            edited = edited.replace("\n", "\r\n")
        try:
            ast.parse(edited)
        except SyntaxError:
            return text
        return edited

    def _lines(self, text: str) -> list[str]:
        return text.splitlines(keepends=True)

    def _methods(self, text: str) -> list[ast.FunctionDef]:
        tree = ast.parse(text)
        worker = next(
            n for n in tree.body if isinstance(n, ast.ClassDef) and n.name == "SpecificWorker"
        )
        return [n for n in worker.body if isinstance(n, ast.FunctionDef)]

    def add(self, text: str) -> str:
        """A snippet into the class, in the indentation of the file."""
        snippet = self.rng.choice(SNIPPETS).format(n=self.rng.randrange(1000))
        if "\tdef " in text:
            snippet = re.sub(
                r"^( {4})+", lambda m: "\t" * (len(m[0]) // 4), snippet, flags=re.MULTILINE
            )
        method = self.rng.choice(self._methods(text))
        lines = self._lines(text)
        at = min([method.lineno, *(d.lineno for d in method.decorator_list)]) - 1
        return "".join([*lines[:at], snippet, *lines[at:]])

    def outside(self, text: str) -> str:
        return text + self.rng.choice(OUTSIDE).format(n=self.rng.randrange(1000))

    def remark(self, text: str) -> str:
        lines = self._lines(text)
        at = self.rng.randrange(len(lines))
        return "".join([*lines[:at], "        # a remark at any place\n", *lines[at:]])

    def body(self, text: str) -> str:
        """A statement in a method."""
        method = self.rng.choice(self._methods(text))
        lines = self._lines(text)
        last = method.body[-1]
        lead = re.match(r"\s*", lines[last.lineno - 1])
        indent = lead[0] if lead else ""
        return "".join([*lines[: last.lineno - 1], f"{indent}x = 1\n", *lines[last.lineno - 1 :]])

    def rename(self, text: str) -> str:
        """Another name for a parameter."""
        found = re.search(r"(def Talk_\w+\(self, )(a0)(: )", text)
        return text[: found.start(2)] + "mine" + text[found.end(2) :] if found else text

    def blank(self, text: str) -> str:
        lines = self._lines(text)
        at = self.rng.randrange(len(lines))
        return "".join([*lines[:at], "\n" * self.rng.randrange(4), *lines[at:]])

    def delete(self, text: str) -> str:
        """Delete any method except the first."""
        methods = self._methods(text)[1:]
        if not methods:
            return text
        method = self.rng.choice(methods)
        lines = self._lines(text)
        start = min([method.lineno, *(d.lineno for d in method.decorator_list)]) - 1
        return "".join([*lines[:start], *lines[method.end_lineno :]])

    def line_ends(self, text: str) -> str:
        plain = text.replace("\r\n", "\n")
        return plain if "\r\n" in text else plain.replace("\n", "\r\n")

    def tabs(self, text: str) -> str:
        """Indent the whole file with tabs."""
        if self.rng.random() < 0.7:
            return text
        return re.sub(r"^( {4})+", lambda m: "\t" * (len(m[0]) // 4), text, flags=re.MULTILINE)

    def add_import(self, text: str) -> str:
        tree = ast.parse(text)
        last = [n for n in tree.body if isinstance(n, ast.Import | ast.ImportFrom)][-1]
        lines = self._lines(text)
        at = last.end_lineno or last.lineno
        return "".join([*lines[:at], self.rng.choice(IMPORTS), *lines[at:]])
