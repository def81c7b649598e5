"""Names of the units and files of a deployment on its hosts. Pure.

In: the names of a deployment and of a component. Out: unit names, escaped as `systemd-escape` does,
and paths below the folder of the deployment. The names of units that serve the whole deployment
contain a full stop, which no component has in its name.
"""

from __future__ import annotations

PREFIX = "robocomp-"
SHARE = ".local/share/robocomp"
"""Below the home folder: a folder for each deployment."""
UNITS = ".config/systemd/user"
"""Below the home folder: where systemd looks for the units of a user."""
_PLAIN = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789:_.")


def escape(text: str) -> str:
    r"""`text` as a part of a unit name: `left/arm-motor` is `left-arm\x2dmotor`."""
    return "".join(
        "-" if byte == 0x2F else chr(byte) if _is_plain(byte, i) else f"\\x{byte:02x}"
        for i, byte in enumerate(text.encode("utf-8", "surrogateescape"))
    )


def _is_plain(byte: int, index: int) -> bool:
    return chr(byte) in _PLAIN and not (index == 0 and byte == 0x2E)


def service_name(deployment: str, component: str) -> str:
    """The unit of a component, given by its full name."""
    return f"{PREFIX}{escape(deployment)}-{escape(component)}.service"


def target_name(deployment: str) -> str:
    """The unit that stands for all units of the deployment on a host."""
    return f"{PREFIX}{escape(deployment)}.target"


def router_name(deployment: str) -> str:
    """The unit of the router, through which the components of a host reach other hosts."""
    return f"{PREFIX}{escape(deployment)}.router.service"


def log_trim_name(deployment: str, suffix: str) -> str:
    """The unit that bounds the log files; `suffix` is `timer` or `service`."""
    return f"{PREFIX}{escape(deployment)}.logs.{suffix}"


def limits_name(deployment: str) -> str:
    """The unit that watches limits which the manager of the host cannot enforce."""
    return f"{PREFIX}{escape(deployment)}.limits.service"


def is_unit_of(deployment: str, unit: str) -> bool:
    """Whether `unit` belongs to the deployment."""
    stem = f"{PREFIX}{escape(deployment)}"
    return unit.startswith((f"{stem}-", f"{stem}."))


def root_folder(deployment: str) -> str:
    """The folder of the deployment, below the home folder."""
    return f"{SHARE}/{deployment}"


def log_file(component: str) -> str:
    """The log file of a component, below the folder of the deployment."""
    return f"logs/{component}.log"
