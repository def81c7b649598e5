"""A deployment as user units of systemd, with a script that installs them. Pure.

The units are those that `rcdeploy up` writes on hosts. In: a checked deployment. Out: a folder for
each host with units, files of the components, requirements and `install.sh`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.export import codes
from robocomp_dsl.deploy.export.folder import ExportFile, tree_files
from robocomp_dsl.deploy.export.image import WHEELS, WHEELS_README
from robocomp_dsl.deploy.export.prepare import PYTHON, separate_groups
from robocomp_dsl.deploy.export.requirements import locked_requirements
from robocomp_dsl.deploy.export.systemd_texts import install_script, router_unit, systemd_readme
from robocomp_dsl.deploy.hosts.description import (
    HostSettings,
    deployment_hosts,
    describe_hosts,
)
from robocomp_dsl.deploy.network.access_rules import access_rules
from robocomp_dsl.deploy.network.identities import common_name, needs_network, router_name
from robocomp_dsl.deploy.network.key_folder import file_name
from robocomp_dsl.deploy.network.router_plan import component_settings, router_settings
from robocomp_dsl.deploy.plan import plan
from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.hosted_process import HOME
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment, Host

ENVIRONMENT = "environments/exported"
ROUTER_FILE = "private/router.json"
_HASH_DIGITS = 64


def systemd_files(
    deployment: Deployment, name: str, domain: str, report: Report
) -> dict[str, ExportFile]:
    """All files of the folder; those of a host are below its name."""
    deployment = separate_groups(deployment, report)
    planned = plan(deployment, name=name, domain=domain, interpreter=PYTHON)
    for connection in deployment.external_connections:
        report.add(
            codes.INEXPRESSIBLE,
            connection.span,
            f"nobody connects {connection.source} -> {connection.target}",
            help="rcdeploy makes this connection only for deployments that it runs itself",
        )
    extra = {i.full_name: i.files for i in deployment.instances}
    trees = describe_trees(deployment, planned, report, extra)
    hosts = deployment_hosts(deployment)
    networked = needs_network(deployment)
    root = f"{HOME}/{names.root_folder(name)}"
    python = f"{root}/{ENVIRONMENT}/bin/python"
    settings = HostSettings(python, PYTHON)
    if networked:
        unit = (names.router_name(name), router_unit(name, root, python))
        settings = replace(
            settings, units=(unit,), network_file=lambda x: f"{root}/{_network_file(x)}"
        )
    manifests = describe_hosts(
        deployment, planned, trees, dict.fromkeys((h.name for h in hosts), settings), report
    )
    requirements = locked_requirements(deployment, planned, trees, report)
    files: dict[str, ExportFile] = {"README.md": ExportFile(systemd_readme(deployment, hosts))}
    for host in hosts:
        manifest = manifests[host.name]
        own = [trees[each.name] for each in manifest.components]
        keys = _identities(deployment, host) if networked else []
        files |= {
            f"{host.name}/units/{unit}": ExportFile(text) for unit, text in manifest.units.items()
        }
        files |= tree_files(own, f"{host.name}/trees", _HASH_DIGITS)
        files |= {
            f"{host.name}/requirements.txt": ExportFile(requirements),
            f"{host.name}/{WHEELS}/README": ExportFile(WHEELS_README),
            f"{host.name}/install.sh": ExportFile(
                install_script(name, [c.name for c in manifest.components], keys), executable=True
            ),
        }
        files |= dict(_network_files(deployment, domain, host)) if networked else {}
    return files


def _network_file(full_name: str) -> str:
    return f"private/network-{file_name(full_name)}.json"


def _identities(deployment: Deployment, host: Host) -> list[str]:
    """The common names of the certificates that a host needs."""
    components = [i for i in deployment.instances if _is_on(i.host, host) and not i.is_program]
    return [router_name(host), *(common_name(i.full_name) for i in components)]


def _is_on(place: Host, host: Host) -> bool:
    return place.is_local if host.is_local else place.name == host.name


def _network_files(
    deployment: Deployment, domain: str, host: Host
) -> Iterator[tuple[str, ExportFile]]:
    rules = access_rules(deployment, domain)
    yield f"{host.name}/{ROUTER_FILE}", ExportFile(router_settings(deployment, host, rules))
    for instance in deployment.instances:
        if _is_on(instance.host, host) and not instance.is_program:
            text = component_settings(deployment, instance)
            yield f"{host.name}/{_network_file(instance.full_name)}", ExportFile(text)
