"""Output files are written all or none, and files of the user are kept."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.generate import write as writer
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, FileAction, compare, write

FILES = [
    OutputFile("main.py", "main\n"),
    OutputFile("generated/a.py", "a\n"),
    OutputFile("mine.py", "stub\n", write_once=True),
]


def tree(folder: Path) -> dict[str, str]:
    return {str(p.relative_to(folder)): p.read_text() for p in folder.rglob("*") if p.is_file()}


def test_write_creates_files(tmp_path: Path) -> None:
    changes = write(tmp_path / "deep" / "out", FILES)
    assert [c.action for c in changes] == [FileAction.CREATE] * 3
    assert tree(tmp_path / "deep" / "out") == {f.path: f.text for f in FILES}


def test_write_is_idempotent(tmp_path: Path) -> None:
    write(tmp_path, FILES)
    stamps = {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")}
    changes = write(tmp_path, FILES)
    assert [c.action for c in changes] == [FileAction.SAME, FileAction.SAME, FileAction.KEEP]
    assert {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")} == stamps


def test_write_keeps_user_files(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text("my own\n")
    (tmp_path / "other.txt").write_text("other\n")
    write(tmp_path, FILES)
    assert tree(tmp_path)["mine.py"] == "my own\n"
    assert tree(tmp_path)["other.txt"] == "other\n"


def test_write_keeps_dangling_link_of_user(tmp_path: Path) -> None:
    (tmp_path / "mine.py").symlink_to(tmp_path / "nowhere")
    write(tmp_path, FILES)
    assert (tmp_path / "mine.py").is_symlink()
    assert not (tmp_path / "nowhere").exists()


def test_compare_writes_nothing(tmp_path: Path) -> None:
    (tmp_path / "main.py").write_text("old\n")
    changes = compare(tmp_path, FILES)
    assert [c.action for c in changes] == [FileAction.UPDATE, FileAction.CREATE, FileAction.CREATE]
    assert changes[0].old == b"old\n"
    assert tree(tmp_path) == {"main.py": "old\n"}
    assert not compare(tmp_path / "absent", FILES[:1])[0].old


def test_write_keeps_file_mode(tmp_path: Path) -> None:
    (tmp_path / "main.py").write_text("old\n")
    (tmp_path / "main.py").chmod(0o751)
    write(tmp_path, FILES)
    assert (tmp_path / "main.py").stat().st_mode & 0o777 == 0o751


def test_write_removes_temporary_files_of_killed_writer(tmp_path: Path) -> None:
    (tmp_path / f".main.py{writer.TEMPORARY}").write_text("half")
    write(tmp_path, FILES)
    assert tree(tmp_path) == {f.path: f.text for f in FILES}


@pytest.mark.parametrize("nth", [1, 2, 3])
def test_write_rolls_back_after_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, nth: int
) -> None:
    (tmp_path / "main.py").write_text("old\n")
    calls = []
    replace = Path.replace

    def failing(self: Path, target: Path) -> Path:
        calls.append(target)
        if len(calls) == nth:
            raise OSError(28, "No space left on device", str(target))
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", failing)
    with pytest.raises(CannotWrite, match="the disk is full"):
        write(tmp_path, FILES)
    assert tree(tmp_path) == {"main.py": "old\n"}
    assert not (tmp_path / "generated").exists()


def test_write_replaces_files_only_after_fsync_of_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All files are synchronised before the first is replaced; a failure stops all."""
    (tmp_path / "main.py").write_text("old\n")
    synced: list[str] = []

    def failing(descriptor: int) -> None:
        path = Path(f"/proc/self/fd/{descriptor}").readlink()
        synced.append(path.name)
        if path.name == f".a.py{writer.TEMPORARY}":
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", failing)
    with pytest.raises(CannotWrite, match=r"`\S+generated/a.py`: the disk is full"):
        write(tmp_path, FILES)
    assert tree(tmp_path) == {"main.py": "old\n"}
    temporaries = {f".{Path(f.path).name}{writer.TEMPORARY}" for f in FILES}
    assert temporaries <= {*synced}


def test_write_rolls_back_after_keyboard_interrupt(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(self: Path, target: Path) -> Path:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write(tmp_path / "out", FILES)
    assert list(tmp_path.iterdir()) == []


BLOCKED = [
    ("out", "", "`OUT` is a file, not a folder"),
    ("out/generated", "", "a file, not a folder"),
    ("out/main.py/x", "", "`OUT/main.py` is a folder"),
]


@pytest.mark.parametrize(("path", "text", "message"), BLOCKED)
def test_write_reports_file_or_folder_in_the_way(
    tmp_path: Path, path: str, text: str, message: str
) -> None:
    blocker = tmp_path / path
    blocker.parent.mkdir(parents=True, exist_ok=True)
    blocker.write_text(text)
    before = tree(tmp_path)
    with pytest.raises(CannotWrite) as caught:
        write(tmp_path / "out", FILES)
    assert message.replace("OUT", str(tmp_path / "out")) in str(caught.value)
    assert tree(tmp_path) == before


def test_write_rejects_links_out_of_output_folder(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "generated").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(CannotWrite, match="a link that leads out of"):
        write(tmp_path / "out", FILES)
    assert list((tmp_path / "elsewhere").iterdir()) == []
    (tmp_path / "out" / "generated").unlink()
    (tmp_path / "out" / "main.py").symlink_to(tmp_path / "elsewhere" / "main.py")
    with pytest.raises(CannotWrite, match="is a link; remove it"):
        write(tmp_path / "out", FILES)


def test_write_accepts_link_as_output_folder(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "real")
    write(tmp_path / "out", FILES)
    assert tree(tmp_path / "real") == {f.path: f.text for f in FILES}


WRITE = """
import sys
from pathlib import Path
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write
try:
    write(Path("out"), [OutputFile(f"generated/{i}.py", sys.argv[1] * 1000) for i in range(20)])
except CannotWrite as error:
    sys.exit(str(error))
"""


def test_write_reports_file_size_limit(tmp_path: Path) -> None:
    """A limit of the file size makes the write fail, as a full disk does."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (500, 500))

    done = subprocess.run(
        [sys.executable, "-c", WRITE, "x"],
        cwd=tmp_path,
        preexec_fn=limit,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        check=False,
    )
    assert done.returncode == 1
    assert "the limit for the size of files is reached" in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def unprivileged_user() -> Iterator[None]:
    """Run as a user without privileges if the tests run as root."""
    user = os.geteuid()
    if user == 0:
        os.seteuid(65534)
    yield
    os.seteuid(user)


def test_write_reports_unwritable_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    tmp_path.chmod(0o555)
    monkeypatch.chdir(tmp_path)
    request.getfixturevalue("unprivileged_user")
    with pytest.raises(CannotWrite, match="cannot write `out`: you may not write there"):
        write(Path("out"), FILES)
    with pytest.raises(CannotWrite, match=r"you may not write there"):
        write(tmp_path / "out", FILES)


def test_concurrent_writes_are_serialized(tmp_path: Path) -> None:
    """The last writer wins: all files are of the same writer."""
    for _ in range(3):
        both = [
            subprocess.Popen([sys.executable, "-c", WRITE, word], cwd=tmp_path)
            for word in ("a", "b")
        ]
        assert [writer.wait(60) for writer in both] == [0, 0]
        texts = set(tree(tmp_path / "out").values())
        assert len(texts) == 1
        assert len(tree(tmp_path / "out")) == 20


def test_write_reports_lock_timeout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(writer, "LOCK_TIMEOUT_S", 0.05)
    with writer._locked(tmp_path), pytest.raises(CannotWrite, match="another rcgen is writing"):
        write(tmp_path, FILES)
