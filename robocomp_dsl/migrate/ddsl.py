"""Write a deployment as DDSL, and CDSL files for its stand-ins.

In: a `DeploymentDraft`, the folders of its components. Out: `OutputFile`s.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robocomp_dsl.generate.literals import printable
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate.deployment import join_path
from robocomp_dsl.migrate.instances import DeploymentDraft, MigratedInstance, host_of, hosts_of
from robocomp_dsl.model.interface import Interface, Module

PEERS = "peers"
STEP = "    "


def ddsl_text(name: str, draft: DeploymentDraft, places: Mapping[int, str], doc: str) -> str:
    """The deployment. `places` has the folder of each `MigratedComponent` by its `id`."""
    hosts = hosts_of(draft.instances)
    used = {
        id(instance.migrated): instance.migrated
        for instance in draft.instances
        if instance.migrated
    }
    imports = [join_path(m.description, places[key]) for key, m in used.items()]
    imports += [peer_path(instance) for instance in draft.instances if instance.migrated is None]
    rows = [f'import "{path}";' for path in imports]
    rows += ["", f"/** {doc} */", f"Deployment {name}", "{"]
    for address, (called, user) in hosts.items():
        login = f" user {user};" if user else ""
        rows.append(f'{STEP}host {called} {{ address "{address}";{login} }};')
    rows += [""] if hosts else []
    for instance in draft.instances:
        rows += _instance(instance, {a: n for a, (n, _) in hosts.items()}, places)
    rows += [""] if draft.connections else []
    rows += [f"{STEP}connect {a}.{p} -> {b}.{q};" for a, p, b, q in draft.connections]
    return "\n".join([*rows, "};", ""])


def _instance(
    instance: MigratedInstance, hosts: Mapping[str, str], places: Mapping[int, str]
) -> Iterator[str]:
    for remark in instance.comments:
        yield f"{STEP}// {printable(remark)}"
    kind = (
        f" : {instance.migrated.name}"
        if instance.migrated and instance.migrated.name != instance.name
        else ""
    )
    host = hosts.get(host_of(instance))
    place = f" on {host}" if host else ""
    items = []
    if instance.migrated and instance.config:
        items.append(f'config "{join_path(instance.config.new, places[id(instance.migrated)])}";')
    if instance.port:
        items.append(f"port {instance.port};")
    if instance.after:
        items.append(f"after {', '.join(instance.after)};")
    body = f" {{ {' '.join(items)} }}" if items else ""
    yield f"{STEP}component {instance.name}{kind}{place}{body};"


def peer_path(instance: MigratedInstance) -> str:
    """The path of a stand-in's description, in a folder of its own."""
    return f"{PEERS}/{instance.name}/{instance.name}.cdsl"


def peer_files(draft: DeploymentDraft, modules: Mapping[str, Module]) -> Iterator[OutputFile]:
    """The CDSL files of the stand-ins; `modules` are those of the interfaces, by name."""
    for instance in draft.instances:
        if instance.migrated is None:
            yield OutputFile(peer_path(instance), peer_text(instance, modules))


def peer_text(instance: MigratedInstance, modules: Mapping[str, Module]) -> str:
    """The description of one stand-in."""
    files = dict.fromkeys(
        modules[i.module].path.name for i in instance.peer_interfaces if i.module in modules
    )
    rows = [f'import "{name}";' for name in files]
    rows += [""] if rows else []
    addresses = ", ".join(f"{a.host or 'localhost'}:{a.port}" for a in instance.endpoints if a.port)
    location = f"at {printable(addresses)} " if addresses else ""
    rows += [
        f"/** Stand-in for the component {location}whose description was not available. */",
        f"Component {instance.name}",
        "{",
        f"{STEP}Communications",
        f"{STEP}{{",
    ]
    names = ", ".join(i.name for i in instance.peer_interfaces)
    rows += [f"{STEP * 2}implements {names};"] if names else []
    rows += [f"{STEP}}};", f"{STEP}language Python;", "};", ""]
    return "\n".join(rows)


def interfaces_in(modules: Mapping[str, Module]) -> Iterator[Interface]:
    """All interfaces of some modules."""
    for module in modules.values():
        yield from module.interfaces
