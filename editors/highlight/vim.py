"""Vim syntax files.

In: the words of a language. Out: the file. Each kind of statement is a region that ends at `;` or
before a brace; if regions start at the same place, Vim uses the one defined last.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.highlight.table import StatementKeywords, Words, words

_GROUPS = {
    "Keyword": "Statement",
    "Declaration": "Structure",
    "Modifier": "Keyword",
    "Legacy": "Todo",
    "Value": "Constant",
    "Truth": "Boolean",
    "Type": "Type",
    "Pattern": "PreProc",
    "Number": "Number",
    "Unit": "Special",
    "String": "String",
    "Comment": "Comment",
    "Doc": "SpecialComment",
    "Operator": "Operator",
    "Name": "Identifier",
    "Field": "Identifier",
    "Function": "Function",
}
_BEHIND = {"name": r"\h", "string": '"', "number": r"[-+.0-9]", "digit": r"\.\=\d", "[": r"\["}
_BEHIND_TYPE = {
    "idsl": r"\ze\%(\s\+\h\|\s*[<>,)]\|\s*$\)",
    "bdsl": r"\ze\%(\s\+\h\|\s*[[;{]\|\s*$\)",
}
_NUMBER = r"\%(\<0[xX]\x\+\|[-+]\=\%(\<\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\)"
_FRAME = """\" Vim syntax file: {NAME} of RoboComp
" Written by `python -m editors.highlight` from the grammars; do not edit.

if exists("b:current_syntax")
  finish
endif
let s:cpo_save = &cpo
set cpo&vim

syn case {case}
{body}
{links}

syn sync minlines=200
let b:current_syntax = "{name}"
let &cpo = s:cpo_save
unlet s:cpo_save
"""


def syntax(language: str) -> str:
    """The syntax file of one language."""
    of = words(language)
    links = [f"hi def link {language}{group} {to}" for group, to in _GROUPS.items()]
    return _FRAME.format(
        NAME=language.upper(),
        name=language,
        case="ignore" if of.any_case else "match",
        body="\n".join(_body(of)),
        links="\n".join(links),
    )


def _body(of: Words) -> Iterator[str]:
    """Later lines take precedence, so the general ones come first."""
    yield from _items(of)
    yield from _region(of, StatementKeywords("", False, False, of.plain, ()), _plain_start(of))
    for statement in of.statements:
        yield from _region(
            of, statement, rf"\<{statement.word}\>" + _ahead(of.keywords[statement.word])
        )
    yield from _comments(of.language)


def _items(of: Words) -> Iterator[str]:
    """Elements of any statement, all in the cluster `Any`."""
    name = of.language
    match = f"syn match {name}"
    signs = r"[=:+*\/.-]" if name == "bdsl" else "[=:<>+.-]"
    yield rf"{match}Operator contained /->\|=>\|::\|{signs}/"
    if name in ("idsl", "bdsl"):
        yield rf"{match}Function contained /\h\w*\ze\s*(/"
    yield (
        rf"{match}Text contained /\h\w*/"
        if name not in ("idsl", "bdsl")
        else rf"{match}Text contained /\h\w*\ze\%(\s*(\)\@!\>/"
    )
    yield rf"{match}Number contained /{_NUMBER}\>\=/"
    if of.types:
        behind = _BEHIND_TYPE.get(name, "")
        yield rf"{match}Type contained /{_alternatives(of.types)}{behind}/"
    if of.truth:
        yield rf"{match}Truth contained /{_alternatives(of.truth)}/"
    if of.durations:
        units = _alternatives(of.durations)
        yield rf"{match}Unit contained /\%(\<\d\+\.\=\d*\s*\)\@<={units}/"
    if of.units:
        yield rf"{match}Unit contained /\[[^][]*\]/"
        commas = "," if name == "bdsl" else ""
        yield rf"{match}Number contained /\[[0-9:{commas} \t]*\]/"
    if of.patterns:
        yield rf"{match}Pattern contained /\[\s*{_alternatives(of.patterns)}\s*\]/"
    if name == "pdsl":
        yield rf"{match}Value contained /{{[A-Za-z0-9_, \t\n]*}}/"
    kinds = ("Operator", "Function", "Text", "Number", "Type", "Truth", "Unit", "Pattern", "Value")
    yield rf'syn region {name}String start=/"/ skip=/\\./ end=/"/ end=/$/'
    yield f"syn cluster {name}Any contains={','.join(name + kind for kind in kinds)},{name}String"


def _region(of: Words, item: StatementKeywords, start: str) -> Iterator[str]:
    """A statement; the names of its inner groups contain its first word, so they are unique."""
    name, own = of.language, f"{of.language}_{item.word or 'plain'}"
    inside = [f"@{name}Any", f"{name}Comment", f"{name}Doc"]
    group = "Legacy" if item.legacy else "Declaration" if item.opens else "Keyword"
    for word in item.inner:
        yield rf"syn match {own}_inner contained /\.\@<!\<{word}\>\.\@!{_ahead(of.keywords[word])}/"
    if item.values:
        yield rf"syn match {own}_value contained /\.\@<!{_alternatives(item.values)}/"
    if item.opens and "name" in of.keywords[item.word] and item.word != "connect":
        yield rf"syn match {own}_name contained /\%(\<{item.word}\s\+\)\@<=\h\w*/"
    if of.language == "pdsl" and not item.word:
        yield rf"syn match {own}_field contained /\%([;{{]\_s*\|\*\/\_s*\|^\s*\)\@<=\h\w*/"
    for kind, group_of in _KINDS.items():
        inside.append(f"{own}_{kind}")
        yield f"hi def link {own}_{kind} {name}{group_of}"
    brace = r"\%({[A-Za-z0-9_, \t\n]*}\)\@![{}]" if of.language == "pdsl" else "[{}]"
    first = f"matchgroup={name}{group} " if item.word else ""
    yield (
        f"syn region {own} {first}start=/{start}/ matchgroup=NONE end=/;/ "
        f"end=/{brace}/me=s-1 contains={','.join(inside)}"
    )


_KINDS = {"inner": "Modifier", "value": "Value", "name": "Name", "field": "Field"}


def _plain_start(of: Words) -> str:
    return r"\ze\h" if of.language == "pdsl" else r"\ze[A-Za-z_[:]"


def _comments(name: str) -> Iterator[str]:
    yield rf"syn match {name}Comment ,//.*,"
    yield f"syn match {name}Comment /#.*/"
    yield rf"syn match {name}Doc ,///[/<]\@!.*,"
    yield f"syn region {name}Comment start=,/\\*, end=,\\*/,"
    yield rf"syn region {name}Doc start=,/\*\*[*/<]\@!, end=,\*/,"


def _alternatives(listed: Iterable[str]) -> str:
    longest = sorted(listed, key=len, reverse=True)
    return r"\<\%(" + r"\|".join(longest) + r"\)\>"


def _ahead(behind: Iterable[str]) -> str:
    chars = r"\|".join(sorted(_BEHIND.get(item, item) for item in behind))
    return rf"\%(\s*\%({chars}\|\/[*\/]\|$\)\)\@="
