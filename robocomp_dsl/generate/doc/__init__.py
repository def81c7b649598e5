"""Documentation: models to linked pages of HTML and Markdown, with drawings as SVG.

In: a `Subject`. Out: `OutputFile`s, the same bytes for the same subject. A page is built once, as
data (`*_page.py` from `words.py` and `drawing.py`), and written down by `html.py` or `markdown.py`.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate.doc.component_page import (
    component_page,
    machine_page,
    parameters_page,
)
from robocomp_dsl.generate.doc.deployment_page import deployment_page
from robocomp_dsl.generate.doc.html import html_page, svg
from robocomp_dsl.generate.doc.index_page import index_page
from robocomp_dsl.generate.doc.interface_page import interface_page, module_page
from robocomp_dsl.generate.doc.markdown import markdown_page
from robocomp_dsl.generate.doc.site import Site, site_of
from robocomp_dsl.generate.doc.subject import Subject, natural
from robocomp_dsl.generate.doc.words import Figure, Page
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.templates import render

__all__ = ["FORMATS", "MARK", "Subject", "documentation"]

FORMATS = ("html", "markdown")
MARK = "Written by rcgen doc"
"""Stands in every file, so that only such files are ever written over."""


def documentation(subject: Subject, formats: tuple[str, ...] = FORMATS) -> list[OutputFile]:
    """All pages of `subject` in these formats."""
    pages = list(_pages(site_of(subject)))
    files: list[OutputFile] = []
    if "html" in formats:
        files.append(OutputFile("style.css", render("doc/style.css.jinja", mark=MARK)))
        files += [OutputFile(f"{p.path}.html", html_page(p, pages, subject.title)) for p in pages]
    if "markdown" in formats:
        files += [OutputFile(f"{p.path}.md", markdown_page(p, subject.title)) for p in pages]
        blocks = (one for p in pages for one in p.blocks)
        figures = {one.name: one for one in blocks if isinstance(one, Figure)}
        files += [OutputFile(f"{one.name}.svg", svg(one.drawing)) for one in figures.values()]
    return files


def _pages(site: Site) -> Iterator[Page]:
    """All pages, the first one first."""
    subject = site.subject
    yield index_page(site)
    yield from (deployment_page(one, site) for one in subject.deployments)
    yield from (component_page(one, site) for one in subject.components)
    pairs = [(one, module) for module in site.modules for one in module.interfaces]
    pairs.sort(key=lambda pair: (natural(pair[0].name), pair[1].name))
    yield from (interface_page(*pair, site) for pair in pairs)
    yield from (module_page(one, site) for one in site.modules)
    yield from (parameters_page(one, site) for one in subject.parameters)
    yield from (machine_page(one, site) for one in subject.machines)
