"""Documentation: models to linked pages of HTML and Markdown, with drawings as SVG.

In: a `DocumentationSubject`. Out: `OutputFile`s, deterministic for a subject. A page is built once
as data (`*_page.py`, of `nodes.py` and `drawing.py`), and written by `html.py` or `markdown.py`.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate.doc.bridge_page import bridge_page
from robocomp_dsl.generate.doc.component_page import (
    component_page,
    machine_page,
    parameters_page,
)
from robocomp_dsl.generate.doc.deployment_page import deployment_page
from robocomp_dsl.generate.doc.html import render_html_page, render_svg
from robocomp_dsl.generate.doc.index_page import index_page
from robocomp_dsl.generate.doc.interface_page import interface_page, module_page
from robocomp_dsl.generate.doc.markdown import render_markdown_page
from robocomp_dsl.generate.doc.nodes import DocumentationPage, Figure
from robocomp_dsl.generate.doc.site import DocumentationSite, build_site
from robocomp_dsl.generate.doc.subject import DocumentationSubject, natural_sort_key
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.templates import render

__all__ = ["FORMATS", "MARK", "DocumentationSubject", "documentation"]

FORMATS = ("html", "markdown")
MARK = "Written by rcgen doc"
"""Mark in every generated file; only files with it are overwritten."""


def documentation(
    subject: DocumentationSubject, formats: tuple[str, ...] = FORMATS
) -> list[OutputFile]:
    """All pages of `subject` in these formats."""
    pages = list(_pages(build_site(subject)))
    files: list[OutputFile] = []
    if "html" in formats:
        files.append(OutputFile("style.css", render("doc/style.css.jinja", mark=MARK)))
        files += [
            OutputFile(f"{p.path}.html", render_html_page(p, pages, subject.title)) for p in pages
        ]
    if "markdown" in formats:
        files += [OutputFile(f"{p.path}.md", render_markdown_page(p, subject.title)) for p in pages]
        blocks = (block for p in pages for block in p.blocks)
        figures = {block.name: block for block in blocks if isinstance(block, Figure)}
        files += [
            OutputFile(f"{figure.name}.svg", render_svg(figure.drawing))
            for figure in figures.values()
        ]
    return files


def _pages(site: DocumentationSite) -> Iterator[DocumentationPage]:
    """All pages, the first one first."""
    subject = site.subject
    yield index_page(site)
    yield from (deployment_page(deployment, site) for deployment in subject.deployments)
    yield from (bridge_page(bridge, site) for bridge in subject.bridges)
    yield from (component_page(component, site) for component in subject.components)
    pairs = [(interface, module) for module in site.modules for interface in module.interfaces]
    pairs.sort(key=lambda pair: (natural_sort_key(pair[0].name), pair[1].name))
    yield from (interface_page(*pair, site) for pair in pairs)
    yield from (module_page(model, site) for model in site.modules)
    yield from (parameters_page(parameter, site) for parameter in subject.parameters)
    yield from (machine_page(machine, site) for machine in subject.machines)
