"""Files that are written once: both sides' changes come together, or the user's stay."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write
from tests.regeneration.regenerated import Talker

RATE = "/** How often. */ rate float 1;"


@pytest.fixture
def config(talker: Talker) -> Path:
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a";')
    talker.generate()
    return talker.folder / "etc" / "config.yaml"


def test_untouched_is_written_anew(talker: Talker, config: Path) -> None:
    talker.describe("int say(Word w);", parameters=f"{RATE} size int 3;")
    assert talker.generate() == []
    assert "size: 3" in config.read_text()
    assert "name:" not in config.read_text()


def test_both_sides_in_different_places(talker: Talker, config: Path) -> None:
    config.write_text(config.read_text().replace("rate: 1.0", "rate: 7.5  # measured"))
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a"; size int 3;')
    (found,) = talker.generate()
    assert found.code.id == "RC618"
    assert found.span.start_position[0] > 1
    text = config.read_text()
    assert "rate: 7.5  # measured\n" in text
    assert "size: 3\n" in text
    assert talker.generate() == []


def test_line_ends_stay(talker: Talker, config: Path) -> None:
    text = config.read_text().replace("rate: 1.0", "rate: 7.5").replace("\n", "\r\n")
    config.write_bytes(text.encode())
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a"; size int 3;')
    talker.generate()
    data = config.read_bytes()
    assert b"size: 3\r\n" in data
    assert b"\n" not in data.replace(b"\r\n", b"")


def test_the_same_lines(talker: Talker, config: Path) -> None:
    mine = config.read_text().replace('name: "a"', 'name: "mine"')
    config.write_text(mine)
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "b";')
    (found,) = talker.generate()
    assert found.code.id == "RC619"
    assert ".rcgen/conflicts/etc/config.yaml" in found.help
    assert (found.span.text, found.label) == ('name: "mine"', 'rcgen has `name: "b"` here')
    assert config.read_text() == mine
    proposal = (talker.folder / ".rcgen/conflicts/etc/config.yaml").read_text()
    assert (
        '<<<<<<< yours\nname: "mine"\n||||||| before\nname: "a"\n=======\nname: "b"\n' in proposal
    )
    assert talker.generate() == []


def test_without_git(talker: Talker, config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mine = config.read_text() + "# mine\n"
    config.write_text(mine)
    monkeypatch.setenv("PATH", str(talker.folder))
    talker.describe("int say(Word w);", parameters=f"{RATE} size int 3;")
    (found,) = talker.generate()
    assert found.code.id == "RC619"
    assert "git" in found.message
    assert config.read_text() == mine


def test_deleted_comes_again(talker: Talker, config: Path) -> None:
    config.unlink()
    talker.generate()
    assert config.is_file()


def test_no_bytes_are_lost(talker: Talker, config: Path) -> None:
    config.write_bytes(b"# \xff\xfe\n" + config.read_bytes())
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a"; size int 3;')
    talker.generate()
    data = config.read_bytes()
    assert data.startswith(b"# \xff\xfe\n")
    assert b"size: 3\n" in data


def test_saved_by_somebody_else_meanwhile(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("newer")
    with pytest.raises(CannotWrite, match="meanwhile; run rcgen again"):
        write(tmp_path, [OutputFile("a.txt", "merged", expected_bytes=b"older")])
    assert (tmp_path / "a.txt").read_text() == "newer"
