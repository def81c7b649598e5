"""Many components on one machine: all start, all stop, none is left."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.deploy import instances
from robocomp_dsl.deploy.supervisor.reaper import find_processes
from tests.campaign.running_deployment import RunningDeployment


def write_many(folder: Path, count: int) -> Path:
    """`count` components: half of them call, the others serve."""
    pairs = "".join(
        f"    component echo{i} : echo {{ ready within 200 s; }};\n"
        f"    component bystander{i} : bystander {{ after echo{i}; ready within 200 s; }};\n"
        f"    connect bystander{i}.Echo -> echo{i}.Echo;\n"
        for i in range(count // 2)
    )
    path = folder / "many.ddsl"
    path.write_text(
        'import "echo/echo.cdsl";\nimport "bystander/bystander.cdsl";\n'
        f"Deployment many\n{{\n{pairs}}};\n"
    )
    return path


@pytest.mark.parametrize("count", [12, pytest.param(100, marks=pytest.mark.slow)])
def test_many_components_start_and_stop(
    folder: Path, count: int, record_property: Callable[[str, object], None]
) -> None:
    # 100 calls in a second, not in each of 50 pairs.
    generic = folder / "bystander/bystander_generated/genericworker.py"
    text = generic.read_text()
    generic.write_text(text.replace("period=10", "period=1000"))
    try:
        start = time.monotonic()
        with RunningDeployment(write_many(folder, count)) as app:
            app.wait_ready(200.0)
            up = time.monotonic() - start
            (entry,) = (each for each in instances.running() if each.name == "many")
            token = f"{entry.domain}.{entry.pid}"
            # With the fork server.
            assert len(find_processes(token)) == count + 1
            start = time.monotonic()
            code = app.stop()
            # A busy machine may not let 100 processes close 4950 links within the grace period.
            assert code == 0 or count > 12, app.log.read_text()[-2000:]
            down = time.monotonic() - start
            assert find_processes(token) == []
            assert not (Path(instances.instances_folder()) / "many").exists()
    finally:
        generic.write_text(text)
    record_property("figures", f"{count} components: up {up:.1f} s, down {down:.1f} s")
    print(f"{count} components: up {up:.1f} s, down {down:.1f} s")  # noqa: T201 - a figure
