"""Old configurations become parameters whose generated class loads the same values."""

from __future__ import annotations

import random
import runpy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.check import check_cdsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import plan
from robocomp_dsl.migrate.config import Config, read_config
from robocomp_dsl.migrate.ice import divide
from robocomp_dsl.migrate.infer import Leaf, Parameters, infer
from robocomp_dsl.migrate.texts import leaves, pdsl_text, yaml_text
from robocomp_dsl.runtime.parameters import Parameters as Loaded
from robocomp_dsl.source import Source

Expected = Mapping[str, object]

CASES: dict[str, tuple[Mapping[str, str], tuple[Expected, ...]]] = {
    "text": (
        {
            "config": """# Endpoints for implements interfaces
Laser.Endpoints=tcp -p 10003
GenericBaseProxy = genericbase:tcp -h localhost -p 10004
Ice.Warn.Connections=0

InnerModelPath = /home/robocomp/etc/world.xml
Laser.Driver = HokuyoURG30LX
Laser.StartValue = 180
Laser.Rate=0.50
Laser.TalkToBase = False
# how far it sees
Laser.Range.Max = 4e3
Empty =
Zero = 007
Speed = 0.5 m/s
Joints = 1,2,3
Colour = \\#ff0000
Words = a "quoted" \\\\ word: {x} # a remark
""",
        },
        (
            {
                "InnerModelPath": "/home/robocomp/etc/world.xml",
                "Laser.Driver": "HokuyoURG30LX",
                "Laser.StartValue": 180,
                "Laser.Rate": 0.5,
                "Laser.TalkToBase": False,
                "Laser.Range.Max": 4000.0,
                "Empty": "",
                "Zero": "007",
                "Speed": "0.5 m/s",
                "Joints": "1,2,3",
                "Colour": "#ff0000",
                "Words": 'a "quoted" \\ word: {x}',
            },
        ),
    ),
    "several files": (
        {
            "config": "a = 1\nb = true\nc = 5\nd = x\n",
            "config_sim": "a = 1.5\nb = false\nc = seven\n",
        },
        (
            {"a": 1.0, "b": True, "c": "5", "d": "x"},
            {"a": 1.5, "b": False, "c": "seven", "d": "x"},
        ),
    ),
    "toml": (
        {
            "config.toml": """[Endpoints]
Lidar3D = "tcp -p 12000"
[Proxies]
TopicManager = "IceStorm/TopicManager:default -p 9999"
IMUPubPrefix = ""
[Config]
Display = true
# where it is
Extrinsic = [0, 0.5, 2]
Names = ["a", 'b "c"']
None = []
Grid = [[1, 2], [3, 4]]
Text = "1"
Lines = "a\\nb\\tc"
[Period]
Compute = 20
[Ice]
Warn.Connections = "0"
""",
        },
        (
            {
                "Config.Display": True,
                "Config.Extrinsic": [0.0, 0.5, 2.0],
                "Config.Names": ["a", 'b "c"'],
                "Config.None": [],
                "Config.Grid": "[[1, 2], [3, 4]]",
                "Config.Text": "1",
                "Config.Lines": "a\nb\tc",
                "Period.Compute": 20,
            },
        ),
    ),
    "names": (
        {"config": "Robot-Name = x\nRobot_Name = y\n1st = 2\nlive = 3\nstring = 4\nbind = 5\n"},
        (
            {
                "Robot_Name": "y",
                "Robot_Name_": "x",
                "_1st": 2,
                "live": 3,
                "string_": 4,
                "bind": 5,
            },
        ),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_generated_class_loads_the_values_of_every_file(name: str, tmp_path: Path) -> None:
    texts, expected = CASES[name]
    configs, found, report = inferred(texts)
    assert not report.failed, list(report)
    made = generated_class(found, tmp_path)
    for config, values, wanted in zip(configs, found.values, expected, strict=True):
        file = tmp_path / f"{config.path.name}.yaml"
        file.write_text(yaml_text("moved", found.tree, values, config.path.name))
        assert flat(made.load(file)) == wanted


def inferred(texts: Mapping[str, str]) -> tuple[list[Config], Parameters, Report]:
    report = Report()
    read = (read_config(Source(Path(name), text), report) for name, text in texts.items())
    configs = [one for one in read if one is not None]
    return configs, infer([(c, divide(c, report)[1]) for c in configs], report), report


def generated_class(found: Parameters, folder: Path) -> type[Loaded]:
    """The parameters class of a component that has the inferred PDSL file."""
    (folder / "moved.pdsl").write_text(pdsl_text("moved", found.tree, "config"), "utf-8")
    description = folder / "moved.cdsl"
    description.write_text(
        'Component moved { Communications { }; language Python; parameters "moved.pdsl"; };'
    )
    report = Report()
    component = check_cdsl(description, Workspace(), report)
    assert not list(report)
    assert component is not None
    code = next(one.text for one in plan(component) if one.path == "generated/params.py")
    module = folder / "params.py"
    module.write_text(code, "utf-8")
    made: type[Loaded] = runpy.run_path(str(module))["MovedParams"]
    return made


def flat(loaded: Loaded) -> dict[str, object]:
    """The values by the path of each; lists of groups as lists of what is in them."""
    return dict(_flat(loaded, ""))


def _flat(group: Any, path: str) -> Any:
    for entry in type(group).SCHEMA:
        value = getattr(group, entry.attribute)
        if isinstance(value, list):
            yield path + entry.name, [one.value for one in value]
        elif hasattr(type(value), "SCHEMA"):
            yield from _flat(value, f"{path}{entry.name}.")
        else:
            yield path + entry.name, value


def test_findings_say_file_and_line() -> None:
    _, _, report = inferred(
        {"config": "a = 1\na = 2\nnonsense\nb.c = 1\nb = 2\n", "other": "a = 5\nb.c=2"}
    )
    said = [(d.code.id, d.span.source.path.name, d.span.begin[0]) for d in report.sorted()]
    assert said == [("RC932", "config", 1), ("RC931", "config", 3), ("RC933", "config", 5)]


@pytest.mark.parametrize(
    ("text", "line"),
    [("a = \n", 1), ("a = 1\n\na = 2\n", 3), ("x = 1\n[[", 2), ("a" * 10, 1)],
)
def test_broken_toml_is_told_with_its_line(text: str, line: int) -> None:
    report = Report()
    assert read_config(Source(Path("config.toml"), text), report) is None
    (told,) = report
    assert (told.code.id, told.span.begin[0]) == ("RC921", line)


def test_addresses_of_text_and_toml() -> None:
    report = Report()
    text = """CommonBehavior.Endpoints=tcp -p 10000
Laser.Endpoints=tcp -h robot -p 10003 -t 5
JointMotor0Proxy = jointmotor:tcp -h 10.0.30.11 -p 20000:udp -p 1
TopicManager.Proxy=IceStorm/TopicManager:default -p 9999
CameraProxy = /dev/video0
"""
    source = Source(Path("config"), text)
    config = read_config(source, report)
    assert config is not None
    found, rest = divide(config, report)
    ends = [(a.name, a.host, a.port) for a in found.endpoints]
    assert ends == [("CommonBehavior", "", 10000), ("Laser", "robot", 10003)]
    calls = [(a.name, a.identity, a.host, a.port) for a in found.proxies]
    assert calls == [("JointMotor0", "jointmotor", "10.0.30.11", 20000)]
    assert [one.key for one in rest] == ["CameraProxy"]


PIECES = (
    *("0", "1", "-1", "007", "1e5", ".5", "5.", "1e999", "0x10", "nan", "inf", "true", "FALSE"),
    *("yes", "null", "~", "", " ", "a", "é", "\\", '"', "'", ":", ": ", " #", "-", "- a", "{", "["),
    *("*/", "/*", "//", "1,2", "\t", "%s", "{{ x }}", "\u2028", "\x85", "\ufeff", "x" * 300),
)
KEYS = (
    *("a", "b", "a.b", "a.c", "a.b.c", "A", "live", "bool", "class", "self", "value", "SCHEMA"),
    *("set", "1x", "é", "a b", "a-b", "a..b", ".a", "x.Proxy", "_", "__init__", "yes", "null"),
)


@pytest.mark.parametrize("seed", range(40))
def test_any_text_configuration_loads_what_it_says(seed: int, tmp_path: Path) -> None:
    chance = random.Random(seed)

    def some() -> str:
        rows = []
        for key in chance.sample(KEYS, 8):
            comment = "".join(chance.choices(PIECES, k=2)).replace("#", "")
            rows.append(f"# {comment}")
            rows.append(f"{key} = {''.join(chance.choices(PIECES, k=chance.randint(1, 2)))}")
        return chance.choice(("\n", "\r\n")).join(rows)

    configs, found, _ = inferred({"config": some(), "config_b": some()})
    made = generated_class(found, tmp_path)
    for config, values in zip(configs, found.values, strict=True):
        file = tmp_path / "c.yaml"
        file.write_text(yaml_text("moved", found.tree, values, config.path.name), "utf-8")
        loaded = flat(made.load(file))
        for path, value in values.items():
            assert loaded[".".join(path)] == value
        given = {one.path: one.value for one in config.entries}
        for path, node in leaves(found.tree):
            if isinstance(node, Leaf) and node.old in given and path in values:
                kind = type(values[path])
                text = given[node.old]
                assert values[path] == ((text.lower() == "true") if kind is bool else kind(text))


def test_what_a_file_lacks_is_one_finding() -> None:
    keys = "\n".join(f"k{i} = {i}" for i in range(7))
    _, _, report = inferred({"config": f"{keys}\nx = 1\n", "a": "x = 2\n", "b": f"{keys}\n"})
    said = [d.message for d in report.sorted() if d.code.id == "RC936"]
    assert said == [
        "`a` does not give `k0`, `k1`, `k2`, `k3`, `k4` and 2 more; they have their defaults there",
        "`b` does not give `x`; it has its default there",
    ]


PYTHONIC = """noSafe=True
text = "x = True" # = False
[a]
b = False  # off
c = 'True'
"""


def test_truth_as_python_writes_it() -> None:
    report = Report()
    config = read_config(Source(Path("config.toml"), PYTHONIC), report)
    assert config is not None
    values = {one.key: one.value for one in config.entries}
    assert values == {"noSafe": True, "text": "x = True", "a.b": False, "a.c": "True"}
    said = [(d.code.id, d.span.begin, d.span.text) for d in report.sorted()]
    assert said == [("RC939", (1, 8), "True"), ("RC939", (4, 5), "False")]


COMMENTED = """[a]
# ══════════════
# ── Early exit ──
early = true  # not this
far = 0.15  # in m
steps = 5     # warm-up
               # of some frames
               # ─────
next = 1

# alone

odd = "a # b"  # is 'it'
even = 'c # d'
list = [1, 2]  # some
"""


def test_comments_of_toml() -> None:
    config = read_config(Source(Path("config.toml"), COMMENTED), Report())
    assert config is not None
    assert {one.key: one.doc for one in config.entries} == {
        "a.early": "Early exit",
        "a.far": "in m",
        "a.steps": "warm-up\nof some frames",
        "a.next": "",
        "a.odd": "is 'it'",
        "a.even": "",
        "a.list": "some",
    }
