"""Formats resource limits as text. Pure."""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.model.deployment import ResourceLimits


def format_limits(limits: ResourceLimits) -> str:
    """`memory 500 MB, cpu 80 %, cores 0,2-3, realtime priority 50`; empty without limits."""
    parts = [f"memory {limits.memory_bytes / 1e6:g} MB"] if limits.memory_bytes else []
    parts += [f"cpu {limits.cpu * 100:g} %"] if limits.cpu else []
    parts += [f"cores {format_cores(limits.cores)}"] if limits.cores else []
    parts += [f"realtime priority {limits.realtime}"] if limits.realtime else []
    return ", ".join(parts)


def format_cores(cores: Sequence[int]) -> str:
    """Core numbers in ascending order as the list of taskset(1): `0,2-3`."""
    ranges: list[list[int]] = []
    for core in cores:
        if ranges and core == ranges[-1][-1] + 1:
            ranges[-1] = [ranges[-1][0], core]
        else:
            ranges.append([core])
    return ",".join("-".join(map(str, each)) for each in ranges)
