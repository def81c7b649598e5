"""Which stored or running run a `logs` command means. In: a name, a file or nothing. Out: a run."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy import instances, log_runs
from robocomp_dsl.deploy.log_runs import LogRun
from robocomp_dsl.deploy.status import format_duration
from robocomp_dsl.deploy.supervisor_engine import SupervisorEngine


@dataclass(frozen=True, slots=True)
class SelectedRun:
    """One run. `folder`: its stored logs, if any; `deployment`: it is running now."""

    name: str
    folder: Path | None
    deployment: instances.RunningDeployment | None

    @property
    def components(self) -> list[str]:
        """The names of its components."""
        if self.deployment is not None:
            return running.components(SupervisorEngine(self.deployment))
        description = log_runs.read_description(self.folder) if self.folder else None
        return list(description.components) if description else []


def select_run(which: str | None, index: int) -> SelectedRun:
    """The run with that index: 0 is the latest, -1 the one before it. Raises `CliError`.

    An index above 0 is the number of a run, as `describe_runs` shows it.
    """
    name, deployment = _select_name(which)
    folders = log_runs.run_folders(name)
    if deployment is not None and not _is_stored(deployment, folders):
        # The running one could not be stored; it is the latest all the same.
        if index == 0:
            return SelectedRun(name, None, deployment)
        folder = _select_folder(name, folders, index if index > 0 else index + 1)
        return SelectedRun(name, folder, None)
    folder = _select_folder(name, folders, index)
    return SelectedRun(name, folder, deployment if folder == folders[-1] else None)


def describe_runs(which: str | None) -> Iterator[str]:
    """The stored runs of a deployment, oldest first. Raises `CliError`."""
    name, deployment = _select_name(which)
    for folder in log_runs.run_folders(name):
        run = log_runs.read_description(folder)
        if run is None:
            continue
        started = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(run.started))
        if run.ended is not None:
            lasted = format_duration(max(run.ended - run.started, 0.0))
            outcome = f"{lasted}, exit code {run.code}: {run.reason}"
        elif deployment is not None and deployment.pid == run.pid:
            outcome = "running"
        else:
            outcome = "killed: rcdeploy could not end it"
        yield f"{int(folder.name):4}  {started}  {run.name}  {outcome}"


def _select_name(which: str | None) -> tuple[str, instances.RunningDeployment | None]:
    """The name that `which` means, and the running deployment of that name."""
    try:
        known = instances.running()
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if which is None and not known:
        latest = max(_latest_runs(), key=lambda run: run.started, default=None)
        if latest is None:
            raise CliError(EXIT_FINDINGS, "no deployment is running, and no logs are stored")
        return latest.name, None
    if which is None or any(which in (d.name, d.path) or _is_path(which, d.path) for d in known):
        engine = running.resolve_deployment(which)
        return engine.name, next(d for d in known if d.name == engine.name)
    stored = [r for r in _latest_runs() if which in (r.name, r.path) or _is_path(which, r.path)]
    if not stored:
        names = ", ".join(log_runs.stored_names())
        hint = f"; stored: {names}" if names else ""
        raise CliError(EXIT_FINDINGS, f"`{which}` is not running and has no stored logs{hint}")
    return max(stored, key=lambda run: run.started).name, None


def _latest_runs() -> Iterator[LogRun]:
    for name in log_runs.stored_names():
        for folder in reversed(log_runs.run_folders(name)):
            if (run := log_runs.read_description(folder)) is not None:
                yield run
                break


def _is_path(which: str, path: str) -> bool:
    return str(Path(which).resolve()) == path


def _is_stored(deployment: instances.RunningDeployment, folders: list[Path]) -> bool:
    run = log_runs.read_description(folders[-1]) if folders else None
    return run is not None and run.pid == deployment.pid and run.ended is None


def _select_folder(name: str, folders: list[Path], index: int) -> Path:
    if index > 0:
        found = [folder for folder in folders if int(folder.name) == index]
    else:
        found = folders[index - 1 : index or None] if -index < len(folders) else []
    if not found:
        raise CliError(
            EXIT_FINDINGS,
            f"there is no run {index} of `{name}`; `rcdeploy logs {name} --runs` lists "
            f"{len(folders)} of them",
        )
    return found[0]
