"""Copies of trees: only what a host lacks, and complete whenever they are interrupted."""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import json
import os
from collections.abc import AsyncIterator, Sequence
from pathlib import Path

import pytest

from robocomp_dsl.deploy.content import transfer
from robocomp_dsl.deploy.content.collect import collect_garbage
from robocomp_dsl.deploy.content.host_session import ContentError, HostSession
from robocomp_dsl.deploy.content.on_host import files as host_files
from robocomp_dsl.deploy.content.transfer import (
    CopyResult,
    blobs_of,
    find_lacking,
    manifest_of,
    upload_trees,
)
from robocomp_dsl.deploy.content.tree import ContentTree, TreeFile, make_tree
from robocomp_dsl.deploy.hosts.commands import CommandResult
from robocomp_dsl.deploy.hosts.connection import HostProcess
from robocomp_dsl.deploy.hosts.errors import HostError, HostUnreachable, HostWriteError
from robocomp_dsl.deploy.hosts.local import LocalConnection
from tests.deploy.content.killed_child import killed_at
from tests.deploy.content.workspace_files import ROOT, local_connection, write_files

SMALL = {
    "arm/main.py": b"print(1)\n",
    "arm/empty": b"",
    "arm/bin/tool": b"#!/bin/sh\n",
    "arm/same": b"print(1)\n",
}


def make(folder: Path, files: dict[str, bytes], folders: Sequence[str] = ()) -> ContentTree:
    """A tree of files written into `folder`; those below `bin` are executable."""
    write_files(folder, files)
    entries = [
        TreeFile(
            path,
            hashlib.sha256(content).hexdigest(),
            len(content),
            "/bin/" in path,
            str(folder / path),
        )
        for path, content in files.items()
    ]
    return make_tree(folder, "arm", entries, folders)


def upload(*trees: ContentTree) -> CopyResult:
    return asyncio.run(upload_trees(local_connection(), ROOT, trees))


def content_of(home: Path, tree: ContentTree) -> dict[str, bytes]:
    folder = home / ROOT / "trees" / tree.hash
    found = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in found}


def check_folder(home: Path, *trees: ContentTree) -> None:
    """What is visible below the folder of the deployment is complete."""
    root = home / ROOT
    for blob in (root / "blobs").glob("[0-9a-f]*"):
        assert hashlib.sha256(blob.read_bytes()).hexdigest() == blob.name[:64]
    expected = {tree.hash: tree for tree in trees}
    for folder in (root / "trees").glob("[0-9a-f]*"):
        if folder.is_dir():
            tree = expected[folder.name]
            assert content_of(home, tree).keys() == {file.path for file in tree.files}


def test_upload_trees_copies_only_what_a_host_lacks(tmp_path: Path, home: Path) -> None:
    tree = make(tmp_path / "ws", SMALL, ["build/run"])
    first = upload(tree)
    assert (first.files, first.trees) == (3, 1)  # two files have the same content
    assert first.bytes == sum(map(len, SMALL.values())) - len(SMALL["arm/same"])
    assert content_of(home, tree) == SMALL
    folder = home / ROOT / "trees" / tree.hash
    assert (folder / "build/run").is_dir()
    assert os.access(folder / "arm/bin/tool", os.X_OK)
    assert not os.access(folder / "arm/main.py", os.X_OK)
    again = upload(tree)
    assert (again.files, again.bytes, again.trees) == (0, 0, 0)
    changed = make(tmp_path / "ws", {**SMALL, "arm/main.py": b"print(2)\n"})
    one_line = upload(tree, changed)
    assert (one_line.files, one_line.bytes, one_line.trees) == (1, 9, 1)
    assert content_of(home, tree) == SMALL
    check_folder(home, tree, changed)


def test_upload_trees_sends_large_files_in_chunks(
    tmp_path: Path, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(transfer, "CHUNK_BYTES", 50_000)
    monkeypatch.setattr(transfer, "PACK_BYTES", 20_000)
    large = {"arm/model.bin": os.urandom(1_234_567), "arm/bin/large": os.urandom(1_100_000)}
    packs = {f"arm/data{n}": os.urandom(9_000) for n in range(7)}
    tree = make(tmp_path / "ws", large | packs)
    seen: list[tuple[int, int]] = []
    connection = local_connection()
    result = asyncio.run(
        upload_trees(connection, ROOT, [tree], progress=lambda *done: seen.append(done))
    )
    assert content_of(home, tree) == large | packs
    assert result.bytes == tree.size == max(seen)[0] == max(seen)[1]
    model = home / ROOT / "trees" / tree.hash / "arm/model.bin"
    assert model.stat().st_nlink == 2  # a link to the blob, which nobody may write to
    assert model.stat().st_mode & 0o777 == 0o444
    assert (model.parent / "bin/large").stat().st_mode & 0o777 == 0o555
    assert (model.parent / "data1").stat().st_mode & 0o777 == 0o644


def test_upload_trees_refuses_file_that_changed_meanwhile(tmp_path: Path, home: Path) -> None:
    tree = make(tmp_path / "ws", SMALL)
    for content in (b"#!/bin/ls\n", b"#!/bin/bash\n", b"#!"):
        (tmp_path / "ws/arm/bin/tool").write_bytes(content)
        with pytest.raises(ContentError, match=r"bin/tool changed while it was copied"):
            upload(tree)
    (tmp_path / "ws/arm/bin/tool").unlink()
    with pytest.raises(ContentError, match=r"bin/tool: No such file"):
        upload(tree)
    assert not content_of(home, tree)


def test_upload_trees_replaces_blobs_that_somebody_wrote_to(tmp_path: Path, home: Path) -> None:
    tree = make(tmp_path / "ws", SMALL)
    upload(tree)
    for blob in (home / ROOT / "blobs").iterdir():
        blob.chmod(0o644)
        blob.write_bytes(blob.read_bytes().upper())
    other = make(tmp_path / "ws", {**SMALL, "arm/more": b"more"})
    assert upload(other).files == 4
    assert content_of(home, other) == {**SMALL, "arm/more": b"more"}


def test_upload_trees_restores_deleted_files_and_keeps_outputs(tmp_path: Path, home: Path) -> None:
    tree = make(tmp_path / "ws", SMALL)
    upload(tree)
    folder = home / ROOT / "trees" / tree.hash / "arm"
    (folder / "main.py").unlink()
    (folder / "empty").write_bytes(b"calibrated")
    (folder / "out.csv").write_bytes(b"1,2")
    assert upload(tree).trees == 1
    assert (folder / "main.py").read_bytes() == SMALL["arm/main.py"]
    assert (folder / "empty").read_bytes() == b"calibrated"
    assert (folder / "out.csv").read_bytes() == b"1,2"


def test_upload_trees_reports_what_the_host_says(tmp_path: Path, home: Path) -> None:
    (home / ".local").mkdir()
    (home / ".local/share").write_text("a file")
    with pytest.raises(HostWriteError, match=r"robot: .*(Not a directory|File exists)"):
        upload(make(tmp_path / "ws", SMALL))


def test_host_session_reports_missing_python(tmp_path: Path) -> None:
    tree = make(tmp_path / "ws", SMALL)
    with pytest.raises(HostError, match=r"/no/such/python ended: .*not found"):
        asyncio.run(upload_trees(local_connection(), ROOT, [tree], python="/no/such/python"))


class CutProcess:
    """A process of the host whose link is cut after some bytes; then it is killed."""

    def __init__(self, process: HostProcess, connection: CutConnection) -> None:
        self._process = process
        self._connection = connection

    async def write(self, data: bytes) -> None:
        rest = self._connection.remaining
        self._connection.remaining -= len(data)
        if rest < len(data):
            await self._process.write(data[: max(0, rest)])
            raise HostUnreachable("robot: the link is cut")
        await self._process.write(data)

    async def readline(self) -> bytes:
        return await self._process.readline()

    async def close(self) -> CommandResult:
        return await self._process.close()


class CutConnection(LocalConnection):
    """This machine behind a link that passes only so many bytes."""

    def __init__(self, passed_bytes: int) -> None:
        super().__init__(local_connection().host)
        self.remaining = passed_bytes

    async def start(self, command: Sequence[str]) -> CutProcess:  # type: ignore[override]
        return CutProcess(await super().start(command), self)

    async def stream(self, command: Sequence[str]) -> AsyncIterator[bytes]:
        yield b""


def test_upload_trees_continues_after_a_cut_link(
    tmp_path: Path, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(transfer, "CHUNK_BYTES", 20_000)
    files = {**SMALL, "arm/model.bin": os.urandom(300_000), "arm/b.bin": os.urandom(90_000)}
    tree = make(tmp_path / "ws", files)
    source = 45_000  # the text of the functions passes in any case
    for attempt in range(200):
        try:
            result = asyncio.run(
                upload_trees(CutConnection(source + 70_000 + 100 * attempt), ROOT, [tree])
            )
        except HostUnreachable:
            assert not content_of(home, tree)
            check_folder(home, tree)
        else:
            break
    assert 2 < attempt < 20  # each attempt copies further chunks
    assert result.bytes < tree.size / 2
    assert content_of(home, tree) == files
    check_folder(home, tree)


def test_host_files_are_complete_wherever_the_host_dies(tmp_path: Path, home: Path) -> None:
    large = os.urandom(host_files.COPIED_BYTES + 1)
    files = {**SMALL, "arm/bin/model": large}
    tree = make(tmp_path / "ws", files, ["out"])
    root = str(home / ROOT)
    blobs = blobs_of([tree])
    small = [b for b in blobs.values() if b.size < len(large)]
    model = next(b for b in blobs.values() if b.size == len(large))
    half = len(large) // 2
    requests: list[tuple[str, dict[str, object]]] = [
        (
            "store_blobs",
            {
                "blobs": [(b.name, b.size) for b in small],
                "payload": b"".join(Path(b.source).read_bytes() for b in small),
            },
        ),
        ("store_chunk", {"name": model.name, "index": 0, "payload": large[:half]}),
        ("store_chunk", {"name": model.name, "index": 1, "payload": large[half:]}),
        ("join_chunks", {"name": model.name, "sizes": [half, len(large) - half]}),
        ("build_trees", {"trees": {tree.hash: manifest_of(tree)}}),
    ]
    killed = 0
    for function, request in requests:
        step = 1
        while killed_at(step, getattr(host_files, function), {"root": root, **request}):
            check_folder(home, tree)
            killed += 1
            step += 1
            if function == "join_chunks" and not (home / ROOT / "incoming").exists():
                break
            if function == "join_chunks" and (home / ROOT / "blobs" / model.name).exists():
                break  # it died while it deleted the chunks, which are no longer needed
    assert killed > 40
    assert content_of(home, tree) == files


def test_find_lacking_lists_chunks_of_interrupted_copy(tmp_path: Path, home: Path) -> None:
    tree = make(tmp_path / "ws", {"arm/model.bin": b"x" * 100})
    blob = tree.files[0].blob

    async def interrupted() -> dict[str, list[str]]:
        async with HostSession(local_connection(), ROOT) as session:
            await session.call("store_chunk", {"name": blob, "index": 3}, b"12345")
            state = await find_lacking(session, [tree])
            assert state.home == str(home)
            assert state.free_bytes > 0
            assert state.missing_bytes == 100
            return state.chunks

    assert asyncio.run(interrupted()) == {blob: ["3-5"]}


def write_version(home: Path, number: int, *trees: ContentTree, environment: str = "") -> None:
    """The manifest of a version, as the engine stores it: texts of units."""
    lines = [f"WorkingDirectory=%h/{ROOT}/trees/{tree.hash}/arm" for tree in trees]
    lines += [f"ExecStart=%h/{ROOT}/environments/{environment}/bin/python"] if environment else []
    write_files(
        home / ROOT,
        {f"versions/{number}.json": json.dumps({"units": lines}), "current": str(number)},
    )


def test_collect_garbage_keeps_what_versions_use(tmp_path: Path, home: Path) -> None:
    trees = [make(tmp_path / f"ws{n}", {**SMALL, "arm/n": b"%d" % n}) for n in range(6)]
    environments = [f"{n}" * 64 for n in range(6)]
    root = home / ROOT
    for number, tree in enumerate(trees):
        upload(tree)
        write_files(
            root,
            {
                f"environments/{environments[number]}/robocomp.json": '{"blobs": []}',
                "cache/uv/x": "",
            },
        )
        write_version(home, number + 1, tree, environment=environments[number])
    (root / "current").write_text("2")  # rolled back
    write_files(root, {f"trees/{trees[0].hash}/arm/out.csv": "1,2", "blobs/.new-x": "half"})
    write_files(root, {f"trees/{trees[0].hash}/arm/__pycache__/main.pyc": "", "trees/.new-y/z": ""})
    result = asyncio.run(collect_garbage(local_connection(), ROOT, keep=1))
    assert sorted(path.stem for path in (root / "versions").iterdir()) == ["2", "4", "5", "6"]
    used = [trees[1], *trees[3:]]
    assert {p.name for p in (root / "trees").iterdir() if p.suffix != ".json"} == {
        trees[0].hash,
        *(tree.hash for tree in used),
    }
    assert result.outputs == (f"{ROOT}/trees/{trees[0].hash}/arm/out.csv",)
    assert content_of(home, trees[0]) == {"arm/out.csv": b"1,2"}
    assert sorted(p.name for p in (root / "environments").iterdir()) == [
        environments[1],
        *environments[3:],
    ]
    assert {p.name for p in (root / "blobs").iterdir()} == set(blobs_of(used))
    assert not (root / "cache").exists()
    for tree in used:
        assert upload(tree).files == 0
    assert asyncio.run(collect_garbage(local_connection(), ROOT, keep=1)).outputs == result.outputs


def test_collect_garbage_of_unknown_deployment_does_nothing(home: Path) -> None:
    result = asyncio.run(collect_garbage(local_connection(), ROOT))
    assert (result.freed_bytes, result.outputs) == (0, ())
    with contextlib.suppress(FileNotFoundError):
        assert not any((home / ROOT).iterdir())
