"""Finding codes of hosts: reasons why a deployment cannot use a computer that it names."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNREACHABLE = Code(
    "RC830",
    Severity.ERROR,
    "host cannot be reached",
    """\
rcdeploy connects to every host of a deployment by SSH before it starts anything. Nothing answers at
the address of this host, or the connection was lost. Check that the computer is switched on, that
the address is right, and that its SSH server runs:

    ping 10.0.0.2
    ssh robot@10.0.0.2 true

Wrong, if the SSH server listens at port 2222:

    host robot { address "10.0.0.2"; };

Right:

    host robot { address "10.0.0.2:2222"; };
""",
)

LOGIN = Code(
    "RC831",
    Severity.ERROR,
    "login on a host refused",
    """\
The host accepts none of your SSH keys for this user. rcdeploy uses the keys of your SSH agent,
those in `~/.ssh`, and those that `~/.ssh/config` names; it never asks for a password. Install your
key on the host:

    ssh-copy-id robot@10.0.0.2

The user is that of the description, otherwise that of `~/.ssh/config`, otherwise your own:

    host robot { address "10.0.0.2"; user robot; };
""",
)

UNKNOWN_KEY = Code(
    "RC832",
    Severity.ERROR,
    "unknown host key",
    """\
The key of a host proves that the computer at the address is the one that you mean. rcdeploy
connects only to hosts whose key you have confirmed:

    rcdeploy hosts trust app.ddsl

It shows the fingerprint of the key. Compare it with the fingerprint on the host itself:

    ssh-keygen -lf /etc/ssh/ssh_host_ed25519_key.pub

Confirmed keys are in `~/.config/robocomp/known_hosts`; those in `~/.ssh/known_hosts` count, too.
""",
)

CHANGED_KEY = Code(
    "RC833",
    Severity.ERROR,
    "changed host key",
    """\
The computer at this address has another key than the one that you confirmed. Either it was
installed again, or another computer pretends to be it. rcdeploy never connects then. If you know
the reason, compare the fingerprint on the host itself, and replace the old key:

    rcdeploy hosts trust app.ddsl robot --replace

A key in `~/.ssh/known_hosts` is removed with `ssh-keygen -R 10.0.0.2`.
""",
)

SYSTEMD = Code(
    "RC834",
    Severity.ERROR,
    "host without a usable service manager",
    """\
On hosts, components are services of the user's systemd manager (`systemd --user`), version 240 or
newer, and rcdeploy copies files by SFTP. The manager runs while the user is logged in, or always
with lingering. As root, on the host:

    loginctl enable-linger robot

In containers and on systems without systemd, `rcdeploy export` writes files for other engines.
""",
)

PYTHON = Code(
    "RC835",
    Severity.ERROR,
    "no suitable Python on a host",
    """\
Components need Python 3.11 or newer on their host. rcdeploy looks for `python3` and for
`python3.11` and newer in the PATH of the user. On Debian or Ubuntu, as root:

    apt install python3.11
""",
)

DISK = Code(
    "RC836",
    Severity.ERROR,
    "no space on a host",
    """\
A component, its environment and its logs need space in the home of the user. Delete what is no
longer needed, for example versions of the deployment that nobody returns to.
""",
)

CLOCK = Code(
    "RC837",
    Severity.WARNING,
    "clock of a host differs",
    """\
Time stamps of components on different hosts are compared, and certificates are valid from a time
on. The clock of this host differs from that of this machine by more than the limit (50 ms unless
`--clock-limit` names another). Synchronize both, for example with chrony or systemd-timesyncd:

    timedatectl set-ntp true
""",
)

BUSY = Code(
    "RC838",
    Severity.ERROR,
    "another rcdeploy changes this deployment",
    """\
Only one rcdeploy at a time may change a deployment. The host is locked while `rcdeploy up` copies
files and starts components. The message says who holds the lock and since when. Wait until it ends;
the lock ends with it, at the latest some seconds after its connection is lost.
""",
)

LINGER = Code(
    "RC839",
    Severity.WARNING,
    "components stop at logout",
    """\
Without lingering, systemd ends the services of a user when the last session of this user ends, and
does not start them after a reboot. As root, on the host:

    loginctl enable-linger robot
""",
)
