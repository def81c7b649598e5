"""A deployment as DDSL, and CDSL files for the stand-ins in it.

In: a `Draft`, the places of its components. Out: `OutputFile`s.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robocomp_dsl.generate.literals import printable
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate.deployment import relative
from robocomp_dsl.migrate.instances import Draft, Instance, host_of, hosts_of
from robocomp_dsl.model.interface import Interface, Module

PEERS = "peers"
STEP = "    "


def ddsl_text(name: str, draft: Draft, places: Mapping[int, str], doc: str) -> str:
    """The deployment. `places` has the folder of each `Moved` by its `id`, seen from the file."""
    hosts = hosts_of(draft.instances)
    used = {id(one.moved): one.moved for one in draft.instances if one.moved}
    imports = [relative(m.description, places[key]) for key, m in used.items()]
    imports += [peer_path(one) for one in draft.instances if one.moved is None]
    rows = [f'import "{path}";' for path in imports]
    rows += ["", f"/** {doc} */", f"Deployment {name}", "{"]
    for address, (called, user) in hosts.items():
        login = f" user {user};" if user else ""
        rows.append(f'{STEP}host {called} {{ address "{address}";{login} }};')
    rows += [""] if hosts else []
    for one in draft.instances:
        rows += _instance(one, {a: n for a, (n, _) in hosts.items()}, places)
    rows += [""] if draft.wires else []
    rows += [f"{STEP}connect {a}.{p} -> {b}.{q};" for a, p, b, q in draft.wires]
    return "\n".join([*rows, "};", ""])


def _instance(one: Instance, hosts: Mapping[str, str], places: Mapping[int, str]) -> Iterator[str]:
    for remark in one.remarks:
        yield f"{STEP}// {printable(remark)}"
    kind = f" : {one.moved.name}" if one.moved and one.moved.name != one.name else ""
    host = hosts.get(host_of(one))
    place = f" on {host}" if host else ""
    items = []
    if one.moved and one.config:
        items.append(f'config "{relative(one.config.new, places[id(one.moved)])}";')
    if one.port:
        items.append(f"port {one.port};")
    if one.after:
        items.append(f"after {', '.join(one.after)};")
    body = f" {{ {' '.join(items)} }}" if items else ""
    yield f"{STEP}component {one.name}{kind}{place}{body};"


def peer_path(one: Instance) -> str:
    """Where the description of a stand-in is: in a folder of its own, as for any component."""
    return f"{PEERS}/{one.name}/{one.name}.cdsl"


def peer_files(draft: Draft, modules: Mapping[str, Module]) -> Iterator[OutputFile]:
    """The CDSL files of the stand-ins; `modules` are those of the interfaces, by name."""
    for one in draft.instances:
        if one.moved is None:
            yield OutputFile(peer_path(one), peer_text(one, modules))


def peer_text(one: Instance, modules: Mapping[str, Module]) -> str:
    """The description of one stand-in."""
    files = dict.fromkeys(modules[i.module].path.name for i in one.peer if i.module in modules)
    rows = [f'import "{name}";' for name in files]
    rows += [""] if rows else []
    where = ", ".join(f"{a.host or 'localhost'}:{a.port}" for a in one.listens if a.port)
    at = f"at {printable(where)} " if where else ""
    rows += [
        f"/** Stands for the component {at}whose description was not at hand. */",
        f"Component {one.name}",
        "{",
        f"{STEP}Communications",
        f"{STEP}{{",
    ]
    names = ", ".join(i.name for i in one.peer)
    rows += [f"{STEP * 2}implements {names};"] if names else []
    rows += [f"{STEP}}};", f"{STEP}language Python;", "};", ""]
    return "\n".join(rows)


def interfaces_in(modules: Mapping[str, Module]) -> Iterator[Interface]:
    """All interfaces of some modules."""
    for one in modules.values():
        yield from one.interfaces
