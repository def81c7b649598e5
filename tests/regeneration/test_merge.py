"""Files that are written once: changes of rcgen and the user are merged, or the user's remain."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write
from tests.regeneration.talker_component import TalkerComponent

RATE = "/** How often. */ rate float 1;"


@pytest.fixture
def config(talker: TalkerComponent) -> Path:
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a";')
    talker.generate()
    return talker.folder / "etc" / "config.yaml"


def test_merge_rewrites_unchanged_config(talker: TalkerComponent, config: Path) -> None:
    talker.describe("int say(Word w);", parameters=f"{RATE} size int 3;")
    assert talker.generate() == []
    assert "size: 3" in config.read_text()
    assert "name:" not in config.read_text()


def test_merge_combines_changes_in_different_places(talker: TalkerComponent, config: Path) -> None:
    config.write_text(config.read_text().replace("rate: 1.0", "rate: 7.5  # measured"))
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a"; size int 3;')
    (found,) = talker.generate()
    assert found.code.id == "RC618"
    assert found.span.start_position[0] > 1
    text = config.read_text()
    assert "rate: 7.5  # measured\n" in text
    assert "size: 3\n" in text
    assert talker.generate() == []


def test_merge_keeps_line_ends(talker: TalkerComponent, config: Path) -> None:
    text = config.read_text().replace("rate: 1.0", "rate: 7.5").replace("\n", "\r\n")
    config.write_bytes(text.encode())
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a"; size int 3;')
    talker.generate()
    data = config.read_bytes()
    assert b"size: 3\r\n" in data
    assert b"\n" not in data.replace(b"\r\n", b"")


def test_merge_conflict_keeps_user_file_and_writes_proposal(
    talker: TalkerComponent, config: Path
) -> None:
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


def test_merge_without_git_keeps_user_file(
    talker: TalkerComponent, config: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mine = config.read_text() + "# mine\n"
    config.write_text(mine)
    monkeypatch.setenv("PATH", str(talker.folder))
    talker.describe("int say(Word w);", parameters=f"{RATE} size int 3;")
    (found,) = talker.generate()
    assert found.code.id == "RC619"
    assert "git" in found.message
    assert config.read_text() == mine


def test_deleted_config_is_written_again(talker: TalkerComponent, config: Path) -> None:
    config.unlink()
    talker.generate()
    assert config.is_file()


def test_merge_keeps_invalid_bytes(talker: TalkerComponent, config: Path) -> None:
    config.write_bytes(b"# \xff\xfe\n" + config.read_bytes())
    talker.describe("int say(Word w);", parameters=f'{RATE} name string "a"; size int 3;')
    talker.generate()
    data = config.read_bytes()
    assert data.startswith(b"# \xff\xfe\n")
    assert b"size: 3\n" in data


def test_write_rejects_file_changed_meanwhile(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("newer")
    with pytest.raises(CannotWrite, match="meanwhile; run rcgen again"):
        write(tmp_path, [OutputFile("a.txt", "merged", expected_bytes=b"older")])
    assert (tmp_path / "a.txt").read_text() == "newer"
