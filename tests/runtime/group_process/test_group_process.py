"""A group of generated components in one process, without rcdeploy."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.generated_components import generate_components
from tests.deploy.rcdeploy_process import RunningProcess, runtime_folder

ARM = """
data = TLaserData([TData(0.5, 1.0)])
class SpecificWorker(GenericWorker):
    def initialize(self):
        self.log.info("arm in %s", os.path.basename(os.getcwd()))
    def Laser_getLaserData(self):
        if not os.path.exists("arm.cdsl"):
            raise ValueError("not in its folder")
        return data
    def Laser_getLaserConfData(self):
        raise ValueError("no configuration")
    def finalize(self):
        self.log.info("arm finalizes")
"""
EYE = """
import eye_generated.interfaces as own
from robocomp_dsl.runtime.errors import RemoteError
class SpecificWorker(GenericWorker):
    def initialize(self):
        received = self.laser_proxy.getLaserData()
        assert type(received) is own.TLaserData, type(received)
        try:
            received[0].dist = 7.0
        except ValueError as error:
            self.log.info("as from another process: %s", error)
        try:
            self.laser_proxy.getLaserConfData()
        except RemoteError as error:
            self.log.info("failed: %s", error)
        self.log.info("eye in %s, pid %s", os.path.basename(os.getcwd()), os.getpid())
    def finalize(self):
        self.log.info("eye finalizes")
"""
ARM_OPTIONS = ("--name", "left-arm", "--set", "serial=x", "--middleware", "Laser=zenoh,inproc")
EYE_OPTIONS = (
    *("--after", "left-arm", "--name", "left-eye"),
    *("--middleware", "Laser=inproc", "--connect", "Laser=left-arm"),
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    with runtime_folder(monkeypatch):
        generate_components(tmp_path, {"arm": ARM, "eye": EYE})
        yield tmp_path


def start_group(
    folder: Path, arm: tuple[str, ...] = ARM_OPTIONS, eye: tuple[str, ...] = EYE_OPTIONS
) -> RunningProcess:
    """Start both components of `folder` in one process."""
    return RunningProcess(
        *(sys.executable, "-m", "robocomp_dsl.runtime.group_process", "--name", "left"),
        *("--component", str(folder / "arm"), *arm),
        *("--component", str(folder / "eye"), *eye),
        where=folder.parent,
    )


def test_group_process_components_call_each_other_as_in_processes_of_their_own(
    folder: Path,
) -> None:
    with start_group(folder) as group:
        line = group.until("left-arm | arm in arm", "read-only", "eye in eye")
        assert group.has(
            "left-eye | failed: left-arm.Laser.getLaserConfData failed: ValueError: no"
        )
        assert line.rstrip().endswith(f"pid {group.process.pid}")
        group.until("left-eye | running every")
        group.process.send_signal(signal.SIGTERM)
        assert group.end() == 0
    order = [line.split("| ")[1] for line in group.lines if "finalizes" in line]
    assert order == ["eye finalizes", "arm finalizes"]


def test_group_process_ends_when_a_member_fails(folder: Path) -> None:
    text = (folder / "eye" / "specificworker.py").read_text()
    failing = text.replace("received[0].dist = 7.0", "raise SystemExit('broken')")
    (folder / "eye" / "specificworker.py").write_text(failing)
    with start_group(folder) as group:
        assert group.end() == 1
    assert group.has("left-eye | error: initialize failed: SystemExit: broken")
    assert group.has("left-eye failed; the group left ends with it")
    assert group.has("left-arm | arm finalizes")


def test_group_process_goes_on_without_a_member_that_has_ended(folder: Path) -> None:
    text = (folder / "eye" / "specificworker.py").read_text()
    (folder / "eye" / "specificworker.py").write_text(
        text.replace("received[0].dist = 7.0", "self.quit()")
    )
    with start_group(folder) as group:
        group.until("left-eye | eye finalizes")
        os.kill(group.process.pid, signal.SIGTERM)
        assert group.end() == 0
    assert group.has("left-arm | arm finalizes")


def test_group_process_ends_when_a_member_hangs(folder: Path) -> None:
    text = (folder / "eye" / "specificworker.py").read_text()
    hanging = f"{text}\n    def compute(self):\n        time.sleep(100)\n"
    (folder / "eye" / "specificworker.py").write_text(hanging)
    with start_group(folder, eye=(*EYE_OPTIONS, "--watchdog", "0.3")) as group:
        assert group.end() == 1
    assert group.has("left-eye | error: watchdog: compute has hung for")
    assert group.has("left-eye failed; the group left ends with it")
    assert group.has("left-arm | arm finalizes")


def test_group_process_without_own_folders_warns_and_finds_configurations(folder: Path) -> None:
    (folder / "arm" / "etc").mkdir(exist_ok=True)
    (folder / "arm" / "etc" / "config.yaml").write_text("serial: from-file\n")
    worker = folder / "arm" / "specificworker.py"
    text = worker.read_text().replace(
        '"arm in %s", os.path.basename(os.getcwd())', '"%s", self.params.serial'
    )
    worker.write_text(text.replace('os.path.exists("arm.cdsl")', "True"))
    program = (
        "from robocomp_dsl.runtime.component import thread_context as context\n"
        "context._unshare = lambda: False\n"
        "from robocomp_dsl.runtime.group_process.main import main\n"
        "raise SystemExit(main())"
    )
    with RunningProcess(
        *(sys.executable, "-c", program, "--name", "left"),
        *("--component", str(folder / "arm"), "--name", "left-arm"),
        *("--middleware", "Laser=zenoh,inproc", "--component", str(folder / "eye"), *EYE_OPTIONS),
    ) as group:
        group.until("no working folders of their own", "left-arm | from-file", "eye | running")
        group.process.send_signal(signal.SIGTERM)
        assert group.end() == 0


@pytest.mark.parametrize(
    ("file", "text", "message"),
    [
        ("specificworker.py", "import no_such_module\n", "import failed: ModuleNotFoundError: No"),
        ("specificworker.py", "class Other:\n    pass\n", "import failed: ImportError: cannot"),
        ("specificworker.py", "class SpecificWorker(:\n", "import failed: SyntaxError: invalid"),
        ("main.py", "other = 1\n", "main.py of left-eye names no class SpecificWorker"),
    ],
)
def test_group_process_that_cannot_load_a_member_says_which(
    folder: Path, file: str, text: str, message: str
) -> None:
    (folder / "eye" / file).write_text(text)
    with start_group(folder) as group:
        assert group.end() == 1
    assert group.has(f"left-eye | error: {message}")
    assert group.has("left-eye failed; the group left ends with it")
    assert not group.has("arm in arm")


def test_group_process_reports_wrong_configuration_of_a_member(folder: Path) -> None:
    arm = (*ARM_OPTIONS, "--set", "rate=many")
    with start_group(folder, arm) as group:
        assert group.end() == 1
    assert group.has("error: `rate` must be a number, not `many`")
    assert group.has("left-arm failed; the group left ends with it")


def test_group_process_reports_missing_folder_and_option(folder: Path) -> None:
    with start_group(folder / "none") as group:
        assert group.end() == 1
    assert group.has("arm cannot be opened: No such file or directory")
    with start_group(folder, (*ARM_OPTIONS, "--no-such-option")) as group:
        assert group.end() == 1
    assert group.has("unrecognized arguments: --no-such-option")
