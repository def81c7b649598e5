"""Variants of XML: declarations, encodings, comments, text content."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen.check import command
from robocomp_dsl.diagnostics import Report, Severity

TREE = '<innerModel><transform id="a"><imu id="b"/></transform></innerModel>'


def nodes(path: Path) -> tuple[list[str], list[str]]:
    report = Report()
    found = check_innermodel(path, Workspace(environ={}), report)
    return [n.id for n, _ in found.nodes()] if found else [], [
        f"{d.code.id} {d.span.start_position[0]}:{d.span.start_position[1]}" for d in report
    ]


@pytest.mark.parametrize(
    "data",
    [
        TREE,
        f'<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n{TREE}',
        f"<!-- before -->\n{TREE}\n<!-- behind -->\n<?end?>\n",
        TREE.replace("><", ">\r\n<!-- a <b> & 'c' -->\r\n<"),
        TREE.replace('id="a"', "id='a'\n\ttx = '1'"),
        TREE.upper().replace("ID=", "id=").replace('"A"', '"a"').replace('"B"', '"b"'),
        TREE.replace("<innerModel>", '<innerModel xmlns:xsi="http://w" xsi:schemaLocation="x">'),
        TREE.replace('"a"', '"&#97;"').replace('"b"', '"&#x62;"'),
        b"\xef\xbb\xbf" + TREE.encode(),
        TREE.encode() + b"\n\n",
        f'<?xml version="1.0" encoding="ISO-8859-1"?><!-- \xf1 -->{TREE}'.encode("latin-1"),
        f"<?xml version='1.0' encoding='latin1'?><!-- \xf1 -->{TREE}".encode("latin-1"),
        f'<?xml version="1.0" encoding="windows-1252"?><!-- \u20ac -->{TREE}'.encode("cp1252"),
        f'<?xml version="1.0" encoding="ISO-8859-1"?><!-- \xf1 -->{TREE}'.encode(),
    ],
)
def test_xml_variants_are_read_without_findings(tmp_path: Path, data: str | bytes) -> None:
    path = tmp_path / "w.xml"
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    assert nodes(path) == (["root", "a", "b"], [])


@pytest.mark.parametrize(
    ("data", "findings"),
    [
        (f"<!DOCTYPE innerModel SYSTEM 'im.dtd'>{TREE}", ["RC185 1:1"]),
        (TREE.replace("<imu", "<![CDATA[ a < b ]]><imu"), ["RC184 1:31"]),
        (TREE.replace("<imu", "left <imu"), ["RC184 1:31"]),
        (TREE.replace('id="b"', 'id="b" port="1" port="2"'), ["RC181 1:52"]),
        (TREE.replace('id="b"', 'id="b" ;'), ["RC180 1:43"]),
        (TREE.replace("</transform>", "</transfrom>"), ["RC182 1:46"]),
        (TREE.replace("</transform>", ""), ["RC182 1:14"]),
        (TREE.replace("<imu", "</joint><imu"), ["RC182 1:31"]),
        (TREE.encode("utf-16"), ["RC001 1:1"]),
        (f"<!-- \xf1 -->{TREE}".encode("latin-1"), ["RC001 1:1"]),
    ],
)
def test_xml_errors_are_reported_with_location(
    tmp_path: Path, data: str | bytes, findings: list[str]
) -> None:
    path = tmp_path / "w.xml"
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    found, received = nodes(path)
    assert received == findings
    assert found == ([] if "RC001 1:1" in received else ["root", "a", "b"])


def test_xml_elements_around_error_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "w.xml"
    wrong = '<joint id="j7" tx="1" tx="2" %><imu id="i"/> stray </joint>'
    right = "".join(f'<plane id="p{i}" size="1"/>' for i in range(50))
    path.write_text(
        f'<innerModel><transform id="t">{right}{wrong}{right.replace(chr(34) + "p", chr(34) + "q")}'
    )
    found, received = nodes(path)
    assert len(found) == 1 + 1 + 50 + 2 + 50
    assert {item.split()[0] for item in received} >= {"RC180", "RC181", "RC182", "RC184"}


def test_xml_fix_updates_declared_encoding(tmp_path: Path) -> None:
    path = tmp_path / "w.xml"
    head = '<?xml version="1.0" encoding="ISO-8859-1"?><!-- \xf1 -->'
    path.write_bytes((head + TREE.replace('id="a"', 'id="a" id="a"')).encode("latin-1"))
    done = CliRunner().invoke(command, ["--fix", str(path)])
    assert done.exit_code == 0
    assert path.read_text(encoding="utf-8").startswith(head.replace("ISO-8859-1", "UTF-8"))
    assert nodes(path) == (["root", "a", "b"], [])


def test_xml_text_content_is_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "w.xml"
    path.write_text(TREE.replace("<imu", "left <imu"))
    report = Report()
    check_innermodel(path, Workspace(environ={}), report)
    assert [d.severity for d in report] == [Severity.WARNING]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("../../.git/annex/objects/QF/zv/SHA256E-s970--77.xml/SHA256E-s970--77.xml", "git-annex"),
        ("version https://git-lfs.github.com/spec/v1\noid sha256:4d\nsize 1\n", "Git LFS"),
    ],
)
def test_xml_placeholder_of_git_annex_or_lfs_is_reported(
    tmp_path: Path, text: str, message: str
) -> None:
    path = tmp_path / "w.xml"
    path.write_text(text)
    report = Report()
    check_innermodel(path, Workspace(environ={}), report)
    (finding,) = report
    assert finding.code.id == "RC001"
    assert f"{message}" in finding.message


@pytest.mark.parametrize(
    ("text", "help"),
    [
        ("<rcmanager/>", "a deployment for rcmanager"),
        ('<AGMModel id="a"/>', "a world model for AGM"),
        ("<scxml/>", "a state machine"),
        ("<transform/>", ""),
    ],
)
def test_xml_of_other_root_element_is_reported(tmp_path: Path, text: str, help: str) -> None:
    path = tmp_path / "w.xml"
    path.write_text(text)
    report = Report()
    check_innermodel(path, Workspace(environ={}), report)
    (finding,) = report
    assert finding.code.id == "RC801"
    assert help in finding.help
    assert bool(help) == bool(finding.help)


def test_xml_comment_ends_at_first_terminator(tmp_path: Path) -> None:
    """A comment ends at the first `-->`."""
    path = tmp_path / "w.xml"
    path.write_text(TREE.replace("<imu", "<!-- <!-- <imu id='x'/> --> <imu"))
    assert nodes(path) == (["root", "a", "b"], ["RC187 1:36"])
