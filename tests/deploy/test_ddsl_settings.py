"""`param set --ddsl`: the file is changed in one place, and stays what the user wrote elsewhere."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.deploy.ddsl_settings import (
    CannotEdit,
    WrittenSetting,
    edit_text,
    find_setting,
    format_ddsl_literal,
    format_ddsl_value,
    write_settings,
)

TEXT = """\
import "arm.cdsl";
// The robot. { set rate = 1; }
Deployment app
{
    component arm : arm { set  rate=20 ; /* fast */ set motors[2] . min = -1.5; };
    component eye
    {
        after arm;   // and then
        set serial = "a\\"b";
        set rate = 5;
    };
    component plain;
    component empty on localhost { };
    component wide
    {
        after arm;
    };
    group left
    {
        component arm { prefix "far/away"; set rate = 7; };
    };
    group right : side on localhost;
    group both { prefix far; set upper.arm.rate = 6; group upper : side { set hand.rate = 3; }; };
};
"""


@pytest.mark.parametrize(
    ("instance", "parameter", "literal", "old", "new"),
    [
        ("arm", "rate", "30", "set  rate=20 ;", "set  rate=30 ;"),
        ("arm", "motors[2].min", "0.5", "min = -1.5", "min = 0.5"),
        ("arm", "motors[1].min", "2", "min = -1.5;", "min = -1.5; set motors[1].min = 2;"),
        ("eye", "serial", '"x"', '"a\\"b"', '"x"'),
        ("eye", "new", "1", "set rate = 5;", "set rate = 5;\n        set new = 1;"),
        ("plain", "rate", "1", "plain;", "plain { set rate = 1; };"),
        ("empty", "rate", "1", "localhost { }", "localhost { set rate = 1; }"),
        ("wide", "rate", "1", "wide\n    {", "wide\n    {\n        set rate = 1;"),
        ("far/away/left-arm", "rate", "8", "set rate = 7", "set rate = 8"),
        ("right-arm", "rate", "8", "localhost;", "localhost { set arm.rate = 8; };"),
        ("right-hand-tip", "rate", "8", "localhost;", "localhost { set hand.tip.rate = 8; };"),
        ("far/both-upper-arm", "rate", "8", "arm.rate = 6", "arm.rate = 8"),
        ("far/both-upper-hand", "rate", "8", "hand.rate = 3", "hand.rate = 8"),
        ("far/both-upper-arm", "x", "1", "rate = 3;", "rate = 3; set arm.x = 1;"),
    ],
)
def test_ddsl_settings_are_changed_in_place(
    tmp_path: Path, instance: str, parameter: str, literal: str, old: str, new: str
) -> None:
    for text in (TEXT, TEXT.replace("\n", "\r\n")):
        ends = "\r\n" if "\r" in text else "\n"
        file = tmp_path / "app.ddsl"
        file.write_bytes(text.encode())
        file.chmod(0o640)
        write_settings(file, instance, {parameter: literal})
        replaced = text.replace(old.replace("\n", ends), new.replace("\n", ends), 1)
        assert file.read_bytes().decode() == replaced
        assert replaced != text
        assert file.stat().st_mode & 0o777 == 0o640
        found = find_setting(file, instance, parameter)
        assert found is not None
        assert found.value == literal
        assert list(tmp_path.iterdir()) == [file]


def test_ddsl_settings_are_found_with_their_place(tmp_path: Path) -> None:
    file = tmp_path / "app.ddsl"
    file.write_text(TEXT)
    assert find_setting(file, "eye", "rate") == WrittenSetting("app.ddsl:10", "5")
    assert find_setting(file, "arm", "motors[ 2 ].min") is None
    assert find_setting(file, "eye", "rat") is None
    assert find_setting(file, "nobody", "rate") is None
    assert find_setting(tmp_path / "gone.ddsl", "eye", "rate") is None


def test_ddsl_settings_that_cannot_be_written(tmp_path: Path) -> None:
    path = Path("app.ddsl")
    with pytest.raises(CannotEdit, match="no component `nobody`"):
        edit_text(TEXT, path, "nobody", "rate", "1")
    with pytest.raises(CannotEdit, match=r"app\.ddsl has errors"):
        edit_text(TEXT.replace("component plain;", "component plain {"), path, "eye", "rate", "1")
    with pytest.raises(CannotEdit, match=r"write `set rate = 1;` into app\.ddsl yourself"):
        edit_text(TEXT.replace("plain;", "plain /* { */ { };"), path, "plain", "rate", "1")
    with pytest.raises(CannotEdit, match="cannot be written: No such file"):
        write_settings(tmp_path / "gone.ddsl", "arm", {"rate": "1"})


@pytest.mark.parametrize(
    ("value", "is_text", "literal"),
    [
        ("30", False, "30"),
        ("-1.5e3", False, "-1.5e3"),
        ("true", False, "true"),
        ("12", True, '"12"'),
        ('a "b" \\', False, '"a \\"b\\" \\\\"'),
    ],
)
def test_ddsl_settings_literals(value: str, is_text: bool, literal: str) -> None:
    assert format_ddsl_literal(value, is_text=is_text) == literal


@pytest.mark.parametrize(
    ("parameter", "text", "value"),
    [
        ("weights", "1, 2.5", "{1, 2.5}"),
        ("weights", "[1]", "{1}"),
        ("weights", "[]", "{}"),
        ("weights[2]", " 3", "3"),
        ("names", '["a, b", c, 1]', '{"a, b", "c", "1"}'),
        ("names[0]", "1", '"1"'),
        ("modes", "a,b", '{"a", "b"}'),
        ("flags", "true,false", "{true, false}"),
        ("motors[0].min", "1", "1"),
        ("rate", "20", "20"),
    ],
)
def test_ddsl_settings_of_lists(parameter: str, text: str, value: str) -> None:
    types = {
        "weights": "float[1:8]",
        "names": "string[]",
        "modes": "choice[2]",
        "flags": "bool[2]",
        "motors[0].min": "float",
        "rate": "float",
    }
    assert format_ddsl_value(parameter, text, types) == value
