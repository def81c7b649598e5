"""Documentation made in the tests, and a strict reader of its pages."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path, PurePosixPath
from posixpath import normpath
from urllib.parse import unquote

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.output import render
from robocomp_dsl.cli.rcgen.doc_subject import read_subject
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.doc.documentation import DocumentationSubject, documentation

ROOT = Path(__file__).parents[2]
DEMO = ROOT / "components" / "wander" / "wander.ddsl"
VOID = {"meta", "link", "br", "hr", "img", "input"}


def subject(*paths: Path, title: str = "Robot") -> DocumentationSubject:
    """What is in files without errors."""
    report = Report()
    documented = read_subject(paths, title, Workspace(environ={}), report)
    assert not report.has_errors, render.full(report)
    return documented


def pages(*paths: Path, title: str = "Robot") -> dict[str, str]:
    """The text of each file that documents them, by its path."""
    return {item.path: item.text for item in documentation(subject(*paths, title=title))}


@dataclass
class ParsedPage:
    """The content of a page: words, ids, links, tags, and errors of the HTML."""

    words: list[str] = field(default_factory=list)
    ids: list[str] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    tags: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """All words, separated by single spaces."""
        return " ".join("".join(self.words).split())


class _PageParser(HTMLParser):
    """Parses HTML with embedded SVG strictly."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.page = ParsedPage()
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = dict(attrs)
        if len(attributes) != len(attrs):
            self.page.errors.append(f"<{tag}> has an attribute twice")
        self.page.tags.append(tag)
        self.page.ids += [v for k, v in attrs if k == "id" and v]
        self.page.links += [v for k, v in attrs if k in ("href", "src") and v]
        self.page.errors += [f"<{tag} {k}>" for k, _ in attrs if k.startswith("on")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.page.errors.append(f"<{tag}/>")

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.page.errors.append(f"</{tag}> at {self.getpos()}")
        if tag in ("td", "th", "dt"):
            self.page.words.append(" ")

    def handle_data(self, data: str) -> None:
        self.page.words.append(data)


def read(html: str) -> ParsedPage:
    """Parse a page; asserts that it is well formed and its ids are unique."""
    parser = _PageParser()
    parser.feed(html)
    parser.close()
    assert parser.open == [], parser.open
    assert parser.page.errors == []
    ids = parser.page.ids
    assert len(ids) == len(set(ids)), sorted(item for item in ids if ids.count(item) > 1)
    return parser.page


MARKDOWN_LINK = re.compile(r"(?<!\\)\]\(([^()\s]+)\)")
MARKDOWN_PLACE = re.compile(r'<a id="([^"]+)"></a>')


def check_links(files: dict[str, str]) -> int:
    """Assert that every link resolves; the number of links."""
    places, links = {}, []
    for path, text in files.items():
        if path.endswith(".html"):
            page = read(text)
            places[path] = set(page.ids)
            links += [(path, link) for link in page.links]
        elif path.endswith(".md"):
            places[path] = set(MARKDOWN_PLACE.findall(text))
            links += [(path, link) for link in MARKDOWN_LINK.findall(text)]
        else:
            places[path] = set()
    broken = [(path, link) for path, link in links if not _resolves(path, link, places)]
    assert broken == []
    return len(links)


def _resolves(path: str, link: str, places: dict[str, set[str]]) -> bool:
    resolved, _, anchor = unquote(link).partition("#")
    folder = str(PurePosixPath(path).parent)
    target = normpath(f"{folder}/{resolved}") if resolved else path
    return target in places and (not anchor or anchor in places[target])


def headings(tags: Iterable[str]) -> list[int]:
    """The levels of the headings of a page, in order."""
    return [int(tag[1]) for tag in tags if re.fullmatch("h[1-6]", tag)]
