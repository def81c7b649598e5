"""`rcgen config`: search order, copies of installed configurations, and their differences."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen

FOLDERS = {
    "ROBOCOMP_CONFIG_HOME": "conf",
    "ROBOCOMP_DATA_HOME": "data",
    "ROBOCOMP_CONFIG_DIRS": "admin",
    "ROBOCOMP_DATA_DIRS": "share1:share2",
}


@pytest.fixture
def top(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folders of a user and two installed folders; the working folder is `work`."""
    for name, folders in FOLDERS.items():
        message = ":".join(str(tmp_path / item) for item in folders.split(":"))
        monkeypatch.setenv(name, message)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.delenv("ROBOCOMP_ROBOT_NAME", raising=False)
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    return tmp_path


def put(top: Path, path: str, text: str = "rate: 1\n") -> Path:
    file = top / path
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    return file


def lab(top: Path) -> None:
    """A context in which one file of the user shadows two files."""
    put(top, "data/contexts/lab/arm.yaml", "rate: 3\n")
    put(top, "data/contexts/lab/arm.saved.yaml", '"rate": 4\n')
    put(top, "share1/contexts/lab/arm.yaml", "rate: 1\nname: a\n")
    put(top, "share2/contexts/lab/arm.yaml", "rate: 2\n")
    put(top, "share2/contexts/lab/base.yaml")
    put(top, "share2/contexts/lab/left/arm.yaml", "rate: 5\n")


def test_config_list(rcgen: Rcgen, top: Path) -> None:
    lab(top)
    run = rcgen("config", "list")
    assert (run.code, run.err) == (0, "")
    assert run.out.replace(str(top), "T").splitlines() == [
        "context lab",
        "  arm.saved.yaml  T/data/contexts/lab/arm.saved.yaml"
        "  (user, live values kept by a component)",
        "  arm.yaml        T/data/contexts/lab/arm.yaml  (user)",
        "                  shadowed by user: T/share1/contexts/lab/arm.yaml  (installed)",
        "                  shadowed by user: T/share2/contexts/lab/arm.yaml  (installed)",
        "  base.yaml       T/share2/contexts/lab/base.yaml  (installed)",
        "context lab/left",
        "  arm.yaml  T/share2/contexts/lab/left/arm.yaml  (installed)",
    ]


def test_config_list_as_json(rcgen: Rcgen, top: Path) -> None:
    lab(top)
    run = rcgen("config", "list", "lab", "--format", "json")
    assert run.code == 0
    data = json.loads(run.out)
    assert list(data) == ["lab"]
    assert [(d["file"], d["origin"], d["wins"], d["kept_values"]) for d in data["lab"]] == [
        ("arm.saved.yaml", "user", True, True),
        ("arm.yaml", "user", True, False),
        ("arm.yaml", "installed", False, False),
        ("arm.yaml", "installed", False, False),
        ("base.yaml", "installed", True, False),
    ]


def test_config_list_without_contexts(rcgen: Rcgen, top: Path) -> None:
    assert rcgen("config", "list").out.startswith("there are no contexts")
    assert rcgen("config", "list", "--format", "json").out == "{}\n"


def test_config_list_includes_drop_in_folders(rcgen: Rcgen, top: Path) -> None:
    put(top, "share1/path.d/x.conf", "../../more")
    put(top, "admin/path.d/bad.yaml", "paths: [a]\n")
    put(top, "more/contexts/lab/arm.yaml")
    run = rcgen("config", "list", "lab")
    assert "more/contexts/lab/arm.yaml  (path.d)" in run.out
    assert run.err.startswith("warning: `paths` is not a list `path`")
    assert f"--> {top}/admin/path.d/bad.yaml:1:1" in run.err


def test_config_where(rcgen: Rcgen, top: Path) -> None:
    lab(top)
    run = rcgen("config", "where", "arm.yaml", "--context", "lab")
    assert (run.code, run.err) == (0, "")
    lines = [line for line in run.out.replace(str(top), "T").splitlines() if line[0] != "-"]
    assert lines == [
        "wins      T/data/contexts/lab/arm.yaml  (user, contexts/lab)",
        "shadowed  T/share1/contexts/lab/arm.yaml  (installed, contexts/lab)",
        "shadowed  T/share2/contexts/lab/arm.yaml  (installed, contexts/lab)",
    ]
    assert "-         T/work/etc/arm.yaml  (working folder, etc)" in run.out.replace(str(top), "T")


def test_config_where_as_json(rcgen: Rcgen, top: Path) -> None:
    file = put(top, "share2/arm.yaml")
    (top / "share1/arm.yaml").mkdir(parents=True)
    run = rcgen("config", "where", "arm.yaml", "--format", "json")
    data = json.loads(run.out)
    assert run.code == 0
    assert [item["path"] for item in data if item["wins"]] == [str(file)]
    assert {item["obstacle"] for item in data} == {"", "not found", "a folder"}


def test_config_where_without_match(rcgen: Rcgen, top: Path) -> None:
    run = rcgen("config", "where", "arm.yaml")
    assert run.code == 1
    assert run.err == "error: there is no `arm.yaml` in any of them\n"
    put(top, "share1/amr.yaml")
    run = rcgen("config", "where", "arm.yaml")
    assert run.err == "error: there is no `arm.yaml` in any of them; did you mean `amr.yaml`?\n"


def test_config_import_of_context(rcgen: Rcgen, top: Path) -> None:
    lab(top)
    (top / "data/contexts/lab/arm.yaml").unlink()
    (top / "share2/contexts/lab/base.yaml").chmod(0o444)
    run = rcgen("config", "import", "lab")
    assert (run.code, run.err) == (0, "")
    mine = top / "data/contexts/lab"
    assert (mine / "arm.yaml").read_text() == "rate: 1\nname: a\n"  # of the first installed place
    assert (mine / "left/arm.yaml").read_text() == "rate: 5\n"
    assert (mine / "base.yaml").stat().st_mode & 0o200
    assert sorted(p.name for p in mine.iterdir()) == [
        "arm.saved.yaml", "arm.yaml", "base.yaml", "left",
    ]  # fmt: skip
    assert run.out.count("wrote ") == 3
    again = rcgen("config", "import", "lab")
    assert again.code == 0
    assert again.out.count("is the same already") == 3


def test_config_import_overwrites_only_with_force(rcgen: Rcgen, top: Path) -> None:
    lab(top)
    run = rcgen("config", "import", "lab")
    assert (run.code, run.out) == (1, "")
    assert run.err.replace(str(top), "T").splitlines() == [
        "error: nothing was copied, these are there already (--force overwrites):",
        "  T/data/contexts/lab/arm.yaml",
    ]
    mine = top / "data/contexts/lab"
    assert sorted(p.name for p in mine.iterdir()) == ["arm.saved.yaml", "arm.yaml"]
    assert (mine / "arm.yaml").read_text() == "rate: 3\n"
    assert rcgen("config", "import", "lab", "--force").code == 0
    assert (mine / "arm.yaml").read_text() == "rate: 1\nname: a\n"


def test_config_import_keeps_links(rcgen: Rcgen, top: Path) -> None:
    put(top, "share1/contexts/lab/arm.yaml")
    link = top / "data/contexts/lab/arm.yaml"
    link.parent.mkdir(parents=True)
    link.symlink_to(top / "elsewhere")
    assert rcgen("config", "import", "lab").code == 1
    assert rcgen("config", "import", "lab", "--force").code == 0
    assert not link.is_symlink()
    assert not (top / "elsewhere").exists()


def test_config_import_of_one_file(rcgen: Rcgen, top: Path) -> None:
    lab(top)
    assert rcgen("config", "import", "lab", "base.yaml").code == 0
    assert rcgen("config", "import", "lab", "left/arm.yaml").code == 0
    mine = top / "data/contexts/lab"
    assert (mine / "base.yaml").is_file()
    assert (mine / "left/arm.yaml").is_file()
    assert (mine / "arm.yaml").read_text() == "rate: 3\n"


def test_config_import_rolls_back_after_failure(rcgen: Rcgen, top: Path) -> None:
    for name in ("a", "b"):
        put(top, f"share1/contexts/lab/{name}.yaml")
    put(top, "share1/contexts/lab/zone/z.yaml")
    put(top, "data/contexts/lab/zone", "a file where a folder must be")
    run = rcgen("config", "import", "lab")
    assert (run.code, run.out) == (1, "")
    assert "nothing was copied: " in run.err
    assert [p.name for p in (top / "data/contexts/lab").iterdir()] == ["zone"]


def test_config_diff(rcgen: Rcgen, top: Path) -> None:
    lab(top)
    run = rcgen("config", "diff", "lab")
    assert (run.code, run.err) == (1, "")
    assert run.out.replace(str(top), "T").splitlines() == [
        "only yours: T/data/contexts/lab/arm.saved.yaml",
        "--- T/share1/contexts/lab/arm.yaml",
        "+++ T/data/contexts/lab/arm.yaml",
        "@@ -1,2 +1 @@",
        "-rate: 1",
        "-name: a",
        "+rate: 3",
    ]


def test_config_diff_of_equal_files(rcgen: Rcgen, top: Path) -> None:
    put(top, "data/contexts/lab/arm.yaml")
    put(top, "share1/contexts/lab/arm.yaml")
    put(top, "share1/contexts/lab/base.yaml")
    assert rcgen("config", "diff", "lab").out == ""
    assert rcgen("config", "diff", "lab", "arm.yaml").code == 0
    run = rcgen("config", "diff", "lab", "base.yaml")
    assert "`rcgen config import lab base.yaml` makes one" in run.out


def test_config_diff_of_unusual_texts(rcgen: Rcgen, top: Path) -> None:
    put(top, "data/contexts/lab/arm.yaml", "rate: 1")
    put(top, "share1/contexts/lab/arm.yaml", "rate: 2\n")
    put(top, "data/contexts/lab/x.bin").write_bytes(b"\xff\0")
    put(top, "share1/contexts/lab/x.bin").write_bytes(b"\xfe\0")
    run = rcgen("config", "diff", "lab")
    assert "+rate: 1\n\\ No newline at end of file\nBinary files " in run.out


@pytest.mark.parametrize("command", ["list", "import", "diff"])
def test_config_unknown_context(rcgen: Rcgen, top: Path, command: str) -> None:
    put(top, "share1/contexts/laboratory/arm.yaml")
    run = rcgen("config", command, "laboratry")
    assert run.code == 1
    assert run.err == ("error: there is no context `laboratry` here; did you mean `laboratory`?\n")


def test_config_import_rejects_own_context(rcgen: Rcgen, top: Path) -> None:
    put(top, "work/contexts/lab/arm.yaml")
    run = rcgen("config", "import", "lab")
    assert run.code == 1
    assert run.err == "error: nothing of the context `lab` is installed; what it has is yours\n"


@pytest.mark.parametrize("command", ["import", "diff"])
def test_config_unknown_file(rcgen: Rcgen, top: Path, command: str) -> None:
    put(top, "share1/contexts/lab/arm.yaml")
    run = rcgen("config", command, "lab", "amr.yaml")
    assert run.code == 1
    assert run.err == "error: there is no `amr.yaml` in it; did you mean `arm.yaml`?\n"


@pytest.mark.parametrize(
    "arguments",
    [
        ("list", "../x"),
        ("import", ".."),
        ("import", "lab", "../../x"),
        ("diff", "/etc"),
        ("diff", "lab", "/etc/passwd"),
        ("where", "../x"),
        ("where", "x", "--context", "../y"),
        ("were", "x"),
    ],
)
def test_config_rejects_names_outside_folder(
    rcgen: Rcgen, top: Path, arguments: tuple[str, ...]
) -> None:
    put(top, "share1/contexts/lab/arm.yaml")
    before = sorted(top.rglob("*"))
    run = rcgen("config", *arguments)
    assert (run.code, run.out) == (2, "")
    assert "Traceback" not in run.err
    assert sorted(top.rglob("*")) == before


def test_config_rejects_robot_name_outside_folder(
    rcgen: Rcgen, top: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROBOCOMP_ROBOT_NAME", "../x")
    assert rcgen("config", "where", "x").code == 2
