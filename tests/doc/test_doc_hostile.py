"""What users write is told as they wrote it, and is never markup, in neither form."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from tests.doc.doc_site import check_links, pages, read

EVIL = (
    "</title><script>alert(1)</script> <img src=x onerror=y> &lt; & `<b>code</b>` | **bold** "
    "[x](javascript:1) _it_ --> ]]> {{ 7 * 7 }} {% raw %} $x$ ~~no~~ # not a heading \"q\" 'q' \\ "
)
TELLING = EVIL.replace("`", "")
FILES = {
    "<b>&.idsl": f"""
        /** {EVIL} */
        module Evil {{
            /** {EVIL} */
            struct S {{ /** {EVIL} */ string a = "<script>{{{{ x }}}}</script>|";
                int len [a<b|c]; }};
            /** {EVIL} */
            enum E {{ /** {EVIL} */ one }};
            /** {EVIL} */
            exception Bad {{ string what; }};
            /** - {EVIL} */
            interface I {{ /** {EVIL} */ S get(E e) throws Bad; /** 1. {EVIL} */ void put(S s); }};
        }};""",
    "evil.pdsl": f"""
        /** {EVIL} */
        ComponentParams evil {{ /** {EVIL} */ name string "<i>|`</i>";
            mode {{ a, b }} a [<u>] live; }};
        """,
    "evil.smdsl": f"""
        /** {EVIL} */
        evil {{ initial_state /** {EVIL} */ a; states b;
            transitions {{ /** {EVIL} */ a => b on go; b => a; }}; }};""",
    "evil.cdsl": f"""
        import "<b>&.idsl";
        /** {EVIL} */
        Component evil {{ Communications {{ implements I; }}; language Python;
            parameters "evil.pdsl"; statemachine "evil.smdsl"; }};""",
    "evil.ddsl": f"""
        import "evil.cdsl";
        /** {EVIL} */
        Deployment evil {{
            host far {{ address "10.0.0.2"; }};
            /** {EVIL} */
            component evil {{
                set name = "<script>|`"; env X = "<p onclick=1>|"; executable "a <b> | c"; }};
        }};""",
}


@pytest.fixture
def evil(tmp_path: Path) -> dict[str, str]:
    """The pages of files that try everything."""
    for name, text_ in FILES.items():
        (tmp_path / name).write_text(text_, encoding="utf-8")
    return pages(tmp_path / "evil.ddsl", title="<script>x</script>")


def _bare(text: str) -> str:
    """Letters, digits and signs of a text, without any blanks."""
    return "".join(text.split())


def test_html_says_it_and_obeys_nothing(evil: dict[str, str]) -> None:
    check_links(evil)
    for path, text in evil.items():
        if path.endswith(".html"):
            seen = read(text)
            assert not {"script", "img", "b", "i", "s", "u"} & set(seen.tags), path
            assert "49" not in seen.text
    shown = _bare(read(evil["interfaces/Evil.I.html"]).text)
    assert shown.count(_bare(TELLING)) == 9
    assert '"<script>{{x}}</script>|"' in shown
    assert _bare(TELLING) in _bare(read(evil["components/evil.html"]).text)
    deployed = _bare(read(evil["deployments/evil.html"]).text)
    for text_ in (TELLING, '$X = "<p onclick=1>|"', "runs a <b> | c", 'name = "<script>|`"'):
        assert _bare(text_) in deployed


def test_markdown_says_the_same(evil: dict[str, str]) -> None:
    """A reader of Markdown makes of a page what the other form of it is."""
    reader = MarkdownIt("commonmark", {"html": True, "xhtmlOut": False}).enable(
        ["table", "strikethrough"]
    )
    for path, text in evil.items():
        if not path.endswith(".md"):
            continue
        markdown = read(reader.render(re.sub(r"(?m)^Types: \[.*", "", text)))
        assert not {"script", "b", "i", "s", "u", "p onclick"} & set(markdown.tags), path
        html = evil[path.replace(".md", ".html")]
        main = html[html.index("<h1>") : html.index("</main>")]
        main = re.sub(r"<figure>.*?</figure>", "", main, flags=re.DOTALL)
        main = re.sub(r' <a class="anchor".*?</a>', "", main)
        theirs = _bare(read(f"<div>{main}</div>".replace("</header>", "")).text)
        ours = _bare(markdown.text)
        ours = ours[ours.index(theirs[:6]) :] if path == "index.md" else ours
        assert re.sub("[:·]", "", ours).endswith(re.sub(":", "", theirs)), path


def test_drawings_are_xml(evil: dict[str, str]) -> None:
    drawings = [text for path, text in evil.items() if path.endswith(".svg")]
    assert len(drawings) == 3
    for text in drawings:
        tags = {element.tag.rpartition("}")[2] for element in ET.fromstring(text).iter()}
        assert tags <= {"svg", "title", "style", "rect", "g", "path", "text"}
