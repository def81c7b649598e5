"""The check and the SCXML library in its safe mode reject the same documents."""

from __future__ import annotations

from pathlib import Path

import pytest
from statemachine.io import load

from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report

DOCUMENT = """\
<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" initial="a" datamodel="ecmascript">
<datamodel><data id="n" expr="0"/></datamodel>
<state id="a">{}</state>
<final id="f"/>
</scxml>
"""

# Content of a state, and whether a machine with it loads and starts.
PARTS = {
    '<transition event="go" cond="n === 1 &amp;&amp; true" target="f"/>': True,
    '<transition event="go" cond="n == 1 and not n" target="f"/>': True,
    '<transition event="go" cond="_event.data.x > 1" target="f"/>': True,
    '<transition event="go" cond="In(\'f\')" target="f"/>': True,
    '<transition event="go" cond="" target="f"/>': True,
    '<onentry><assign location="n" expr="n + 1"/></onentry>': True,
    '<onentry><foreach array="[1, 2]" item="i"><log expr="i"/></foreach></onentry>': True,
    '<onentry><send event="x" delay="1.5s"/></onentry>': True,
    "<onentry><script>x = 2</script></onentry>": False,
    '<onentry><assign location="n" expr="n++"/></onentry>': False,
    '<onentry><assign location="m" expr="1"/></onentry>': False,
    '<onentry><log expr="__import__(1)"/></onentry>': False,
    '<onentry><if cond="n.__class__"><raise event="q"/></if></onentry>': False,
    '<onentry><send event="x" delay="soon"/></onentry>': False,
    '<onentry><send event="x" target="http://x"/></onentry>': False,
    '<transition event="go" cond="limit()" target="f"/>': False,
    '<transition event="go" cond="!n" target="f"/>': False,
    '<transition event="go" cond="[i for i in n]" target="f"/>': False,
    '<transition event="go" cond="(lambda: 1)()" target="f"/>': False,
    '<invoke type="scxml" src="other.scxml"/>': False,
}


@pytest.mark.parametrize("part", PARTS)
def test_scxml_check_agrees_with_runtime(tmp_path: Path, part: str) -> None:
    path = tmp_path / "m.scxml"
    path.write_text(DOCUMENT.format(part))
    report = Report()
    check_file(path, Workspace(environ={}), report)
    rejected = [diagnostic.code.id for diagnostic in report if diagnostic.code.id == "RC710"]
    assert bool(rejected) is not PARTS[part]
    assert _starts(path.read_text()) is PARTS[part]


def _starts(text: str) -> bool:
    try:
        machine = load(text, format="scxml", trusted=False)
        type("Strict", (machine,), {"catch_errors_as_events": False})()
    except Exception:  # any exception of the library
        return False
    return True
