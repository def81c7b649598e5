"""The access rules of a deployment: exactly what its descriptions declare."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
import zenoh

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.network.access_rules import (
    AccessRules,
    Grant,
    access_rules,
)
from robocomp_dsl.deploy.network.access_text import access_data, access_text
from robocomp_dsl.deploy.network.port_uses import AddedConnection
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment
from tests.deploy.network.secured_deployment import IDSL

COMPONENTS = {
    "server": "implements Job; publishes News;",
    "client": "requires Job; subscribesTo News;",
    "optional": "requires Job optional; subscribesTo News optional;",
    "clock": "publishes Clock;",
}
HOST = 'host robot { address "10.0.0.2"; };'


def deployment_of(folder: Path, body: str) -> Deployment:
    """A deployment of components of `COMPONENTS`, on the host `robot`."""
    (folder / "Tasks.idsl").write_text(IDSL)
    for name, ports in COMPONENTS.items():
        text = (
            'import "Tasks.idsl"; import "Clock.idsl";'
            if name == "clock"
            else 'import "Tasks.idsl";'
        )
        text += f" Component {name} {{ Communications {{ {ports} }}; language Python; }};"
        (folder / f"{name}.cdsl").write_text(text)
    imports = "".join(f'import "{name}.cdsl"; ' for name in COMPONENTS)
    path = folder / "app.ddsl"
    path.write_text(f"{imports} Deployment app {{ {HOST} {body} }};")
    report = Report()
    deployment = check_ddsl(path, Workspace(), report)
    messages = [each.message for each in report.sorted()]
    assert deployment, messages
    assert not report.has_errors, messages
    return deployment


def grants(rules: AccessRules, name: str) -> set[Grant]:
    return set(next(c for c in rules.components if c.name == name).grants)


def keys_of(rules: AccessRules, name: str, flow: str, message: str) -> set[str]:
    """What a component may do with one kind of message, without the presence of ports."""
    found = {g.key for g in grants(rules, name) if (g.flow, g.message) == (flow, message)}
    return {key for key in found if "RoboCompComponent" not in key}


def allows(rules: AccessRules, name: str, flow: str, message: str, key: str) -> bool:
    """Whether a rule includes the key, as zenoh decides."""
    return any(
        zenoh.KeyExpr(grant.key).includes(key)
        for grant in grants(rules, name)
        if (grant.flow, grant.message) == (flow, message)
    )


PAIR = "component server on robot; component client on robot;"


def test_access_rules_allow_client_to_call_its_server_only(tmp_path: Path) -> None:
    rules = access_rules(deployment_of(tmp_path, PAIR), "app")
    job = "rc/app/{}/Tasks::Job/*/server/Job/*"
    assert keys_of(rules, "client", "ingress", "query") == {
        job.format("q"),
        "rc/app/n/**",
        "rc/app/l/Tasks::News/*/server/*/*",
        "rc/app/h/server",
        "rc/app/i/**",
    }
    assert keys_of(rules, "client", "ingress", "put") == {job.format("c")}
    assert keys_of(rules, "server", "ingress", "put") == {"rc/app/t/Tasks::News/*/server/News/*"}
    assert keys_of(rules, "client", "ingress", "declare_queryable") == {"rc/app/i/client/*/*"}
    assert keys_of(rules, "server", "ingress", "query") == {"rc/app/i/**"}
    assert keys_of(rules, "client", "egress", "put") == {"rc/app/t/Tasks::News/*/server/*/*"}
    assert keys_of(rules, "server", "egress", "put") == {job.format("c")}


def test_access_rules_deny_everything_of_others(tmp_path: Path) -> None:
    rules = access_rules(deployment_of(tmp_path, PAIR), "app")
    other = "rc/app/q/Tasks::Job/00/other/Job/twice"
    assert not allows(rules, "client", "ingress", "query", other)
    assert not allows(rules, "client", "ingress", "query", "rc/app/q/**")
    assert not allows(rules, "client", "ingress", "declare_subscriber", "rc/app/t/**")
    assert not allows(rules, "client", "ingress", "declare_subscriber", "rc/app/**")
    assert not allows(rules, "client", "ingress", "liveliness_token", "rc/app/s/server/1/compute")
    assert allows(rules, "client", "ingress", "liveliness_token", "rc/app/s/client/1/compute")
    assert not allows(
        rules, "client", "ingress", "query", "rc/other/q/Tasks::Job/00/server/Job/twice"
    )
    assert rules.trusted == ("rcdeploy", "router.robot")


def test_access_rules_let_unconnected_optional_port_look_for_any_peer(tmp_path: Path) -> None:
    body = "component optional on robot;"
    rules = access_rules(deployment_of(tmp_path, body), "app")
    assert "rc/app/q/Tasks::Job/*/*/*/*" in keys_of(rules, "optional", "ingress", "query")
    subscribed = keys_of(rules, "optional", "ingress", "declare_subscriber")
    assert subscribed == {"rc/app/t/Tasks::News/*/*/*/*"}


def test_access_rules_extend_to_rewired_connections(tmp_path: Path) -> None:
    body = f"{PAIR} component spare : server on robot; connect client.Job -> server.Job;"
    deployment = deployment_of(tmp_path, body)
    rewired = AddedConnection("client", "Job", "spare", "Job")
    key = "rc/app/q/Tasks::Job/*/spare/Job/*"
    assert key not in keys_of(access_rules(deployment, "app"), "client", "ingress", "query")
    rules = access_rules(deployment, "app", [rewired])
    assert key in keys_of(rules, "client", "ingress", "query")
    assert key not in keys_of(rules, "server", "ingress", "query")


def test_access_rules_use_full_names_of_instances_with_prefix(tmp_path: Path) -> None:
    body = "component server on robot { prefix left; }; component client on robot { prefix left; };"
    rules = access_rules(deployment_of(tmp_path, body), "app")
    assert [component.name for component in rules.components] == ["left/server", "left/client"]
    called = keys_of(rules, "left/client", "ingress", "query")
    assert "rc/app/q/Tasks::Job/*/left%2Fserver/Job/*" in called


def test_access_rules_of_lockstep_add_timed_interfaces(tmp_path: Path) -> None:
    body = f"{PAIR} component clock on robot; clock sim from clock lockstep;"
    rules = access_rules(deployment_of(tmp_path, body), "app")
    called = keys_of(rules, "clock", "ingress", "query")
    assert called >= {
        "rc/app/q/RoboCompLockStep::Follower/*/client/Follower/*",
        "rc/app/q/RoboCompLockStep::Follower/*/server/Follower/*",
    }
    timed = "rc/app/q/Tasks::Job%20in%20step/*/server/Job/*"
    assert timed in keys_of(rules, "client", "ingress", "query")
    assert timed in keys_of(rules, "server", "ingress", "declare_queryable")
    news = "rc/app/q/Tasks::News%20in%20step/*/client/News/*"
    assert news in keys_of(rules, "server", "ingress", "query")


def test_access_rules_of_simulated_clock_let_all_subscribe_to_it(tmp_path: Path) -> None:
    body = f"{PAIR} component clock on robot; clock sim from clock;"
    rules = access_rules(deployment_of(tmp_path, body), "app")
    for name in ("client", "server"):
        subscribed = keys_of(rules, name, "ingress", "declare_subscriber")
        assert "rc/app/t/RoboCompClock::Clock/*/clock/*/*" in subscribed


def test_access_rules_join_components_of_one_process(tmp_path: Path) -> None:
    body = "group pair on robot { inprocess; component server; component client; };"
    rules = access_rules(deployment_of(tmp_path, body), "app")
    assert [component.name for component in rules.components] == ["pair"]
    for name in ("pair-server", "pair-client"):
        assert allows(rules, "pair", "ingress", "liveliness_token", f"rc/app/s/{name}/1/compute")


def test_access_rules_are_valid_for_zenoh(tmp_path: Path) -> None:
    data = access_rules(deployment_of(tmp_path, PAIR), "app").to_zenoh()
    identifiers = [rule["id"] for rule in data["rules"]]
    assert len(identifiers) == len(set(identifiers))
    assert {name for policy in data["policies"] for name in policy["rules"]} == set(identifiers)
    for rule in data["rules"]:
        for key in rule["key_exprs"]:
            zenoh.KeyExpr(key)


def test_access_text_lists_uses_in_words_of_descriptions(tmp_path: Path) -> None:
    lines = list(access_text(access_rules(deployment_of(tmp_path, PAIR), "app")))
    assert lines[0] == "access rules in the domain app; everything else is denied"
    assert "   calls Tasks::Job (queries and commands) of server.Job as Job" in lines
    assert "   subscribes to Tasks::News of server as News" in lines
    assert "   publishes Tasks::News as News" in lines
    data = access_data(access_rules(deployment_of(tmp_path, PAIR), "app"))
    assert data["components"][1]["uses"][0]["peer"] == "server"


def test_access_rules_of_large_fleet_are_fast(tmp_path: Path) -> None:
    """20 hosts with 50 components each; the limit is far above what it takes (0.1 s)."""
    parts = [f"component server{i} : server on robot;" for i in range(1000)]
    deployment = deployment_of(tmp_path, " ".join(parts))
    begun = time.process_time()
    rules = access_rules(deployment, "app")
    assert len(rules.components) == 1000
    assert time.process_time() - begun < 5.0


@pytest.mark.parametrize("name", ["a" * 64, "a" * 65, "group/" + "b" * 100])
def test_common_name_fits_certificate(name: str) -> None:
    from robocomp_dsl.deploy.network.identities import common_name  # noqa: PLC0415

    assert len(common_name(name)) <= 64
    assert (common_name(name) == name) == (len(name) <= 64)
