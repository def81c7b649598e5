"""Write pages as HTML. In: pages as data. Out: texts.

Templates ending in `.html.jinja` and `.svg.jinja` escape everything that is not `Markup`; `Markup`
is created only here, from escaped parts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from robocomp_dsl.generate.doc.drawing import Drawing, format_length
from robocomp_dsl.generate.doc.nodes import Badge, DocumentationPage, InlineCode, Inlines
from robocomp_dsl.generate.doc.target import Target
from robocomp_dsl.generate.templates import render


@dataclass(frozen=True, slots=True)
class NavigationEntry:
    """A page in the list of all pages."""

    title: str
    url: str
    is_current: bool


@dataclass(frozen=True, slots=True)
class HtmlWriter:
    """Writes the parts of one page."""

    page: str

    def url(self, target: Target) -> str:
        """The URL of a target, relative to this page."""
        return relative_url(self.page, target, ".html")

    def inlines(self, words: Inlines) -> Markup:
        """Inline content as HTML."""
        return Markup().join(map(self._inline, words))

    def _inline(self, node: object) -> Markup:
        match node:
            case Badge(text, kind):
                return Markup('<span class="badge {}">{}</span>').format(kind, text)
            case InlineCode(text, None):
                return Markup("<code>{}</code>").format(text)
            case InlineCode(text, Target() as target):
                link = Markup('<a href="{}"><code>{}</code></a>')
                return link.format(self.url(target), text)
        return escape(getattr(node, "text", ""))

    def drawing(self, drawing: Drawing) -> Markup:
        """A drawing in the page; its parts are links."""
        return Markup(render_svg(drawing, self.url))  # noqa: S704 - its template escapes


def render_svg(drawing: Drawing, link: Callable[[Target], str] | None = None) -> str:
    """A drawing as part of a page; without `link`, as a separate file."""
    context = {
        "drawing": drawing,
        "url": link,
        "format_length": format_length,
        "alone": link is None,
    }
    return render("doc/drawing.svg.jinja", **context)


def relative_url(page: str, target: Target, suffix: str) -> str:
    """The URL from one page to a target."""
    anchor = f"#{target.anchor}" if target.anchor else ""
    if not target.page or (target.page == page and anchor):
        return anchor
    folder, name = page.rpartition("/")[0], target.page
    if name.rpartition("/")[0] == folder:
        path = name.rpartition("/")[2]
    else:
        path = "../" * page.count("/") + name
    return f"{path}{suffix}{anchor}"


def render_html_page(
    page: DocumentationPage, pages: Sequence[DocumentationPage], title: str
) -> str:
    """The text of a page; `pages` are all pages, `title` is the title of the first one."""
    html = HtmlWriter(page.path)
    groups: dict[str, list[NavigationEntry]] = {}
    for other in pages[1:]:
        entry = NavigationEntry(other.title, html.url(Target(other.path)), other is page)
        plural = other.group if other.group.endswith("s") else f"{other.group}s"
        groups.setdefault(plural, []).append(entry)
    return render(
        "doc/page.html.jinja",
        page=page,
        html=html,
        groups=groups,
        title=title,
        index=html.url(Target(pages[0].path)),
        style="../" * page.path.count("/") + "style.css",
    )
