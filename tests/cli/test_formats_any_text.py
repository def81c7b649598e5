"""Machine-readable formats hold the findings, with any text in them."""

from __future__ import annotations

import json
import re
from pathlib import Path, PureWindowsPath
from typing import Any
from urllib.parse import unquote_to_bytes

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft4Validator

from robocomp_dsl.cli.output import formats, sarif
from robocomp_dsl.diagnostics import Code, Diagnostic, Edit, Fix, Note, Severity
from robocomp_dsl.source import Source
from tests.cli.rcgen_run import Rcgen

SCHEMA = Path(__file__).parent / "sarif" / "sarif-2.1.0-rtm.5.json"
VALID = Draft4Validator(json.loads(SCHEMA.read_text()))
CASES = Path(__file__).parents[1] / "cases"
TEXTS = st.text(max_size=30) | st.text("a%:,\r\n\t\"'\\é机\U0001f916\u2028\x1b\x00 ", max_size=20)
# RFC 3986: what a reference may hold; a relative one has no colon before its first slash.
REFERENCE = re.compile(r"(file://)?(%[0-9A-F]{2}|[A-Za-z0-9._~/-])*")


def valid(text: str) -> dict[str, Any]:
    """A log that the standard's schema accepts."""
    log: dict[str, Any] = json.loads(text)
    errors = [f"{list(e.absolute_path)}: {e.message}" for e in VALID.iter_errors(log)]
    assert not errors
    return log


def test_sarif_schema_rejects_invalid_log() -> None:
    log = json.loads(formats.as_sarif([]))
    log["runs"][0]["tool"]["driver"].pop("name")
    assert not VALID.is_valid(log)


@pytest.mark.parametrize("language", sorted(p.name for p in CASES.iterdir() if p.is_dir()))
def test_formats_of_findings_of_all_cases(language: str, rcgen: Rcgen) -> None:
    worlds = sorted((CASES / language).glob("*.xml"))  # a folder is not searched for XML
    inputs = worlds or [CASES / language]
    run = rcgen("check", *inputs, "--format", "sarif")
    (only,) = valid(run.out)["runs"]
    found = json.loads(rcgen("check", *inputs, "--format", "json").out)
    assert [item["ruleId"] for item in only["results"]] == [item["code"] for item in found]
    for result in only["results"]:
        for place in result["locations"]:
            assert REFERENCE.fullmatch(place["physicalLocation"]["artifactLocation"]["uri"])


@settings(max_examples=150)
@given(texts=st.tuples(*[TEXTS] * 6), severity=st.sampled_from(Severity), at=st.integers(0, 9))
def test_formats_accept_any_text(texts: tuple[str, ...], severity: Severity, at: int) -> None:
    message, label, help_, edit, name, source = texts
    path = Path(name.replace("\0", "") or "x")
    here = Source(path, source).span(min(at, len(source)), len(source))
    fix = Fix(message, (Edit(here, edit),))
    code = Code("RC999", severity, "title", "explanation")
    item = Diagnostic(code, here, message, label, (Note(here, help_),), help_, fix)
    (result,) = valid(formats.as_sarif([item]))["runs"][0]["results"]
    assert result["message"]["text"] == "\n".join(t for t in (message, label, help_) if t)
    change = result["fixes"][0]["artifactChanges"][0]
    assert change["replacements"][0]["insertedContent"]["text"] == edit
    (record,) = json.loads(formats.as_json([item]))
    assert (record["message"], record["file"]) == (message, str(path))
    properties, text = annotation(formats.github([item]))
    assert text == message + (f": {label}" if label else "")
    assert properties["file"] == str(path)
    assert formats.concise([item]).count("\n") == 1


def annotation(line: str) -> tuple[dict[str, str], str]:
    """The parsed workflow command of a line, as GitHub runners parse it."""
    assert line.endswith("\n")
    assert not {"\r", "\n"} & set(line[:-1])
    found = re.fullmatch(r"::(?:error|warning|notice) (.*?)::(.*)", line[:-1], re.DOTALL)
    assert found
    pairs = (pair.split("=", 1) for pair in found[1].split(","))
    return {key: _plain(value) for key, value in pairs}, _plain(found[2])


def _plain(text: str) -> str:
    for written, meant in (("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ",")):
        text = text.replace(written, meant)
    return text.replace("%25", "%")


PATHS = {
    "a b.cdsl": "a%20b.cdsl",
    "a:b.cdsl": "a%3Ab.cdsl",
    "é/机.idsl": "%C3%A9/%E6%9C%BA.idsl",
    "100%.pdsl": "100%25.pdsl",
    "a?b#c": "a%3Fb%23c",
    "/tmp/a b": "file:///tmp/a%20b",
    "x\udcff.idsl": "x%FF.idsl",
}


@pytest.mark.parametrize("path", PATHS)
def test_sarif_uris_are_quoted(path: str) -> None:
    assert sarif._uri(Path(path)) == PATHS[path]


def test_sarif_uris_of_windows_paths() -> None:
    uri = sarif._uri
    assert uri(PureWindowsPath(r"C:\robots\a b.cdsl")) == "file:///C:/robots/a%20b.cdsl"  # type: ignore[arg-type]
    assert uri(PureWindowsPath(r"robots\a.cdsl")) == "robots/a.cdsl"  # type: ignore[arg-type]
    item = Source(Path("C:\\robots\\a,b.cdsl"), "x").span(0, 1)
    line = formats.github([Diagnostic(Code("RC999", Severity.ERROR, "", ""), item, "m")])
    assert "file=C%3A\\robots\\a%2Cb.cdsl," in line
    assert annotation(line)[0]["file"] == "C:\\robots\\a,b.cdsl"


def test_check_reports_file_name_with_invalid_bytes(rcgen: Rcgen, here: Path) -> None:
    (here / "x\udcff.idsl").write_text("module M { struct A { in x; }; };")
    for form in ("full", "concise", "json", "github", "sarif"):
        run = rcgen("check", ".", "--format", form)
        assert run.code == 1
        assert "internal error" not in run.err
    uri = valid(rcgen("check", ".", "--format", "sarif").out)["runs"][0]["results"][0]
    place = uri["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    assert unquote_to_bytes(place) == b"x\xff.idsl"
