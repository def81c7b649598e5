"""Applications of yarpmanager as deployments: programs, connections and findings."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from robocomp_dsl.migrate.yarp.programs import split_arguments
from tests.migrate.yarp.conftest import MigratedFiles

Migrate = Callable[..., MigratedFiles]


def application(body: str, name: str = "Demo") -> str:
    return f"<application>\n<name>{name}</name>\n{body}\n</application>\n"


def module(body: str, name: str = "viewer") -> str:
    return application(f"<module><name>{name}</name>{body}</module>")


def link(body: str, attributes: str = "") -> str:
    return application(f"<connection {attributes}>{body}</connection>")


ENDS = "<from>/a:o</from><to>/b:i</to>"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (module(""), 'executable "viewer";'),
        (module("<parameters> --x 1  --y 2 </parameters>"), 'executable "viewer --x 1 --y 2";'),
        (
            module("<parameters>--data \"(a b)\" --t 'x'</parameters>"),
            "executable \"viewer --data '(a b)' --t ''\\\"'\\\"'x'\\\"'\\\"''\";",
        ),
        (module("<deployer>yarpdev</deployer>"), 'executable "yarpdev --device viewer";'),
        (module("<broker>yarpdev</broker>"), 'executable "yarpdev --device viewer";'),
        (module("<deployer>lua</deployer>", "a.lua"), 'executable "lua a.lua";'),
        (module("<workdir>/tmp/my dir</workdir>"), "executable \"env -C '/tmp/my dir' viewer\";"),
        (module("", "yarp rpc /x/rpc:i"), 'executable "yarp rpc /x/rpc:i";'),
        (module("", "/usr/bin/viewer.sh"), "program viewer\n"),
        (module("<tag>left view</tag>"), "program left_view\n"),
        (module("<prefix>/left</prefix>"), 'env YARP_PORT_PREFIX = "/left";'),
        (module("<environment>A=1;B=x y=z</environment>"), 'env B = "x y=z";'),
        (module("<display>:0.0</display>"), 'env DISPLAY = ":0.0";'),
        (module("<node>icub-head</node>"), 'host icub_head { address "icub-head"; };'),
        (module("<node>/surfer</node>"), "program viewer on surfer\n"),
        (module("<node>localhost</node>"), "program viewer\n"),
        (module("<ensure><wait>2.5</wait></ensure>"), "ready after 2.5 s;"),
        (module('<ensure><wait when="start">3</wait></ensure>'), "ready after 3 s;"),
        (
            module('<dependencies><port timeout="5.0">/cam</port></dependencies>'),
            "run_when --timeout 5 /cam -- viewer",
        ),
        (
            module("<workdir>/w</workdir><dependencies><port>/cam</port></dependencies>"),
            "run_when --timeout 10 --folder /w /cam -- viewer",
        ),
        (link(ENDS), 'connect yarp "/a:o" -> "/b:i";'),
        (
            link("<output>/a:o</output><input>/b:i</input>", 'id="c" persist="true"'),
            'connect yarp "/a:o" -> "/b:i";',
        ),
        (link(f"{ENDS}<protocol>fast_tcp</protocol>"), '"/b:i" carrier fast_tcp;'),
        (
            link(f"{ENDS}<protocol>udp+recv.portmonitor+type.lua+file.m</protocol>"),
            'carrier "udp+recv.portmonitor+type.lua+file.m";',
        ),
        (link('<from external="true">a:o</from><to> /b:i </to>'), 'connect yarp "/a:o" -> "/b:i";'),
        (
            application('<var name="robot">icub</var><module><name>v-${robot}</name></module>'),
            'executable "v-icub";',
        ),
        (application("<description>Two & <!-- x -- y --> eyes</description>"), " * Two & eyes\n"),
        (
            application('<authors><author email="a@b.c">Ann</author></authors>'),
            " * Ann <a@b.c>\n",
        ),
        (application("<version>1.0</version>"), " * Version 1.0\n"),
        (f"<?xml version='1.0'?>\n<!-- <robot> -->\n{module('')}", "program viewer\n"),
    ],
)
def test_application_element_becomes_line(migrate: Migrate, text: str, line: str) -> None:
    assert line in migrate({"demo.xml": text}).texts["demo.ddsl"]


@pytest.mark.parametrize(
    ("text", "finding"),
    [
        (application("<modul/>"), "demo.xml:3 RC976: `<modul>` is unknown"),
        (module("<parameter>x</parameter>"), "demo.xml:3 RC976: `<parameter>`"),
        (application("<module><parameters/></module>"), "demo.xml:3 RC977: a module without"),
        (link("<from>/a</from>"), "demo.xml:3 RC977: a connection needs `<from>` and `<to>`"),
        (link("<from>/a b</from><to>/c</to>"), "RC977: `/a b` is not the name of a port"),
        (link(f"{ENDS}<protocol>a b</protocol>"), "RC977: the carrier `a b` is not valid"),
        (link(ENDS, 'qos="(level:high)"'), "RC979: the quality of service"),
        (application(2 * f"<connection>{ENDS}</connection>"), "RC981: `/a:o` is connected to"),
        (module("<environment>A</environment>"), "RC977: `A` of `viewer` is no `NAME=value`"),
        (module("<ensure><wait>x</wait></ensure>"), "RC977: `x` is no number of seconds"),
        (module('<ensure><wait when="stop">2</wait></ensure>'), "rcdeploy up --grace 2"),
        (module("<node>a b</node>"), "RC979: `a b` is not the name of a machine"),
        (module("<node>icub30</node>"), "RC978: `viewer` and others run on `icub30`"),
        (module("<stdio>icub14</stdio>"), "RC981: `stdio` of `viewer`"),
        (module("<rank>3</rank>"), "RC981: `rank` of `viewer`"),
        (module("<deployer>lua</deployer>"), "RC979: `viewer` is run by `lua`"),
        (module("<portmap><old>/a</old><new>/b</new></portmap>"), "RC979: `viewer`: the port map"),
        (
            module('<dependencies><port request="s" reply="ok">/a</port></dependencies>'),
            "the reply to `s` is not checked",
        ),
        (application("<dependencies><port>/a</port></dependencies>"), "RC981: the connections"),
        (application("<dependencies><prt>/a</prt></dependencies>"), "RC976: `<prt>`"),
        (
            application('<arbitrator><port>/a</port><rule connection="c">~x</rule></arbitrator>'),
            "demo.xml:3 RC982: the arbitrator of `/a`",
        ),
        (application("<application><name>X</name></application>"), "RC983: there is no file of"),
        (application("<application><name>Demo</name></application>"), "RC983: the application"),
        (application("<application/>"), "RC977: a nested application without `<name>`"),
        (application("<prefix>/x</prefix>"), "RC979: `<prefix>/x</prefix>` of the application"),
        (application("<module><name>${x}</name></module>"), "RC977: the variable `${x}`"),
        ("<application/>", "RC979: the application has no `<name>`"),
        ("<application><name>x", "RC182: `<name>` is not closed"),
        ('<cluster name="a"/>', "RC991: `<cluster>`"),
        ("<module><name>x</name></module>", "RC991: `<module>`"),
        ("<params/>", "RC991: `<params>`"),
    ],
)
def test_application_element_is_reported(migrate: Migrate, text: str, finding: str) -> None:
    assert migrate({"demo.xml": text}).has(finding)


def test_application_reads_the_environment_and_reports_it(
    migrate: Migrate, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROBOT_FOR_TEST", "icub")
    migrated = migrate({"demo.xml": module("", "v-$ENV{ROBOT_FOR_TEST}")})
    assert 'executable "v-icub";' in migrated.texts["demo.ddsl"]
    assert migrated.has("RC979", "was replaced by its value now, `icub`")


def test_nested_applications_get_the_prefixes_of_all_levels(migrate: Migrate) -> None:
    nested = "<application><name>{}</name><prefix>{}</prefix></application>"
    inner = (
        "<module><name>grab</name><prefix>/eye</prefix></module>"
        '<connection><from>/a:o</from><to external="true">/log</to></connection>'
        "<connection><from>/known:o</from><to>/b:i</to></connection>"
        "<dependencies><port>/known:o</port></dependencies>"
    )
    migrated = migrate(
        {
            "robot.xml": application(
                nested.format("Two Eyes", "/robot") + nested.format("Eye", "/third"), "Robot"
            ),
            "eyes.xml": application(
                nested.format("Eye", "/left") + nested.format("Eye", "/right"), "Two Eyes"
            ),
            "eye.xml": application(inner, "Eye"),
            "other.txt": "no XML",
        }
    )
    text = migrated.texts["robot.ddsl"]
    assert list(migrated.texts) == ["robot.ddsl"]
    for prefix in ("/robot/left", "/robot/right", "/third"):
        assert f'env YARP_PORT_PREFIX = "{prefix}/eye";' in text
        assert f'connect yarp "{prefix}/a:o" -> "/log";' in text
        assert f'connect yarp "/known:o" -> "{prefix}/b:i";' in text
    assert [f"program {name}\n" in text for name in ("grab", "grab_2", "grab_3")] == [True] * 3


def test_nested_applications_of_the_command_line_are_in_one_deployment(migrate: Migrate) -> None:
    files = {
        "robot.xml": application("<application><name>Eye</name></application>", "Robot"),
        "eye.xml": application("<module><name>grab</name></module>", "Eye"),
        "robot.template.xml": application("", "Another"),
    }
    migrated = migrate(files, "eye.xml", "robot.template.xml")
    assert list(migrated.texts) == ["robot.ddsl", "robot_2.ddsl"]


def test_split_arguments_groups_words_by_double_quotes_only() -> None:
    assert split_arguments('a "b c" d"e f"g "open x') == ["a", "b c", "de fg", "open x"]
