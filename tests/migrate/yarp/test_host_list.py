"""Lists of machines of YARP become hosts; modules without a node are placed by load."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.migrate.yarp.conftest import MigratedFiles
from tests.migrate.yarp.test_application import application

Migrate = Callable[..., MigratedFiles]

CLUSTER = """<?xml version="1.0"?>
<cluster name="lab" user="icub">
    <nameserver namespace="/root" node="icub-srv"/>
    <node ssh-options="-p 2222">icub-head</node>
    <node user="ana" address="10.0.0.7">/laptop</node>
    <node user="bob" ssh-options="-o Port=23 -X" display=":0">icub-30</node>
    NODES
</cluster>
"""
RESOURCES = """
<resources>
    <computer><name>icub-head</name><network><ip4>10.0.1.1</ip4></network></computer>
    <computer><name>spare</name><disable>yes</disable></computer>
    <computer><name>localhost</name></computer>
    <computer><name>gpu-box</name></computer>
</resources>
"""
MODULES = application(
    "<module><name>viewer</name><node>laptop</node></module>"
    "<module><name>driver</name><node>icub-head</node></module>"
    "<module><name>console</name><node>localhost</node></module>MORE"
)


def test_cluster_gives_addresses_and_users_of_nodes(migrate: Migrate) -> None:
    files = {"demo.xml": MODULES.replace("MORE", ""), "cluster.xml": CLUSTER.replace("NODES", "")}
    result = migrate(files, "cluster.xml")
    text = result.texts["demo.ddsl"]
    assert '    host laptop { address "10.0.0.7"; user "ana"; };\n' in text
    assert '    host icub_head { address "icub-head:2222"; user "icub"; };\n' in text
    assert "icub_30" not in text
    assert "program viewer on laptop\n" in text
    assert "program console\n" in text
    assert "place by load" not in text
    assert result.has("cluster.xml:6 RC979", "`display` of `icub-30`")
    assert result.has("cluster.xml:6 RC979", "`-X` of `icub-30`: write it into ~/.ssh/config")


def test_modules_without_node_are_placed_by_load_among_listed_machines(migrate: Migrate) -> None:
    more = "<module><name>planner</name></module>"
    files = {"demo.xml": MODULES.replace("MORE", more), "lab.xml": CLUSTER.replace("NODES", "")}
    text = migrate(files, "lab.xml").texts["demo.ddsl"]
    assert '    host icub_30 { address "icub-30:23"; user "bob"; };\n' in text
    planner = text.partition("program planner\n")[2]
    assert planner.startswith('    {\n        executable "planner";\n        place by load;\n')
    assert text.count("place by load") == 1


def test_resources_are_hosts_unless_disabled(migrate: Migrate) -> None:
    files = {"demo.xml": application("<module><name>a</name></module>"), "res.xml": RESOURCES}
    result = migrate(files, "res.xml")
    text = result.texts["demo.ddsl"]
    assert '    host icub_head { address "10.0.1.1"; };\n' in text
    assert '    host gpu_box { address "gpu-box"; };\n' in text
    assert "    host localhost;\n" in text
    assert "spare" not in text
    assert result.has("res.xml:4 RC981", "`spare` is disabled")


@pytest.mark.parametrize(
    ("node", "finding"),
    [
        ("<node></node>", "cluster.xml:7 RC977: a `<node>` without a name"),
        ("<node>a b</node>", "cluster.xml:7 RC977: `a b` is no address of a machine"),
        ("<node>laptop</node>", "cluster.xml:7 RC977: the machine `laptop` is listed twice"),
        ('<node user="a b">x</node>', "cluster.xml:7 RC977: `a b` is not the name of a user"),
        ('<node ssh-options="-p 99999">x</node>', "cluster.xml:7 RC979: `-p 99999` of `x`"),
        ('<node docker="img">x</node>', "cluster.xml:7 RC979: `docker` of `x` (`img`)"),
        ('<node ssh-options="-i \'a">x</node>', "cluster.xml:7 RC979: `-i 'a` of `x`"),
    ],
)
def test_invalid_machines_are_reported(migrate: Migrate, node: str, finding: str) -> None:
    files = {
        "demo.xml": application("<module><name>planner</name></module>"),
        "cluster.xml": CLUSTER.replace("NODES", node),
    }
    result = migrate(files, "cluster.xml")
    assert any(each.startswith(finding) for each in result.findings), result.findings


def test_list_without_application_is_reported(migrate: Migrate) -> None:
    result = migrate({"res.xml": RESOURCES})
    assert result.has("res.xml:", "RC991", "name the application that uses these machines")
    assert result.texts == {}
