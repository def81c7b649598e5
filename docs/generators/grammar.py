"""Reference pages of the grammars, from the Lark files that the parsers are built from.

In: the folder with `*.lark`. Out: a page for each grammar, with its rules as linked productions and
its tokens as a table. What only the parser needs (aliases, `_SEMI`, stray semicolons) is left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

LANGUAGES = {
    "idsl": "IDSL",
    "cdsl": "CDSL",
    "pdsl": "PDSL",
    "ddsl": "DDSL",
    "smdsl": "SMDSL",
    "bdsl": "BDSL",
    "innermodel": "InnerModel",
}
_DEFINITION = re.compile(r"^[?!]?(?P<name>_?[A-Za-z][A-Za-z_0-9]*)(?:\.\d+)?:\s*(?P<body>.*)$")
_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"i?|/(?:[^/\\]|\\.)+/|->\s*\w+|[A-Za-z_]\w*|\S')
_PUNCTUATION = {"_SEMI": '";"'}
_STRAY = re.compile(r"\s*_SEMI\s*->\s*lone_semicolon\s*")


@dataclass(frozen=True, slots=True)
class Grammar:
    """One Lark file: its opening comment, its rules and its terminals, in order."""

    about: str
    rules: Mapping[str, list[str]]
    terminals: Mapping[str, str]


def write(grammars: Path, folder: Path) -> None:
    """Write a page for each language of `grammars` into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    shared = read((grammars / "terminals.lark").read_text(encoding="utf-8")).terminals
    for stem, title in LANGUAGES.items():
        grammar = read((grammars / f"{stem}.lark").read_text(encoding="utf-8"))
        (folder / f"{stem}.md").write_text(page(stem, title, grammar, shared), encoding="utf-8")


def read(text: str) -> Grammar:
    """The rules and terminals of a Lark file."""
    rules: dict[str, list[str]] = {}
    terminals: dict[str, str] = {}
    for name, body in _definitions(text):
        if name.isupper():
            terminals[name] = body
        else:
            rules[name] = list(_alternatives(body))
    comments = (line.lstrip("/ ") for line in _leading_comment(text))
    return Grammar(" ".join(comments), rules, terminals)


def _leading_comment(text: str) -> Iterator[str]:
    for line in text.splitlines():
        if not line.startswith("//") or line.strip() == "//":
            return
        yield line


def _definitions(text: str) -> Iterator[tuple[str, str]]:
    """Every definition with its continuation lines."""
    name, body = "", ""
    for line in text.splitlines():
        start = _DEFINITION.match(line)
        if start:
            if name:
                yield name, body
            name, body = start["name"], start["body"]
        elif name and line.lstrip().startswith("|"):
            body = f"{body} {line.strip()}"
    if name:
        yield name, body


def _alternatives(body: str) -> Iterator[str]:
    """The alternatives at the top level of a rule, without those of stray semicolons."""
    depth, part = 0, ""
    for symbol in re.findall(rf"{_TOKEN.pattern}|\s+", body):
        if len(symbol) == 1:
            depth += (symbol in "([") - (symbol in ")]")
        if symbol == "|" and depth == 0:
            yield from _kept(part)
            part = ""
        else:
            part += symbol
    yield from _kept(part)


def _kept(part: str) -> Iterator[str]:
    if part.strip() and not _STRAY.fullmatch(part):
        yield part


def page(stem: str, title: str, grammar: Grammar, shared: Mapping[str, str]) -> str:
    """The page of one language as MyST Markdown."""
    terminals = {**shared, **grammar.terminals}
    # InnerModel has tokens of its own; the other languages share theirs.
    productions = "\n".join(_productions(grammar.rules, terminals))
    used = {name for parts in grammar.rules.values() for p in parts for name in _TOKEN.findall(p)}
    rows = "\n".join(_rows(used, terminals))
    return (
        f"# Grammar of {title}\n\n{grammar.about}\n\n"
        f"`[x]` is optional, `x*` and `x+` repeat, `|` separates alternatives. The file is "
        f"`grammars/{stem}.lark`.\n\n"
        f"```{{eval-rst}}\n.. productionlist:: {stem}\n{productions}\n```\n\n"
        f"## Tokens\n\n| token | regular expression |\n|---|---|\n{rows}\n"
    )


def _productions(rules: Mapping[str, list[str]], terminals: Mapping[str, str]) -> Iterator[str]:
    for name, alternatives in rules.items():
        shown = [_shown(part, rules, terminals) for part in alternatives]
        if not shown:
            continue
        yield f"   {_public(name, rules)}: {shown[0]}"
        yield from (f"      : | {part}" for part in shown[1:])


def _shown(part: str, rules: Mapping[str, list[str]], terminals: Mapping[str, str]) -> str:
    words = (_word(token, rules, terminals) for token in _TOKEN.findall(part))
    text = " ".join(word for word in words if word)
    return re.sub(r"(?<=[(\[]) | (?=[)\]*+])", "", text)


def _word(token: str, rules: Mapping[str, list[str]], terminals: Mapping[str, str]) -> str:
    if token.startswith("->"):
        return ""
    if token in rules:
        return f"`{_public(token, rules)}`"
    if token in _PUNCTUATION:
        return _PUNCTUATION[token]
    if token.startswith('"'):
        return token.removesuffix("i")
    definition = terminals.get(token, "")
    return definition.removesuffix("i") if _is_literal(definition) else token.lstrip("_")


def _is_literal(definition: str) -> bool:
    return re.fullmatch(r'"(?:[^"\\]|\\.)*"i?', definition) is not None


def _public(name: str, rules: Iterable[str]) -> str:
    """The name without the underscore that only the parser needs, unless that is another rule."""
    bare = name.lstrip("_")
    return name if bare != name and bare in rules else bare


def _rows(used: Iterable[str], terminals: Mapping[str, str]) -> Iterator[str]:
    for name, definition in terminals.items():
        if name in used and name not in _PUNCTUATION and not _is_literal(definition):
            escaped = definition.replace("|", "\\|")
            yield f"| `{name.lstrip('_')}` | `` {escaped} `` |"
