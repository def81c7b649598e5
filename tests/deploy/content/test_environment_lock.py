"""Which packages the environment of a component has, and when its hash changes."""

from __future__ import annotations

import ast
import subprocess
import sys
import venv
from pathlib import Path

import pytest
from packaging.requirements import Requirement

import robocomp_dsl
from robocomp_dsl.deploy.content import distributions, lock, wheelhouse
from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.hash_cache import HashCache
from robocomp_dsl.deploy.content.lock import Environment, EnvironmentLocker
from robocomp_dsl.deploy.content.package_files import (
    NAME,
    is_runtime,
    package_files,
    package_version,
    write_package_wheel,
)
from robocomp_dsl.deploy.content.wheelhouse import WheelStore
from robocomp_dsl.diagnostics import Diagnostic, Report
from tests.deploy.content.test_wheel_target import ROBOT, own_target
from tests.deploy.content.workspace_files import check, write_component, write_files

BASE = {"eclipse-zenoh", "numpy", "platformdirs", "python-statemachine", "pyyaml"}
APP = 'import "arm/arm.cdsl";\nDeployment app { component arm; };\n'


def lock_app(
    workspace: Path, text: str = APP, **files: str
) -> tuple[Environment | None, list[Diagnostic]]:
    """The environment of the first process of an app with a component `arm`."""
    named = {name.replace("_py", ".py").replace("_txt", ".txt"): t for name, t in files.items()}
    write_component(workspace, "arm", named)
    deployment, plan = check(workspace / "app.ddsl", text)
    report = Report()
    trees = describe_trees(deployment, plan, report)
    locker = EnvironmentLocker(deployment, plan, own_target(), report)
    process = plan.processes[0]
    return locker.lock(process, trees[process.name]), report.sorted()


def names(environment: Environment | None) -> set[str]:
    assert environment is not None
    return {locked.name for locked in environment.distributions}


def test_environment_has_the_runtime_without_toolchain(workspace: Path) -> None:
    environment, findings = lock_app(workspace)
    assert not findings
    assert environment is not None
    assert names(environment) == BASE
    assert not environment.complete
    versions = {locked.name: locked.version for locked in environment.distributions}
    numpy = distributions.find_installed("numpy")
    assert numpy is not None
    assert versions["numpy"] == numpy.version


def test_environment_has_what_the_component_imports(workspace: Path) -> None:
    environment, findings = lock_app(
        workspace,
        main_py="import specificworker\n",
        specificworker_py="from robocomp_dsl.simulation.engine import x\nimport packaging\n",
    )
    assert not findings
    assert names(environment) >= {*BASE, "mujoco", "mujoco-core", "pillow", "packaging"}


def test_environment_has_the_requirements_of_the_component(workspace: Path) -> None:
    environment, findings = lock_app(
        workspace, requirements_txt="Jinja2>=3.1\nclick; sys_platform == 'win32'\n"
    )
    assert not findings
    assert names(environment) == BASE | {"jinja2", "markupsafe"}


def test_environment_has_the_toolchain_if_a_component_imports_it(workspace: Path) -> None:
    environment, findings = lock_app(workspace, main_py="from robocomp_dsl.check import passes\n")
    assert not findings
    assert environment is not None
    assert environment.complete
    assert names(environment) >= BASE | {"lark", "click", "libcst", "jinja2"}


def test_environment_of_a_program_that_is_not_python(workspace: Path) -> None:
    text = APP.replace("arm; }", 'arm { executable "./main"; }; }')
    assert lock_app(workspace, text) == (None, [])


def test_environment_findings_are_at_the_requirement(workspace: Path) -> None:
    _, findings = lock_app(
        workspace, requirements_txt="numpy\nno-such-package-at-all>=2\nnumpy<1\n"
    )
    assert [finding.code.id for finding in findings] == ["RC846", "RC846"]
    missing, old = sorted(findings, key=lambda finding: finding.message)[::-1]
    missing, old = (missing, old) if "no-such" in missing.message else (old, missing)
    assert "`no-such-package-at-all>=2` is not installed here" in missing.message
    assert missing.span.start_position[0] == 2
    assert missing.span.source.path.name == "requirements.txt"
    assert "`numpy<1` is required, but" in old.message


def test_environment_reports_module_that_is_in_no_package(
    workspace: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_files(tmp_path / "lib", {"loose_module_of_test.py": ""})
    monkeypatch.syspath_prepend(str(tmp_path / "lib"))
    environment, (finding,) = lock_app(workspace, main_py="\nimport loose_module_of_test\n")
    assert names(environment) == BASE
    assert finding.code.id == "RC846"
    assert finding.span.start_position[0] == 2
    assert "which is not copied to hosts" in finding.message


def test_environment_hash_depends_on_versions_and_host(workspace: Path) -> None:
    first, _ = lock_app(workspace)
    second, _ = lock_app(workspace, main_py="print('other')\n")
    third, _ = lock_app(workspace, main_py="import packaging\n")
    assert first is not None
    assert second is not None
    assert third is not None
    assert first.hash == second.hash != third.hash
    deployment, plan = check(workspace / "app.ddsl", APP)
    other = EnvironmentLocker(deployment, plan, ROBOT, Report()).lock_runtime(deployment.span)
    assert other.distributions == first.distributions
    assert other.hash != first.hash


def test_close_requirements_evaluates_markers_of_the_host() -> None:
    roots = [Requirement("rosbags")]
    markers = own_target().marker_environment()
    older, _ = distributions.close_requirements(roots, markers)
    newer, _ = distributions.close_requirements(roots, {**markers, "python_version": "3.14"})
    assert {d.name for d in older} - {d.name for d in newer} >= {"backports-zstd"}


def imported_modules(path: Path) -> set[str]:
    """The modules that a file imports, also in functions."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found


def test_package_files_of_runtime_import_nothing_that_stays_behind() -> None:
    root = Path(robocomp_dsl.__file__).parent
    missing = {}
    for file in package_files(complete=False):
        if file.source.suffix == ".py":
            own = {name for name in imported_modules(file.source) if name.startswith(NAME + ".")}
            outside = {
                n
                for n in own
                if not is_runtime(n) and lock.is_part(n) and n != f"{NAME}.__version__"
            }
            if outside:
                missing[str(file.source.relative_to(root))] = outside
    assert not missing


def test_package_files_of_simulation_need_the_listed_libraries() -> None:
    known = {"mujoco", "PIL", "numpy", "yaml"}
    known |= {"viser", "websockets", "rich"}  # of `rcgen view`, which no component uses
    root = Path(robocomp_dsl.__file__).parent / "simulation"
    tops = {
        name.partition(".")[0] for path in root.rglob("*.py") for name in imported_modules(path)
    }
    assert tops - sys.stdlib_module_names - {NAME} <= known


def test_package_wheel_runs_without_toolchain(tmp_path: Path) -> None:
    version = package_version(complete=False, hashes=HashCache())
    assert version.startswith(f"{robocomp_dsl.__version__}+host.")
    wheel = write_package_wheel(tmp_path, version, ["numpy"], complete=False)
    first = wheel.read_bytes()
    assert write_package_wheel(tmp_path, version, ["numpy"], complete=False).read_bytes() == first
    libraries = Path(str(distributions.find_installed("numpy").locate_file("")))  # type: ignore[union-attr]
    venv.create(tmp_path / "bare", with_pip=False)
    code = f"""
import sys; sys.path[:0] = [{str(wheel)!r}]; sys.path.append({str(libraries)!r})
import robocomp_dsl.runtime, robocomp_dsl
assert {wheel.name!r} in robocomp_dsl.__file__, robocomp_dsl.__file__
loaded = {{"lark", "jinja2", "libcst", "click"}} & sys.modules.keys()
assert not loaded, loaded
"""
    subprocess.run([tmp_path / "bare/bin/python", "-c", code], check=True)


def test_wheel_store_names_what_cannot_be_had(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_CONFIG_FILE", "/dev/null")
    for name in ("PIP_FIND_LINKS", "PIP_EXTRA_INDEX_URL", "PIP_INDEX_URL"):
        monkeypatch.delenv(name, raising=False)
    needed, _ = distributions.close_requirements(
        [Requirement("platformdirs")], ROBOT.marker_environment()
    )
    environment = Environment("3.12", ROBOT.platform, "0+host.0", needed)
    house, problems = WheelStore(tmp_path / "wheels").collect(environment, ROBOT)
    assert house is None
    (problem,) = problems  # platformdirs is pure Python: it fits every host
    assert problem.message.startswith("there is no wheel of uv==")
    assert problem.message.endswith("for Python 3.12 on aarch64 with glibc 2.31")


def test_wheel_store_names_missing_uv(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wheelhouse, "find_installed", lambda _: None)
    environment = Environment("3.12", ROBOT.platform, "0+host.0", ())
    house, (problem,) = WheelStore(tmp_path).collect(environment, ROBOT)
    assert house is None
    assert "robocomp_dsl[hosts]" in problem.help


def test_packaging_library_names_its_extra() -> None:
    code = """
import sys; sys.modules["packaging.requirements"] = None
from robocomp_dsl.extras import MissingExtra
try:
    import robocomp_dsl.deploy.content.host_content
except MissingExtra as error:
    assert error.extra == "hosts"
    print(error)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pip install 'robocomp_dsl[hosts]'" in run.stdout
