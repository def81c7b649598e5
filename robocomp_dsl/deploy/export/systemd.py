"""A deployment as user units of systemd, with a script that installs them. Pure.

The units are those that `rcdeploy up` writes on hosts. In: a checked deployment. Out: a folder for
each host with units, files of the components, requirements and `install.sh`.
"""

from __future__ import annotations

from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.export import codes
from robocomp_dsl.deploy.export.folder import ExportFile, tree_files
from robocomp_dsl.deploy.export.image import WHEELS, WHEELS_README
from robocomp_dsl.deploy.export.prepare import PYTHON
from robocomp_dsl.deploy.export.requirements import locked_requirements
from robocomp_dsl.deploy.export.systemd_texts import ENVIRONMENT, install_script, systemd_readme
from robocomp_dsl.deploy.hosts.description import (
    HostSettings,
    deployment_hosts,
    describe_hosts,
    processes_of,
)
from robocomp_dsl.deploy.hosts.host_network import HostNetwork, first_component
from robocomp_dsl.deploy.network.access_rules import access_rules
from robocomp_dsl.deploy.network.identities import (
    common_name,
    host_name,
    needs_network,
    router_name,
    used_hosts,
)
from robocomp_dsl.deploy.network.key_folder import file_name
from robocomp_dsl.deploy.network.router_plan import component_settings, router_settings
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment

ROUTER_FILE = "private/exported-router.json"
_HASH_DIGITS = 64


def systemd_files(
    deployment: Deployment, name: str, domain: str, report: Report
) -> dict[str, ExportFile]:
    """All files of the folder; those of a host are below its name."""
    planned = plan(deployment, name=name, domain=domain, interpreter=PYTHON)
    for connection in deployment.external_connections:
        report.add(
            codes.INEXPRESSIBLE,
            connection.span,
            f"nobody connects {connection.source} -> {connection.target}",
            help="rcdeploy makes this connection only for deployments that it runs itself",
        )
    trees = describe_trees(deployment, planned, report)
    hosts = deployment_hosts(deployment)
    networks = {host.name: _network(deployment, planned, host.name) for host in hosts}
    settings = {n: HostSettings(PYTHON, ENVIRONMENT, network=net) for n, net in networks.items()}
    manifests = describe_hosts(deployment, planned, trees, settings, report)
    requirements = locked_requirements(deployment, planned, trees, report)
    files: dict[str, ExportFile] = {"README.md": ExportFile(systemd_readme(deployment, hosts))}
    for host in hosts:
        manifest, network = manifests[host.name], networks[host.name]
        processes = processes_of(host.name, deployment, planned)
        identities = [common_name(p.name) for p in processes if p.name in network.settings]
        if network.router:
            identities.insert(0, network.router)
        script = install_script(name, [c.name for c in manifest.components], identities)
        own = {f"units/{unit}": ExportFile(text) for unit, text in manifest.units.items()}
        own |= tree_files([trees[p.name] for p in processes], "trees", _HASH_DIGITS)
        own |= {path: ExportFile(data.decode()) for path, data in network.files.items()}
        own |= {
            "requirements.txt": ExportFile(requirements),
            f"{WHEELS}/README": ExportFile(WHEELS_README),
            "install.sh": ExportFile(script, executable=True),
        }
        files |= {f"{host.name}/{path}": file for path, file in own.items()}
    return files


def _network(deployment: Deployment, planned: Plan, name: str) -> HostNetwork:
    """The settings of a host without keys, which `install.sh` copies; none on one machine."""
    if not needs_network(deployment):
        return HostNetwork()
    host = next(each for each in used_hosts(deployment) if host_name(each) == name)
    router = router_name(host)
    rules = access_rules(deployment, planned.domain)
    settings = {router: ROUTER_FILE}
    files = {ROUTER_FILE: router_settings(deployment, host, rules).encode()}
    instances = {instance.full_name: instance for instance in deployment.instances}
    for process in processes_of(name, deployment, planned):
        if not process.is_program:
            path = f"private/network-{file_name(process.name)}.json"
            settings[process.name] = path
            files[path] = component_settings(
                deployment, instances[first_component(process)]
            ).encode()
    return HostNetwork(files, settings, dict.fromkeys(settings, ""), router)
