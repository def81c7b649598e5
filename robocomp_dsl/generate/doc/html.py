"""Pages as HTML. In: pages as data. Out: texts.

Templates ending in `.html.jinja` and `.svg.jinja` escape whatever is not `Markup`, and `Markup`
is made only here, from parts that are escaped.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from robocomp_dsl.generate.doc.drawing import Drawing, number
from robocomp_dsl.generate.doc.words import Badge, Code, Page, Target, Words
from robocomp_dsl.generate.templates import render


@dataclass(frozen=True, slots=True)
class Entry:
    """A page in the list of all pages."""

    title: str
    address: str
    here: bool


@dataclass(frozen=True, slots=True)
class Html:
    """Writes the parts of one page."""

    page: str

    def address(self, target: Target) -> str:
        """Where a link leads to, seen from this page."""
        return address(self.page, target, ".html")

    def words(self, words: Words) -> Markup:
        """A line of words."""
        return Markup().join(map(self._word, words))

    def _word(self, one: object) -> Markup:
        match one:
            case Badge(text, kind):
                return Markup('<span class="badge {}">{}</span>').format(kind, text)
            case Code(text, None):
                return Markup("<code>{}</code>").format(text)
            case Code(text, Target() as target):
                link = Markup('<a href="{}"><code>{}</code></a>')
                return link.format(self.address(target), text)
        return escape(getattr(one, "text", ""))

    def drawing(self, drawing: Drawing) -> Markup:
        """A drawing inside the page; its parts are links."""
        return Markup(svg(drawing, self.address))  # noqa: S704 - its template escapes


def svg(drawing: Drawing, link: Callable[[Target], str] | None = None) -> str:
    """A drawing as part of a page or, without addresses of links, as a file of its own."""
    context = {"drawing": drawing, "address": link, "number": number, "alone": link is None}
    return render("doc/drawing.svg.jinja", **context)


def address(page: str, target: Target, suffix: str) -> str:
    """The way from one page to a place in another one."""
    anchor = f"#{target.anchor}" if target.anchor else ""
    if not target.page or (target.page == page and anchor):
        return anchor
    folder, name = page.rpartition("/")[0], target.page
    if name.rpartition("/")[0] == folder:
        way = name.rpartition("/")[2]
    else:
        way = "../" * page.count("/") + name
    return f"{way}{suffix}{anchor}"


def html_page(page: Page, pages: Sequence[Page], title: str) -> str:
    """The whole text of a page; `pages` are all there are, `title` is that of the first one."""
    html = Html(page.path)
    groups: dict[str, list[Entry]] = {}
    for one in pages[1:]:
        entry = Entry(one.title, html.address(Target(one.path)), one is page)
        plural = one.group if one.group.endswith("s") else f"{one.group}s"
        groups.setdefault(plural, []).append(entry)
    return render(
        "doc/page.html.jinja",
        page=page,
        html=html,
        groups=groups,
        title=title,
        index=html.address(Target(pages[0].path)),
        style="../" * page.path.count("/") + "style.css",
    )
