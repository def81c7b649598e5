"""A simulated host: namespaces of its own, OpenSSH, an unprivileged user, `systemd --user`."""

from __future__ import annotations

import json
import os
import shlex
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

from tests.hosts.rig import accounts
from tests.hosts.rig.boot_settings import BootSettings
from tests.hosts.rig.cgroups import HostCgroups
from tests.hosts.rig.namespaces import TestNetwork
from tests.hosts.rig.requirements import SEARCH_PATH
from tests.support.shifted_clock import (
    LIBRARY,
    clock_environment,
    compile_clock,
    set_clock_offset,
)
from tests.support.waiting import wait_until

BOOT = Path(__file__).with_name("boot.py")


class SimulatedHost:
    """One host. `address`, `user`, `uid`; `home` is its folder on this machine (see `home_path`).

    `environment` is added to that of `run`, and of SSH sessions when sshd reads its settings.
    """

    def __init__(self, settings: BootSettings, address: str, network: TestNetwork) -> None:
        self.settings = settings
        self.name = settings.name
        self.user = settings.user
        self.uid = settings.uid
        self.address = address
        self.environment: dict[str, str] = {}
        self._files = Path(settings.files)
        self._network = network
        self._cgroups: HostCgroups | None = None
        self._process: subprocess.Popen[str] | None = None
        self._link = ""

    # ------------------------------------------------------------------ life

    def boot(self) -> None:
        """Start the host; return when sshd listens and the user's manager takes commands."""
        assert self._process is None, f"{self.name} runs already"
        number = self.address.rsplit(".", 1)[1]
        name = f"{self._network.number}-{number}-{self.name}"
        self._cgroups = HostCgroups(name, self.uid)
        folders = [str(folder) for folder in self._cgroups.folders]
        settings = asdict(self.settings) | {"cgroups": folders}
        path = self._files / "boot.json"
        path.write_text(json.dumps(settings), "utf-8")
        namespaces = ("--fork", "--pid", "--kill-child", "--mount", "--uts", "--ipc", "--net")
        self._process = subprocess.Popen(
            [
                *("setpriv", "--pdeathsig", "KILL", "unshare", *namespaces),
                *("--propagation", "private", sys.executable, "-S", "-E", str(BOOT), str(path)),
            ],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=(self._files / "boot.log").open("wb"),
            text=True,
            env={"PATH": SEARCH_PATH},
        )
        self._expect("namespaces")
        self._link = self._network.attach(self._process.pid, self.address)
        self._expect("ready")

    def _expect(self, line: str) -> None:
        assert self._process
        assert self._process.stdout
        found = self._process.stdout.readline().strip()
        if found != line:
            self.power_off()
            log = (self._files / "boot.log").read_text("utf-8", "replace")
            raise AssertionError(
                f"host {self.name} did not boot: expected {line}, {found!r}\n{log}"
            )

    def power_off(self) -> None:
        """Kill every process of the host at once, and remove its link and cgroups."""
        process, self._process = self._process, None
        if process is None:
            return
        # The kernel kills the processes of a PID namespace with its first; unshare then ends.
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text("ascii")
        for pid in children.split() or [str(process.pid)]:
            subprocess.run(["kill", "-KILL", pid], check=False, capture_output=True)
        process.wait(60)
        if process.stdout:
            process.stdout.close()
        self._network.detach(self._link)
        if self._cgroups:
            self._cgroups.remove()

    def reboot(self) -> None:
        """Power failure and boot: the home stays, /run and /tmp are empty."""
        if self.settings.disk_bytes:
            self.copy_home_back()
        self.power_off()
        self.boot()

    def copy_home_back(self) -> None:
        """Copy the small file system of the home to the test's folder, for the next boot."""
        inside = f"/proc/{self.first_pid}/root/home/{self.user}"
        subprocess.run(["cp", "-a", f"{inside}/.", self.settings.home], check=True)

    @property
    def is_running(self) -> bool:
        """Whether the host is booted."""
        return self._process is not None

    @property
    def first_pid(self) -> int:
        """The process of this machine that is PID 1 of the host."""
        pid = self._pid
        return int(Path(f"/proc/{pid}/task/{pid}/children").read_text("ascii").split()[0])

    # -------------------------------------------------------------- commands

    @property
    def home_path(self) -> Path:
        """The home as the host sees it."""
        return Path("/home", self.user)

    @property
    def home(self) -> Path:
        """The home as this machine sees it, while the host runs."""
        return Path(f"/proc/{self.first_pid}/root/home/{self.user}")

    def user_environment(self) -> dict[str, str]:
        """The environment of a login of the user."""
        runtime = f"/run/user/{self.uid}"
        return {
            "HOME": str(self.home_path),
            "USER": self.user,
            "LOGNAME": self.user,
            "LANG": "C.UTF-8",
            "PATH": "/usr/local/bin:/usr/bin:/bin",
            "XDG_RUNTIME_DIR": runtime,
            "DBUS_SESSION_BUS_ADDRESS": f"unix:path={runtime}/bus",
        } | self.environment

    def command(
        self, arguments: Sequence[str], *, root: bool = False, env: Mapping[str, str] | None = None
    ) -> list[str]:
        """The command line that runs `arguments` on the host, in the user's home."""
        pid = self.first_pid
        uid = 0 if root else self.uid
        environment = [f"{k}={v}" for k, v in {**self.user_environment(), **(env or {})}.items()]
        identity = (f"--reuid={uid}", f"--regid={uid}", "--clear-groups")
        enter = ("nsenter", f"--target={pid}", "--mount", "--uts", "--ipc", "--net", "--pid")
        script = f"cd {shlex.quote(str(self.home_path))} && exec {shlex.join(arguments)}"
        return [*enter, "setpriv", *identity, "env", "-i", *environment, "sh", "-c", script]

    def run(
        self,
        arguments: Sequence[str],
        *,
        root: bool = False,
        check: bool = True,
        input: str = "",
        timeout: float = 120.0,
        env: Mapping[str, str] | None = None,
    ) -> subprocess.CompletedProcess[str]:
        """Run a command on the host as its user (or root); `check`: it must exit with 0."""
        completed = subprocess.run(
            self.command(arguments, root=root, env=env),
            input=input,
            capture_output=True,
            text=True,
            timeout=timeout,
            check=False,
        )
        if check:
            text = f"{shlex.join(arguments)} on {self.name}: exit code {completed.returncode}"
            assert completed.returncode == 0, f"{text}\n{completed.stdout}{completed.stderr}"
        return completed

    def popen(
        self, arguments: Sequence[str], *, env: Mapping[str, str] | None = None, **options: Any
    ) -> subprocess.Popen[Any]:
        """Start a command on the host as its user. It ends with the host at the latest.

        A signal to the process that this returns does not reach the command: use `send_signal`.
        """
        return subprocess.Popen(self.command(arguments, env=env), **options)

    def send_signal(self, pattern: str, signal_number: int = signal.SIGKILL) -> None:
        """Send a signal to all processes of the host whose command line matches `pattern`."""
        self.run(["pkill", f"-{int(signal_number)}", "-f", pattern], root=True)

    def systemctl(self, *arguments: str, check: bool = True) -> str:
        """The output of `systemctl --user` on the host."""
        return self.run(["systemctl", "--user", *arguments], check=check).stdout

    # ------------------------------------------------------------------ link

    def cut_link(self) -> None:
        """Lose every packet to and from the host, as if a cable was pulled behind a switch."""
        self._network.set_forwarding(self._link, on=False)

    def restore_link(self) -> None:
        """End `cut_link`."""
        self._network.set_forwarding(self._link, on=True)

    @contextmanager
    def netem(self, *, loss: float = 0.0, delay_ms: float = 0.0) -> Iterator[None]:
        """Lose packets to and from the host with this probability, delay the others each way."""
        self._network.impair(self._link, self._pid, loss, delay_ms / 1e3)
        try:
            yield
        finally:
            self._network.restore(self._link, self._pid)

    @property
    def _pid(self) -> int:
        assert self._process, f"{self.name} does not run"
        return self._process.pid

    # ----------------------------------------------------------------- clock

    def set_clock_offset(self, seconds: float) -> None:
        """Shift the wall clock of all that was started since the first call of this.

        The first call shifts it for what is started later by SSH, `run` or the manager; further
        calls shift it at once.
        """
        is_first = not (self._files / LIBRARY).exists()
        if is_first:
            compile_clock(self._files)
        set_clock_offset(self._files, seconds)
        if not is_first:
            return
        self.environment |= clock_environment("/run/host")
        self.write_sshd_config()
        if self.settings.manager:
            words = [f"{name}={value}" for name, value in self.environment.items()]
            self.systemctl("set-environment", *words)

    # ------------------------------------------------------------------ disk

    def limit_disk(self, free_bytes: int) -> None:
        """Leave so much space in the home, which needs `disk_bytes` at the start."""
        assert self.settings.disk_bytes, "start the host with disk_bytes"
        status = os.statvfs(self.home)
        size = (status.f_blocks - status.f_bfree) * status.f_frsize + free_bytes
        target = str(self.home_path)
        self.run(["mount", "-o", f"remount,size={size}", target], root=True)

    # ---------------------------------------------------------------- server

    def write_sshd_config(self, extra: Sequence[str] = (), *, sftp: bool = True) -> None:
        """Change the settings of sshd, and let it read them; open sessions stay."""
        words = [f"{name}={value}" for name, value in self.environment.items()]
        settings = [f"SetEnv {' '.join(words)}"] if words else []
        accounts.write_sshd_config(self._files, self.user, [*settings, *extra], sftp=sftp)
        self.reload_sshd()

    def reload_sshd(self) -> None:
        """Let sshd read its settings and keys again."""
        pid_file = Path(f"/proc/{self.first_pid}/root/run/sshd.pid")
        pid = wait_until(lambda: _read_line(pid_file), f"sshd of {self.name} does not run")
        pid_file.unlink()
        self.run(["kill", "-HUP", pid], root=True)
        wait_until(lambda: _read_line(pid_file), f"sshd of {self.name} did not read its settings")

    def replace_host_key(self) -> None:
        """Give sshd another key, as an installation from scratch does."""
        accounts.make_host_key(self._files)
        self.reload_sshd()

    def host_key(self) -> str:
        """The public host key: `ssh-ed25519 AAAA…`."""
        return " ".join(accounts.read_host_key(self._files).split()[:2])

    def sshd_log(self) -> str:
        """What sshd has logged."""
        return (self._files / "sshd.log").read_text("utf-8", "replace")


def _read_line(path: Path) -> str:
    """The first line of a file; empty if it is not written yet."""
    try:
        return path.read_text("ascii").strip()
    except FileNotFoundError:
        return ""
