"""Any doc comment appears unchanged in HTML and in rendered Markdown."""

from __future__ import annotations

from pathlib import Path

from hypothesis import example, given, settings
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.documentation import DocumentationSubject, documentation
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Source
from tests.doc.doc_site import read

SIGNS = "ab1 \n\t`*_[](){}<>#+-=.!|~&;:$@^\\/\"'\u00e9\u4e2d\u202e\x07"
TEXTS = st.text(st.sampled_from(SIGNS) | st.characters(exclude_categories=["Cs"]), max_size=60)
READER = MarkdownIt("commonmark", {"html": True, "xhtmlOut": False}).enable(
    ["table", "strikethrough"]
)


def _pages(doc: str) -> dict[str, str]:
    span = Source(Path("c.cdsl"), "c").file_span
    component = Component("c", Path("c.cdsl"), span, "Python", (), (), doc=doc)
    return {
        f.path: f.text for f in documentation(DocumentationSubject("t", components=(component,)))
    }


def _bare(text: str) -> str:
    return "".join(text.split())


@settings(max_examples=300)
@given(TEXTS)
@example("- a\n- b\n\n1. c")
@example("a\n===\n# b\n> c\n    d")
@example("`a|b` ``x`` ` `")
@example("&amp; &#60; <!-- <br> http://a.b [x]: y")
def test_doc_page_shows_any_doc_comment(doc: str) -> None:
    pages_ = _pages(doc)
    html = pages_["components/c.html"]
    texts = read(html[html.index("</dl>") + len("</dl>") : html.index("</main>")])
    assert set(texts.tags) <= {"p", "ul", "li", "code"}
    letters = _bare("".join(literals.lines(doc)))
    for sign in "`-+*":  # back quotes and list markers are dropped
        letters = letters.replace(sign, "")
    assert [c for c in _bare(texts.text) if c not in "`-+*"] == list(letters)
    markdown = READER.render(pages_["components/c.md"])
    facts = "every 100 ms</p>"
    page = read(markdown[markdown.index(facts) + len(facts) :])
    assert _bare(page.text) == _bare(texts.text)
    assert [tag for tag in page.tags if tag != "p"] == [tag for tag in texts.tags if tag != "p"]
