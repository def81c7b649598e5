"""A deployment as a compose file: one service for each component, and a router. Pure.

All containers share the network of the router's container, so that nothing listens beyond loopback,
and components reach each other as on one machine. In: an `ExportedDeployment`. Out: files.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from robocomp_dsl.deploy.export import codes, network
from robocomp_dsl.deploy.export.folder import ExportFile, tree_files
from robocomp_dsl.deploy.export.image import image_files, image_name
from robocomp_dsl.deploy.export.model import (
    NETWORK_SOURCE,
    ROUTER,
    STATE,
    ExportedDeployment,
    ExportedProcess,
)
from robocomp_dsl.deploy.export.prepare import HASH_DIGITS, container_command
from robocomp_dsl.deploy.export.readme import compose_readme
from robocomp_dsl.deploy.export.yaml_text import to_yaml
from robocomp_dsl.deploy.network.identities import LOOPBACK
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Restart

KEYS = "${ROBOCOMP_KEYS:?the folder with the keys, see README.md}"
USER = "${ROBOCOMP_UID:-1000}:${ROBOCOMP_GID:-1000}"
"""The owner of the keys: nobody else can read them."""
_STOP_S = 10


def compose_files(exported: ExportedDeployment, report: Report) -> dict[str, ExportFile]:
    """All files of the folder."""
    _report_losses(exported, report)
    host = network.local_host()
    data = {
        "name": exported.name,
        "services": {
            ROUTER: _router(exported),
            **{each.service: _service(exported, each) for each in exported.processes},
        },
        "configs": dict(_configs(exported)),
        "secrets": dict(_secrets(exported)),
    }
    settings = {
        f"network/{each.service}.json": ExportFile(
            network.component_text(exported, each.process.name, address=LOOPBACK)
        )
        for each in _components(exported)
    }
    return {
        "compose.yaml": ExportFile(to_yaml(data)),
        "README.md": ExportFile(compose_readme(exported)),
        **image_files(exported),
        **tree_files([each.tree for each in exported.processes], "content", HASH_DIGITS),
        "network/router.json": ExportFile(network.router_text(exported, host, listen=LOOPBACK)),
        **settings,
    }


def _components(exported: ExportedDeployment) -> Iterator[ExportedProcess]:
    yield from (each for each in exported.processes if not each.process.is_program)


def _router(exported: ExportedDeployment) -> dict[str, Any]:
    identity = network.router_identity(network.local_host())
    return {
        **_image(exported),
        "command": _escape(container_command(network.ROUTER_PROCESS, network=True)),
        "user": USER,
        "tmpfs": [f"{STATE}:mode=1777"],
        "configs": [_network_config(ROUTER)],
        "secrets": [*_key_mounts(ROUTER, identity)],
        "healthcheck": _healthcheck(10.0),
        "restart": "always",
        "stop_grace_period": f"{_STOP_S}s",
    }


def _service(exported: ExportedDeployment, each: ExportedProcess) -> dict[str, Any]:
    process = each.process
    is_component = not process.is_program
    identity = network.component_identity(process.name)
    data: dict[str, Any] = {
        **_image(exported),
        "command": _escape(container_command(process, network=is_component)),
        "working_dir": str(process.cwd),
        "user": USER,
        "network_mode": f"service:{ROUTER}",
        "tmpfs": [f"{STATE}:mode=1777"],
        "environment": dict(_environment(each)),
        "depends_on": {
            name: {"condition": "service_healthy"}
            for name in (ROUTER, *map(exported.service_of, process.after))
        },
        "healthcheck": _healthcheck(process.start_timeout_s),
        "restart": _restart(process.restart),
        "stop_grace_period": f"{_STOP_S}s",
        **_limits(each),
    }
    mounts = [{"source": _config_name(each), "target": c.target} for c in each.configs]
    if is_component:
        data["configs"] = [_network_config(each.service), *mounts]
        data["secrets"] = [*_key_mounts(each.service, identity)]
    if each.device_files:
        data["devices"] = [f"{path}:{path}" for path in each.device_files]
    return data


def _image(exported: ExportedDeployment) -> dict[str, Any]:
    return {"image": image_name(exported), "build": {"context": "."}}


def _environment(each: ExportedProcess) -> Iterator[tuple[str, str]]:
    yield "ROBOCOMP_HOST", each.service
    for name, value in each.process.env:
        yield name, value.replace("$", "$$")


def _escape(words: list[str]) -> list[str]:
    """Compose replaces `$NAME` in every text."""
    return [word.replace("$", "$$") for word in words]


def _healthcheck(start_s: float) -> dict[str, Any]:
    """Ready, and not hanging. While it starts, a failed probe does not count."""
    return {
        "test": ["CMD-SHELL", f"test -e {STATE}/ready && test -e {STATE}/alive"],
        "interval": "1s",
        "timeout": "5s",
        "retries": 3,
        "start_period": f"{start_s:g}s",
    }


def _restart(restart: Restart) -> str:
    if restart.policy == "never":
        return "no"
    return "always" if restart.policy == "always" else f"on-failure:{restart.max}"


def _limits(each: ExportedProcess) -> dict[str, Any]:
    limits = each.process.limits
    data: dict[str, Any] = {}
    if limits.memory_bytes:
        data |= {"mem_limit": limits.memory_bytes, "memswap_limit": limits.memory_bytes}
    if limits.cpu:
        data["cpus"] = limits.cpu
    if limits.cores:
        data["cpuset"] = ",".join(map(str, limits.cores))
    if limits.realtime:
        data |= {"cap_add": ["SYS_NICE"], "ulimits": {"rtprio": limits.realtime}}
    return data


def _network_config(service: str) -> dict[str, str]:
    return {"source": f"network-{service}", "target": f"{NETWORK_SOURCE}/network.json"}


def _config_name(each: ExportedProcess) -> str:
    return f"config-{each.service}"


def _configs(exported: ExportedDeployment) -> Iterator[tuple[str, dict[str, str]]]:
    for service in (ROUTER, *(each.service for each in _components(exported))):
        yield f"network-{service}", {"file": f"./network/{service}.json"}
    for each in exported.processes:
        for config in each.configs:
            local = config.target.split("/content/", 1)[1]
            yield _config_name(each), {"file": f"./content/{local}"}


def _secret_name(service: str, file: str) -> str:
    return f"{service}-{file}"


def _key_mounts(service: str, identity: str) -> Iterator[dict[str, str]]:
    for file in network.key_files(identity):
        yield {"source": _secret_name(service, file), "target": f"{NETWORK_SOURCE}/{file}"}


def _secrets(exported: ExportedDeployment) -> Iterator[tuple[str, dict[str, str]]]:
    identities = {ROUTER: network.router_identity(network.local_host())} | {
        each.service: network.component_identity(each.process.name)
        for each in _components(exported)
    }
    for service, identity in identities.items():
        for file, source in network.key_files(identity).items():
            yield _secret_name(service, file), {"file": f"{KEYS}/{source}"}


def _report_losses(exported: ExportedDeployment, report: Report) -> None:
    default = Restart()
    for each in exported.processes:
        restart = each.process.restart
        if restart.policy != "never" and restart.window_s != default.window_s:
            report.add(
                codes.INEXPRESSIBLE,
                each.instance.span,
                f"`in {restart.window_s:g} s` of `{each.instance.name}` is not exported",
                help="a container counts its restarts since it last ran for 10 s",
            )
        if each.process.host and not each.instance.host.is_local:
            report.add(
                codes.INEXPRESSIBLE,
                each.instance.span,
                f"`{each.instance.name}` runs on this machine, and not on `{each.process.host}`",
                help="compose knows one machine; export to systemd or kubernetes for several",
            )
