"""Programs that search for their configuration, save live values, and run under prefixes."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import uuid
from pathlib import Path

import pytest

from tests.runtime.search_folders import SearchFolders

PROGRAM = """
from robocomp_dsl.runtime import Component, ComponentSpec, ServedPort, main
from robocomp_dsl.runtime.parameters import Parameter, Parameters
from robocomp_dsl.runtime import types as rt
EMPTY = rt.Interface("Empty")
class P(Parameters):
    SCHEMA = (Parameter("rate", "float", default=50.0, live=True),
              Parameter("keep", "float", default=0.0))
class C(Component):
    SPEC = ComponentSpec(name="arm", period=1, parameters=P, middleware="inproc",
        implements=(ServedPort("A", EMPTY), ServedPort("B", EMPTY)))
    def initialize(self):
        print("rate", self.params.rate, "as", self.name)
        if self.params.keep:
            self.params.set({"rate": self.params.keep})
            print("kept", self.params.save())
        self.quit()
raise SystemExit(main(C))
"""


@pytest.fixture
def folders(tmp_path: Path) -> SearchFolders:
    search_folders = SearchFolders(tmp_path)
    search_folders.put("work/main.py", PROGRAM)
    return search_folders


def run(folders: SearchFolders, *arguments: str) -> tuple[int, str, str]:
    domain = f"test-{uuid.uuid4().hex[:8]}"
    done = subprocess.run(
        [sys.executable, "main.py", "--domain", domain, *arguments],
        cwd=folders.work,
        env=os.environ | folders.environment,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


def test_program_without_options_reads_default_config(folders: SearchFolders) -> None:
    folders.put("share1/config.yaml", "rate: 3\n")
    assert run(folders)[1] == "rate 50.0 as arm\n"
    folders.put("work/etc/config.yaml", "rate: 2\n")
    _, out, err = run(folders, "--verbose-search")
    assert out == "rate 2.0 as arm\n"
    assert "configuration etc/config.yaml; no search: neither --context nor --config-name" in err


def test_program_context_takes_precedence_over_default_config(folders: SearchFolders) -> None:
    folders.put("work/etc/config.yaml", "rate: 2\n")
    file = folders.put("share1/contexts/lab/arm.yaml", "rate: 7\n")
    code, out, err = run(folders, "--context", "lab")
    assert (code, out) == (0, "rate 7.0 as arm\n")
    assert f"configuration {file} (installed, contexts/lab)" in err
    assert "looked for" not in err
    mine = folders.put("user/data/contexts/lab/arm.yaml", "rate: 8\n")
    code, out, err = run(folders, "--context", "lab", "--verbose-search")
    assert out == "rate 8.0 as arm\n"
    assert f"candidate {mine} (user, contexts/lab): used" in err
    assert f"candidate {file} (installed, contexts/lab): shadowed" in err
    assert ": not found\n" in err


def test_program_context_without_file_uses_default_config(folders: SearchFolders) -> None:
    folders.put("share1/contexts/lab/base.yaml")
    folders.put("work/etc/config.yaml", "rate: 2\n")
    code, out, err = run(folders, "--context", "lab")
    assert (code, out) == (0, "rate 2.0 as arm\n")
    assert "context lab has no configuration for this component; using etc/config.yaml" in err
    code, _, err = run(folders, "--context", "labb")
    assert "warning: no folder has the context `labb`; did you mean `lab`?" in err


def test_program_reports_config_not_found(folders: SearchFolders) -> None:
    folders.put("share1/arm.yaml")
    code, out, err = run(folders, "--config-name", "amr.yaml")
    assert (code, out) == (1, "")
    assert "error: configuration not found: `amr.yaml`\n  --> --config-name:1:1" in err
    assert "did you mean `arm.yaml`" in err
    assert f"  {folders.top}/share2/amr.yaml (installed): not found" in err
    assert "Traceback" not in err


def test_program_locates_error_in_found_config(folders: SearchFolders) -> None:
    file = folders.put("share1/arm.yaml", "rat: 1\n")
    code, _, err = run(folders, "--config-name", "arm.yaml")
    assert code == 1
    assert f"--> {file}:1:1" in err


def test_program_saves_values_of_installed_config_in_user_folder(folders: SearchFolders) -> None:
    folders.put("share1/contexts/lab/arm.yaml", "rate: 7\n")
    code, out, _ = run(folders, "--context", "lab", "--set", "keep=9")
    saved = folders.top / "user/data/contexts/lab/arm.saved.yaml"
    assert (code, out) == (0, f"rate 7.0 as arm\nkept {saved}\n")
    assert saved.is_file()
    assert run(folders, "--context", "lab")[1] == "rate 9.0 as arm\n"
    assert [p.name for p in (folders.top / "share1/contexts/lab").iterdir()] == ["arm.yaml"]
    assert run(folders)[1] == "rate 50.0 as arm\n"


def test_program_saves_values_per_prefix(folders: SearchFolders) -> None:
    folders.put("work/etc/config.yaml", "rate: 2\n")
    for prefix, value in (("left", 3), ("/right/", 4)):
        out = run(folders, "--prefix", prefix, "--set", f"keep={value}")[1]
        assert out.startswith(f"rate 2.0 as {prefix.strip('/')}/arm\n")
    assert run(folders, "--prefix", "left")[1] == "rate 3.0 as left/arm\n"
    assert run(folders, "--prefix", "right")[1] == "rate 4.0 as right/arm\n"
    assert run(folders)[1] == "rate 2.0 as arm\n"


def test_program_prefers_config_of_instance_name(folders: SearchFolders) -> None:
    folders.put("share1/contexts/lab/arm.yaml", "rate: 1\n")
    folders.put("share1/contexts/lab/second.yaml", "rate: 2\n")
    folders.put("share1/contexts/lab/left/arm.yaml", "rate: 3\n")
    lab = ("--context", "lab")
    assert run(folders, *lab, "--name", "second")[1] == "rate 2.0 as second\n"
    assert run(folders, *lab, "--prefix", "left")[1] == "rate 3.0 as left/arm\n"
    assert run(folders, *lab, "--prefix", "right")[1] == "rate 1.0 as right/arm\n"


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["--context", "../x"], 1, "is not a valid context: use letters, digits"),
        (["--config", "x.yaml", "--context", "lab"], 2, "--config is an exact path"),
        (["--config", "x.yaml", "--config-name", "y.yaml"], 2, "--config is an exact path"),
        (["--prefix", "a/../b"], 2, "`..` is not a valid prefix name"),
        (["--prefix", "1"], 2, "`1` is not a valid prefix name"),
        (["--name", "left/arm"], 2, "`left/arm` is not a valid name"),
        (["--remap", "A"], 2, "`A` is not a remap; write PORT=NAME"),
        (["--remap", "A=x.y"], 2, "`A=x.y` is not a remap"),
        (["--remap", "C=x"], 2, "arm has no port `C`; its ports: A, B"),
        (["--remap", "A=B"], 2, "`A` and `B` would both be named `B`"),
        (["--remap", "A=Component"], 2, "`Component` and `A` would both be named"),
        (["--remap", "A=x", "--remap", "A=y"], 2, "`A` has two names, x and y"),
    ],
)
def test_program_rejects_wrong_options(
    folders: SearchFolders, arguments: list[str], code: int, message: str
) -> None:
    ended, out, err = run(folders, *arguments)
    assert (ended, out) == (code, "")
    assert message in re.sub(r"\s+", " ", err)
    assert "Traceback" not in err


def test_program_remap_may_swap_port_names(folders: SearchFolders) -> None:
    assert run(folders, "--remap", "A=B", "--remap", "B=A")[0] == 0
