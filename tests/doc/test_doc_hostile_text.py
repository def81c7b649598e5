"""Texts of users appear unchanged and are never markup, in HTML and Markdown."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from tests.doc.doc_site import check_links, pages, read

HOSTILE = (
    "</title><script>alert(1)</script> <img src=x onerror=y> &lt; & `<b>code</b>` | **bold** "
    "[x](javascript:1) _it_ --> ]]> {{ 7 * 7 }} {% raw %} $x$ ~~no~~ # not a heading \"q\" 'q' \\ "
)
VISIBLE = HOSTILE.replace("`", "")
FILES = {
    "<b>&.idsl": f"""
        /** {HOSTILE} */
        module Hostile {{
            /** {HOSTILE} */
            struct S {{ /** {HOSTILE} */ string a = "<script>{{{{ x }}}}</script>|";
                int len; }};
            /** {HOSTILE} */
            enum E {{ /** {HOSTILE} */ one }};
            /** {HOSTILE} */
            exception Bad {{ string what; }};
            /** - {HOSTILE} */
            interface I {{ /** {HOSTILE} */ S get(E e) throws Bad;
                /** 1. {HOSTILE} */ void put(S s); }};
        }};""",
    "hostile.pdsl": f"""
        /** {HOSTILE} */
        ComponentParams hostile {{ /** {HOSTILE} */ name string "<i>|`</i>";
            mode {{ a, b }} a [<u>] live; }};
        """,
    "hostile.smdsl": f"""
        /** {HOSTILE} */
        hostile {{ initial_state /** {HOSTILE} */ a; states b;
            transitions {{ /** {HOSTILE} */ a => b on go; b => a; }}; }};""",
    "hostile.cdsl": f"""
        import "<b>&.idsl";
        /** {HOSTILE} */
        Component hostile {{ Communications {{ implements I; }}; language Python;
            parameters "hostile.pdsl"; statemachine "hostile.smdsl"; }};""",
    "hostile.ddsl": f"""
        import "hostile.cdsl";
        /** {HOSTILE} */
        Deployment hostile {{
            host far {{ address "10.0.0.2"; }};
            /** {HOSTILE} */
            component hostile {{
                set name = "<script>|`"; env X = "<p onclick=1>|"; executable "a <b> | c"; }};
        }};""",
}


@pytest.fixture
def hostile(tmp_path: Path) -> dict[str, str]:
    """The pages of files with hostile texts."""
    for name, text_ in FILES.items():
        (tmp_path / name).write_text(text_, encoding="utf-8")
    return pages(tmp_path / "hostile.ddsl", title="<script>x</script>")


def _bare(text: str) -> str:
    """A text without whitespace."""
    return "".join(text.split())


def test_html_page_escapes_hostile_text(hostile: dict[str, str]) -> None:
    check_links(hostile)
    for path, text in hostile.items():
        if path.endswith(".html"):
            page = read(text)
            assert not {"script", "img", "b", "i", "s", "u"} & set(page.tags), path
            assert "49" not in page.text
    shown = _bare(read(hostile["interfaces/Hostile.I.html"]).text)
    assert shown.count(_bare(VISIBLE)) == 9
    assert '"<script>{{x}}</script>|"' in shown
    assert _bare(VISIBLE) in _bare(read(hostile["components/hostile.html"]).text)
    deployed = _bare(read(hostile["deployments/hostile.html"]).text)
    for text_ in (VISIBLE, '$X = "<p onclick=1>|"', "runs a <b> | c", 'name = "<script>|`"'):
        assert _bare(text_) in deployed


def test_markdown_page_renders_as_html_page(hostile: dict[str, str]) -> None:
    """Rendered Markdown has the text of the HTML page."""
    reader = MarkdownIt("commonmark", {"html": True, "xhtmlOut": False}).enable(
        ["table", "strikethrough"]
    )
    for path, text in hostile.items():
        if not path.endswith(".md"):
            continue
        markdown = read(reader.render(re.sub(r"(?m)^Types: \[.*", "", text)))
        assert not {"script", "b", "i", "s", "u", "p onclick"} & set(markdown.tags), path
        html = hostile[path.replace(".md", ".html")]
        main = html[html.index("<h1>") : html.index("</main>")]
        main = re.sub(r"<figure>.*?</figure>", "", main, flags=re.DOTALL)
        main = re.sub(r' <a class="anchor".*?</a>', "", main)
        theirs = _bare(read(f"<div>{main}</div>".replace("</header>", "")).text)
        ours = _bare(markdown.text)
        ours = ours[ours.index(theirs[:6]) :] if path == "index.md" else ours
        assert re.sub("[:·]", "", ours).endswith(re.sub(":", "", theirs)), path


def test_drawings_of_hostile_text_are_valid_svg(hostile: dict[str, str]) -> None:
    drawings = [text for path, text in hostile.items() if path.endswith(".svg")]
    assert len(drawings) == 3
    for text in drawings:
        tags = {element.tag.rpartition("}")[2] for element in ET.fromstring(text).iter()}
        assert tags <= {"svg", "title", "style", "rect", "g", "path", "text"}
