"""The faults of the campaign: each function injects one kind and returns what it counted."""

from __future__ import annotations

import contextlib
import itertools
import os
import random
import signal
import subprocess
import time
from pathlib import Path
from statistics import median
from typing import Any

import zenoh

from robocomp_dsl.runtime.presence.domain_session import open_session
from tests.campaign.components import write_deployment, write_faulty_deployment
from tests.campaign.running_deployment import PROGRAM, RunningDeployment
from tests.support.waiting import wait_until

UNDER_LOAD = ("ledger", "caller", "source", "sink")
HOOKS = ("initialize", "compute", "implements", "subscribesTo", "finalize")
ACTIONS = ("sys.exit", "os._exit", "raise")


def kill_by_turns(app: RunningDeployment, rounds: int) -> dict[str, Any]:
    """SIGKILL to each component under load by turns; from kill to ready [s]."""
    times, missing = [], 0
    for component in itertools.islice(itertools.cycle(UNDER_LOAD), rounds):
        pid = app.pid(component)
        os.kill(pid, signal.SIGKILL)
        seconds = app.restarted(component, pid)
        if seconds is None:
            missing += 1
        else:
            times.append(seconds)
    times.sort()
    return {
        "kills": rounds,
        "not restarted": missing,
        "kill to ready p50 [s]": median(times),
        "kill to ready p95 [s]": times[int(len(times) * 0.95)],
        "kill to ready p99 [s]": times[min(int(len(times) * 0.99), len(times) - 1)],
        "kill to ready max [s]": times[-1],
    }


def stop_by_turns(app: RunningDeployment, seconds: float) -> dict[str, Any]:
    """SIGSTOP to each component under load by turns; how long a command takes meanwhile."""
    commands = []
    for component in UNDER_LOAD:
        pid = app.pid(component)
        os.kill(pid, signal.SIGSTOP)
        try:
            until = time.monotonic() + seconds
            commands.append(timed_command("status", app.name))
            time.sleep(max(0.0, until - time.monotonic()))
        finally:
            os.kill(pid, signal.SIGCONT)
        app.wait_ready()
    return {"stops": len(UNDER_LOAD), "slowest command beside a stopped peer [s]": max(commands)}


def start_beside_stopped(app: RunningDeployment) -> dict[str, Any]:
    """All components under load are stopped; one of them is killed and must start again."""
    stopped = [app.pid(component) for component in UNDER_LOAD[1:]]
    for pid in stopped:
        os.kill(pid, signal.SIGSTOP)
    try:
        pid = app.pid("ledger")
        os.kill(pid, signal.SIGKILL)
        seconds = app.restarted("ledger", pid)
    finally:
        for pid in stopped:
            os.kill(pid, signal.SIGCONT)
    app.wait_ready()
    return {"start beside stopped peers [s]": seconds}


def timed_command(*arguments: str) -> float:
    """How long `rcdeploy` takes with these arguments [s]."""
    start = time.monotonic()
    subprocess.run([*PROGRAM, *arguments], capture_output=True, check=False, timeout=60)
    return time.monotonic() - start


def slow_and_stopped_subscriber(folder: Path) -> dict[str, Any]:
    """A reliable subscriber is stopped: its publisher can still be stopped, and finalizes."""
    write_deployment(folder, "reliable.ddsl", "reliable; depth 1;")
    with RunningDeployment(folder / "reliable.ddsl") as app:
        app.wait_ready()
        sink = app.pid("sink")
        os.kill(sink, signal.SIGSTOP)
        try:
            time.sleep(2.0)
            start = time.monotonic()
            app.process.send_signal(signal.SIGINT)
            wait_until(lambda: not app.rows().get("source", {}).get("pid"), "source ends", 30)
            seconds = time.monotonic() - start
        finally:
            with contextlib.suppress(ProcessLookupError):  # stopping it continued it
                os.kill(sink, signal.SIGCONT)
        return {"publisher of a stopped subscriber ends [s]": seconds, "exit code": app.stop()}


def restarts_after(hook: str, action: str) -> bool:
    """Whether `faulty` must be restarted; otherwise the same process must continue."""
    if action in {"hang", "os._exit"} or hook == "initialize":
        return True
    return action == "sys.exit" and hook == "compute"


def fail_in_hook(folder: Path, hook: str, action: str) -> str:
    """`faulty` fails in `hook`; a word about what followed. Raises if that is not as required."""
    mark = write_faulty_deployment(folder, hook, action)
    journal = folder / "journals" / mark
    with RunningDeployment(folder / "faults.ddsl") as app:
        if hook == "finalize":
            app.wait_ready()
            start = time.monotonic()
            code = app.stop()
            return f"exit code {code} after {time.monotonic() - start:.1f} s"
        if hook == "implements":
            app.wait_ready()
            trigger(app)
        wait_until(journal.exists, f"{action} in {hook}", 60)
        start = time.monotonic()
        if restarts_after(hook, action):
            wait_until(lambda: app.rows().get("faulty", {}).get("restarts"), "a restart", 60)
            app.wait_ready(60)
            return f"restarted and ready after {time.monotonic() - start:.1f} s"
        pid = app.pid("faulty")
        time.sleep(1.0)
        app.wait_ready(60)
        if app.pid("faulty") != pid:
            raise AssertionError("the process was restarted")
        return "the same process continues"


def trigger(app: RunningDeployment) -> None:
    """Call the handler of `faulty`; the reply does not matter."""
    command = [*PROGRAM, "call", "-d", app.name, "faulty.Fault.trigger"]
    subprocess.Popen(
        command, cwd=app.path.parent, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )


def malformed_messages(app: RunningDeployment, domain: str, count: int) -> dict[str, Any]:
    """Random bytes as payload and attachment on every key of the domain, then a check of life."""
    before = {name: row["pid"] for name, row in app.rows().items()}
    rng = random.Random(1)
    opened = open_session(domain)
    replies = 0
    try:
        keys = message_keys(opened.session, domain)
        for number in range(count):
            key = keys[number % len(keys)]
            payload, attachment = rng.randbytes(rng.randrange(64)), rng.randbytes(rng.randrange(9))
            if "/q/" in key or "/c/" in key:
                for _ in opened.session.get(
                    key, payload=payload, attachment=attachment, timeout=2.0
                ):
                    replies += 1
            else:
                opened.session.put(key, payload, attachment=attachment)
    finally:
        opened.close()
    app.wait_ready()
    after = {name: row["pid"] for name, row in app.rows().items()}
    return {
        "malformed messages": count,
        "keys": len(keys),
        "replies": replies,
        "components that ended": sum(before[name] != after[name] for name in before),
    }


def message_keys(session: zenoh.Session, domain: str) -> list[str]:
    """The keys of all operations of the domain, from the tokens and the generated interfaces."""
    operations = {
        "Ledger": "add", "Echo": "ping", "Feed": "news", "Component": "getStatistics",
    }  # fmt: skip
    keys = []
    for reply in session.liveliness().get(f"rc/{domain}/p/**", timeout=2.0):
        if reply.ok is None:
            continue
        _, _, _, role, interface, component, port, type_hash = str(reply.ok.key_expr).split("/")
        kinds = {"server": "qc", "publisher": "t"}.get(role, "")
        keys += [
            f"rc/{domain}/{kind}/{interface}/{type_hash}/{component}/{port}/{operation}"
            for kind in kinds
            for operation in (operations.get(interface, "unknown"), "odd")
        ]
    return keys


def second_of_a_name(app: RunningDeployment, domain: str) -> dict[str, Any]:
    """A second process of the name `ledger` is refused."""
    environment = {**os.environ, "ROBOCOMP_DOMAIN": domain}
    run = subprocess.run(
        [PROGRAM[0], "main.py", "--domain", domain],
        cwd=app.path.parent / "ledger",
        env=environment,
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
    )
    return {"second of a name: exit code": run.returncode, "message": run.stderr.strip()[-200:]}


def full_disk(folder: Path) -> dict[str, Any]:
    """The output of rcdeploy goes to a full device; the deployment goes on."""
    write_deployment(folder, "full.ddsl", "")
    with RunningDeployment(folder / "full.ddsl", output="/dev/full") as app:
        app.wait_ready()
        time.sleep(1.0)
        alive = app.is_ready()
        return {"deployment survives a full disk": alive, "exit code": app.stop()}
