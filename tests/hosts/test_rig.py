"""The simulated hosts themselves."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.hosts.rig.cgroups import PREFIX, remove_stale_cgroups
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.namespaces import TestNetwork
from tests.hosts.rig.requirements import cgroup_roots
from tests.support.waiting import wait_until

SERVICE = """\
[Service]
ExecStart=/bin/sleep infinity
Restart=always
RestartSec=0.1
[Install]
WantedBy=default.target
"""


def ssh(hosts: Hosts, name: str, *command: str, options: tuple[str, ...] = ()) -> str:
    """The output of a command on a host, by OpenSSH's client."""
    host = hosts.by_name[name]
    known = hosts.folder / "known_hosts"
    known.write_text(hosts.known_hosts(), "ascii")
    settings = (f"UserKnownHostsFile={known}", "StrictHostKeyChecking=yes", "BatchMode=yes")
    flags = [word for setting in (*settings, *options) for word in ("-o", setting)]
    target = f"{host.user}@{host.address}"
    arguments = ["ssh", "-F", "/dev/null", "-i", str(hosts.key), *flags, target, "--", *command]
    completed = subprocess.run(arguments, capture_output=True, text=True, timeout=60, check=False)
    assert completed.returncode == 0, completed.stderr
    return completed.stdout


@pytest.fixture(scope="module")
def pair(module_hosts: Hosts) -> Hosts:
    """The hosts `robot` and `base`."""
    module_hosts.start("robot")
    module_hosts.start("base")
    return module_hosts


def main_pid(hosts: Hosts, name: str) -> int:
    text = hosts.by_name[name].systemctl("show", "-P", "MainPID", "x.service")
    return int(text)


def enable_service(hosts: Hosts) -> None:
    """Let `robot` start `x.service` now, and when it boots."""
    robot = hosts.by_name["robot"]
    units = robot.home_path / ".config/systemd/user"
    robot.run(["mkdir", "-p", str(units)])
    robot.run(["tee", str(units / "x.service")], input=SERVICE)
    prefix = f"export XDG_RUNTIME_DIR=/run/user/{robot.uid};"
    ssh(hosts, "robot", prefix, "systemctl --user daemon-reload")
    ssh(hosts, "robot", prefix, "systemctl --user enable --now x.service")


def test_simulated_host_has_own_user_and_files(hosts: Hosts) -> None:
    started = time.monotonic()
    host = hosts.start("robot")
    print(f"booted in {time.monotonic() - started:.2f} s")  # noqa: T201 - a figure, with -s
    assert host.run(["id", "-un"]).stdout.strip() == "robot"
    assert host.run(["hostname"]).stdout.strip() == "robot"
    assert host.run(["pwd"]).stdout.strip() == "/home/robot"
    assert "pytest" not in host.run(["ls", "/tmp"]).stdout
    assert "robot" not in Path("/etc/passwd").read_text("utf-8")
    processes = host.run(["ps", "-e", "-o", "comm="]).stdout.split()
    assert {"sshd", "systemd"} <= set(processes)
    assert "pytest" not in processes


def test_simulated_hosts_reach_each_other(pair: Hosts) -> None:
    robot, base = pair.by_name["robot"], pair.by_name["base"]
    assert ssh(pair, "robot", "hostname").strip() == "robot"
    assert ssh(pair, "base", "hostname").strip() == "base"
    script = f"import socket; socket.create_connection(('{base.address}', 22), 10); print('ok')"
    assert robot.run(["python3", "-c", script]).stdout.strip() == "ok"


def test_simulated_host_has_user_manager_over_ssh(pair: Hosts) -> None:
    enable_service(pair)
    robot = pair.by_name["robot"]
    first = main_pid(pair, "robot")
    robot.run(["kill", "-9", str(first)])
    wait_until(lambda: main_pid(pair, "robot") not in {0, first}, "the unit was not restarted")
    assert "x.service" in robot.run(["cat", f"/proc/{main_pid(pair, 'robot')}/cgroup"]).stdout


def test_simulated_host_reboots_with_its_home(pair: Hosts) -> None:
    enable_service(pair)
    robot = pair.by_name["robot"]
    robot.run(["touch", "/tmp/temporary", "/home/robot/permanent"])
    robot.reboot()
    assert "temporary" not in robot.run(["ls", "/tmp"]).stdout
    assert "permanent" in robot.run(["ls"]).stdout
    wait_until(lambda: main_pid(pair, "robot") > 0, "the enabled unit was not started")
    assert ssh(pair, "robot", "hostname").strip() == "robot"


def test_simulated_host_link_is_cut_and_restored(pair: Hosts) -> None:
    base = pair.by_name["base"]
    base.cut_link()
    with pytest.raises(AssertionError, match=r"timed out|No route"):
        ssh(pair, "base", "hostname", options=("ConnectTimeout=1",))
    base.restore_link()
    assert ssh(pair, "base", "hostname").strip() == "base"


def test_simulated_host_delays_packets(pair: Hosts) -> None:
    with pair.by_name["base"].netem(delay_ms=100):
        started = time.monotonic()
        assert ssh(pair, "base", "hostname").strip() == "base"
        # A TCP connection, the greeting, the keys, the login, a session: each waits for a reply.
        assert time.monotonic() - started > 1.0


def test_simulated_host_loses_packets(pair: Hosts) -> None:
    base, robot = pair.by_name["base"], pair.by_name["robot"]
    connect = "import socket,sys; socket.create_connection((sys.argv[1], 22), float(sys.argv[2]))"
    command = ["python3", "-c", connect, base.address]
    with base.netem(loss=1.0):
        assert robot.run([*command, "0.3"], check=False).returncode == 1
    with base.netem(loss=0.1):
        # What was lost before, or is lost now, may be an answer to ARP: then there is no way.
        name = wait_until(lambda: ssh(pair, "base", "hostname"), ignoring=AssertionError)
        assert name.strip() == "base"
    wait_until(
        lambda: robot.run([*command, "10"], check=False).returncode == 0,
        "the link is not restored",
    )


def test_simulated_host_has_its_own_clock(hosts: Hosts) -> None:
    late = hosts.start("late")
    read = [sys.executable, "-c", "import time; print(time.time())"]
    late.set_clock_offset(-3600)
    assert float(late.run(read).stdout) == pytest.approx(time.time() - 3600, abs=30)
    assert float(ssh(hosts, "late", "date", "+%s")) == pytest.approx(time.time() - 3600, abs=30)
    ticker = "import time\nfor line in iter(input, 'end'): print(time.time(), flush=True)"
    running = late.popen([sys.executable, "-c", ticker], stdin=subprocess.PIPE, stdout=-1)
    for offset in (0, 7200):
        late.set_clock_offset(offset)
        running.stdin.write(b"\n")
        running.stdin.flush()
        shown = float(running.stdout.readline())
        assert shown == pytest.approx(time.time() + offset, abs=30)
    running.communicate(b"end\n")


def test_simulated_host_has_limited_disk(hosts: Hosts) -> None:
    small = hosts.start("small", disk_bytes=50_000_000)
    small.run(["sh", "-c", "head -c 1000000 /dev/zero > kept"])
    small.limit_disk(500_000)
    full = small.run(["sh", "-c", "head -c 2000000 /dev/zero > more"], check=False)
    assert "No space left" in full.stderr
    small.reboot()
    assert "kept" in small.run(["ls"]).stdout


def test_simulated_host_leaves_nothing(hosts: Hosts) -> None:
    host = hosts.start("robot")
    duration = str(7_000_000 + os.getpid())
    host.popen(["setsid", "sleep", duration])
    pid = wait_until(lambda: host.run(["pgrep", "-f", f"sleep {duration}"], check=False).stdout)
    assert pid
    cgroups = [folder for folder in host._cgroups.folders if folder.exists()]
    assert cgroups
    host.power_off()
    found = subprocess.run(["pgrep", "-f", f"^sleep {duration}"], capture_output=True, check=False)
    assert found.stdout == b""
    assert not any(folder.exists() for folder in cgroups)


RUN = """\
import sys
from pathlib import Path
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.namespaces import TestNetwork

host = Hosts(Path(sys.argv[1]), TestNetwork()).start("robot")
host.popen(["setsid", "sleep", sys.argv[2]])
print(host.first_pid, flush=True)
sys.stdin.read()
"""


def test_simulated_hosts_end_with_a_killed_test_process(
    test_network: TestNetwork, tmp_path: Path
) -> None:
    """No fixture of the killed process runs; the kernel ends its hosts, the next run tidies up."""
    duration = str(8_000_000 + os.getpid())
    command = [sys.executable, "-c", RUN, str(tmp_path / "hosts"), duration]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdout
        first_pid = int(process.stdout.readline())
        assert Path("/proc", str(first_pid)).exists()
        process.send_signal(signal.SIGKILL)
    wait_until(lambda: not Path("/proc", str(first_pid)).exists(), "the host goes on")
    assert subprocess.run(["pgrep", "-f", f"sleep {duration}$"], check=False).returncode == 1
    pattern = f"{PREFIX}{process.pid}-*"
    wait_until(
        lambda: (
            remove_stale_cgroups()
            or not any(folder for root in cgroup_roots() for folder in root.glob(pattern))
        ),
        "cgroups are left",
    )
