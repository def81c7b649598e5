"""Run all benchmarks, or those named: a table on the terminal and `build/bench.json`."""

from __future__ import annotations

import importlib
import json
import platform
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent


def reached(figure: dict[str, Any]) -> bool | None:
    """Whether the goal is met; None where there is none."""
    goal = figure.get("goal")
    if goal is None:
        return None
    higher = figure.get("better", "lower") == "higher"
    return bool(figure["value"] >= goal if higher else figure["value"] <= goal)


def row(figure: dict[str, Any]) -> str:
    """One line of the table."""
    sign = "≥" if figure.get("better") == "higher" else "≤"
    goal = "" if figure.get("goal") is None else f"{sign} {figure['goal']:g}"
    mark = {True: "met", False: "MISSED", None: ""}[reached(figure)]
    return f"{figure['name']:<64} {figure['value']:>10.3g} {figure['unit']:<6} {goal:>9}  {mark}"


def main(names: list[str]) -> int:
    """Run the benchmarks called `names` (all if none)."""
    known = sorted(p.stem.removeprefix("bench_") for p in HERE.glob("bench_*.py"))
    unknown = [n for n in names if n not in known]
    if unknown:
        print(f"no benchmark {', '.join(unknown)}; there are: {', '.join(known)}", file=sys.stderr)
        return 2
    figures = []
    for name in names or known:
        print(f"-- {name}", flush=True)
        for figure in importlib.import_module(f"benchmarks.bench_{name}").run():
            figures.append({"benchmark": name, **figure, "ok": reached(figure)})
            print(row(figure), flush=True)
    target = Path("build/bench.json")
    target.parent.mkdir(exist_ok=True)
    about = {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "python": platform.python_version(),
        "machine": platform.machine(),
    }
    target.write_text(json.dumps({**about, "figures": figures}, indent=1) + "\n")
    print(f"written to {target}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
