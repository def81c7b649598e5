"""Trees: which files of a deployment are copied, and where they are on a host."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robocomp_dsl.deploy.content import describe as describe_module
from robocomp_dsl.deploy.content.relocate import relocate
from robocomp_dsl.deploy.content.tree import ContentTree
from tests.deploy.content.workspace_files import check, describe, write_component, write_files

ARM = 'import "../components/arm/arm.cdsl";\nDeployment app {{ component arm {{ {0} }}; }};'
THERE = "/home/robot/trees/x"


@pytest.fixture
def ddsl(workspace: Path) -> Path:
    """A workspace with a component; the path of a deployment beside it."""
    write_component(
        workspace / "components",
        "arm",
        {"etc/config.yaml": "rate: 20\n", "bin/tool": "#!/bin/sh\n", "__pycache__/x.pyc": ""},
    )
    (workspace / "components/arm/bin/tool").chmod(0o755)
    return workspace / "apps" / "app.ddsl"


def paths(tree: ContentTree) -> list[str]:
    return [file.path for file in tree.files]


OWN = ["arm/arm.cdsl", "arm/arm.pdsl", "arm/bin/tool", "arm/etc/config.yaml", "arm/main.py"]


def test_content_tree_is_folder_of_component(ddsl: Path, workspace: Path) -> None:
    trees, findings = describe(ddsl, ARM.format(""))
    tree = trees["arm"]
    assert not findings
    assert paths(tree) == OWN
    assert (tree.origin, tree.working_folder) == (workspace / "components", "arm")
    assert [file.path for file in tree.files if file.executable] == ["arm/bin/tool"]
    assert tree.size == sum(Path(file.source).stat().st_size for file in tree.files)


def test_content_tree_mirrors_files_outside_the_folder(ddsl: Path, workspace: Path) -> None:
    write_files(
        workspace,
        {
            "apps/lab.yaml": "rate: 5\n",
            "apps/rooms/map.yaml": "m",
            "meshes/arm/link.stl": "s",
            "components/arm/local.csv": "",
        },
    )
    more = 'config "lab.yaml"; set map = "rooms/map.yaml"; set file = "local.csv";'
    trees, findings = describe(ddsl, ARM.format(f'{more} files "../meshes";'))
    assert not findings
    tree = trees["arm"]
    assert paths(tree) == sorted(
        [f"components/{path}" for path in OWN]
        + [
            "apps/lab.yaml",
            "apps/rooms/map.yaml",
            "components/arm/local.csv",
            "meshes/arm/link.stl",
        ]
    )
    _, plan = check(ddsl, ARM.format(more))
    (there,) = (
        relocate(p, tree, tree_folder=THERE, python="/env/python", interpreter="/py")
        for p in plan.processes
    )
    assert there.argv[:2] == ("/env/python", "main.py")
    assert there.argv[there.argv.index("--config") + 1] == f"{THERE}/apps/lab.yaml"
    assert there.config == Path(THERE, "apps/lab.yaml")
    assert there.cwd == Path(THERE, "components/arm")


def test_content_tree_keeps_room_for_outputs_above_the_folder(ddsl: Path, workspace: Path) -> None:
    trees, _ = describe(ddsl, ARM.format('set file = "../../build/run/path.csv";'))
    tree = trees["arm"]
    assert tree.origin == workspace
    assert tree.folders == ("build/run",)
    assert tree.working_folder == "components/arm"


def test_content_tree_rewrites_absolute_paths_of_the_workspace(ddsl: Path, workspace: Path) -> None:
    write_files(workspace, {"data/map.yaml": "m"})
    path = workspace / "data/map.yaml"
    text = ARM.format(f'set map = "{path}"; set file = "{os.devnull}";')
    trees, findings = describe(ddsl, text.replace("../components", str(workspace / "components")))
    assert not findings
    # below the folder of the component's parent, the DDSL file or the home only
    assert "map.yaml" not in "".join(paths(trees["arm"]))
    write_files(workspace, {"apps/map.yaml": "m"})
    text = ARM.format(f'set map = "{workspace}/apps/map.yaml"; set file = "{os.devnull}";')
    trees, _ = describe(ddsl, text)
    _, plan = check(ddsl, text)
    process = plan.processes[0]
    there = relocate(process, trees["arm"], tree_folder=THERE, python="/p", interpreter="/py")
    assert f"map={THERE}/apps/map.yaml" in there.argv
    assert f"file={os.devnull}" in there.argv


def test_content_tree_hash_depends_on_content_only(ddsl: Path, workspace: Path, tmp_path) -> None:
    before = describe(ddsl, ARM.format(""))[0]["arm"]
    copy = tmp_path / "copy"
    write_component(
        copy / "components", "arm", {"etc/config.yaml": "rate: 20\n", "bin/tool": "#!/bin/sh\n"}
    )
    (copy / "components/arm/bin/tool").chmod(0o755)
    assert describe(copy / "apps/app.ddsl", ARM.format(""))[0]["arm"].hash == before.hash
    config = workspace / "components/arm/etc/config.yaml"
    os.utime(config, (1, 1))
    assert describe(ddsl, ARM.format(""))[0]["arm"].hash == before.hash
    config.chmod(0o755)
    executable = describe(ddsl, ARM.format(""))[0]["arm"].hash
    config.write_text("rate: 21\n")
    changed = describe(ddsl, ARM.format(""))[0]["arm"].hash
    assert len({before.hash, executable, changed}) == 3


def test_content_tree_findings_are_at_the_component(ddsl: Path, workspace: Path) -> None:
    (workspace / "components/arm/gone").symlink_to("missing")
    _, findings = describe(ddsl, ARM.format(""))
    (finding,) = findings
    assert finding.code.id == "RC845"
    assert "/gone is a symbolic link to missing, which does not exist" in finding.message
    assert finding.span.start_position[0] == 2


def test_content_tree_lists_few_of_many_problems(ddsl: Path, workspace: Path) -> None:
    for number in range(9):
        (workspace / f"components/arm/gone{number}").symlink_to("missing")
    _, findings = describe(ddsl, ARM.format(""))
    assert len(findings) == 6
    assert any("4 more files cannot be copied" in finding.message for finding in findings)


@pytest.mark.parametrize(
    ("limit", "code"), [("MAX_TREE_BYTES", "RC845"), ("LARGE_TREE_BYTES", "RC849")]
)
def test_content_tree_size_is_limited(ddsl: Path, monkeypatch, limit: str, code: str) -> None:
    monkeypatch.setattr(describe_module, limit, 50)
    _, findings = describe(ddsl, ARM.format(""))
    assert [finding.code.id for finding in findings] == [code]
    assert "the largest is arm/" in findings[0].help


def test_content_tree_of_program_has_the_files_that_it_names(workspace: Path) -> None:
    write_files(workspace, {"tools/watch.py": "", "tools/data.csv": "", "other.txt": ""})
    ddsl = workspace / "app.ddsl"
    text = 'Deployment app { program watch { executable "python3 tools/watch.py"; }; };'
    trees, findings = describe(ddsl, text)
    assert not findings
    assert paths(trees["watch"]) == [f"{workspace.name}/tools/watch.py"]
    assert trees["watch"].working_folder == workspace.name


def test_content_tree_has_configuration_found_in_context(
    ddsl: Path, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(home / ".config"))
    write_files(home, {".config/robocomp/contexts/lab/arm.yaml": "rate: 7\n"})
    text = ARM.format('context "lab";')
    trees, _ = describe(ddsl, text)
    tree = trees["arm"]
    _, plan = check(ddsl, text)
    process = plan.processes[0]
    assert "--context" in process.argv
    there = relocate(process, tree, tree_folder=THERE, python="/p", interpreter="/py")
    assert "--context" not in there.argv
    config = there.argv[there.argv.index("--config") + 1]
    assert config.endswith("/home/.config/robocomp/contexts/lab/arm.yaml")
    assert config.startswith(THERE)
    assert there.context == ""
