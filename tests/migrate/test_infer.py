"""Parameters are inferred from old configurations; their class loads the same values."""

from __future__ import annotations

import random
import runpy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.migrate.config import Config, read_config
from robocomp_dsl.migrate.ice import split_ice_settings
from robocomp_dsl.migrate.infer import InferredParameters, ScalarParameter, infer
from robocomp_dsl.migrate.parameter_files import pdsl_text, walk_parameters, yaml_text
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
def test_generated_class_loads_values_of_every_file(name: str, tmp_path: Path) -> None:
    texts, expected = CASES[name]
    configs, parameters, report = inferred(texts)
    assert not report.has_errors, list(report)
    params_class = generated_class(parameters, tmp_path)
    for config, values, loaded in zip(configs, parameters.values, expected, strict=True):
        file = tmp_path / f"{config.path.name}.yaml"
        file.write_text(yaml_text("moved", parameters.tree, values, config.path.name))
        assert flat(params_class.load(file)) == loaded


def inferred(texts: Mapping[str, str]) -> tuple[list[Config], InferredParameters, Report]:
    report = Report()
    read = (read_config(Source(Path(name), text), report) for name, text in texts.items())
    configs = [config for config in read if config is not None]
    return configs, infer([(c, split_ice_settings(c, report)[1]) for c in configs], report), report


def generated_class(parameters: InferredParameters, folder: Path) -> type[Loaded]:
    """The parameters class of a component that has the inferred PDSL file."""
    (folder / "moved.pdsl").write_text(pdsl_text("moved", parameters.tree, "config"), "utf-8")
    description = folder / "moved.cdsl"
    description.write_text(
        'Component moved { Communications { }; language Python; parameters "moved.pdsl"; };'
    )
    report = Report()
    component = check_cdsl(description, Workspace(), report)
    assert not list(report)
    assert component is not None
    code = next(file.text for file in plan(component) if file.path == "moved_generated/params.py")
    module = folder / "params.py"
    module.write_text(code, "utf-8")
    params_class: type[Loaded] = runpy.run_path(str(module))["MovedParams"]
    return params_class


def flat(loaded: Loaded) -> dict[str, object]:
    """The values by path; lists are values."""
    return dict(_flat(loaded, ""))


def _flat(group: Any, path: str) -> Any:
    for entry in type(group).SCHEMA:
        value = getattr(group, entry.attribute)
        if isinstance(value, list):
            yield path + entry.name, value
        elif hasattr(type(value), "SCHEMA"):
            yield from _flat(value, f"{path}{entry.name}.")
        else:
            yield path + entry.name, value


def test_infer_findings_have_file_and_line() -> None:
    _, _, report = inferred(
        {"config": "a = 1\na = 2\nnonsense\nb.c = 1\nb = 2\n", "other": "a = 5\nb.c=2"}
    )
    findings = [
        (d.code.id, d.span.source.path.name, d.span.start_position[0]) for d in report.sorted()
    ]
    assert findings == [("RC932", "config", 1), ("RC931", "config", 3), ("RC933", "config", 5)]


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
def test_generated_class_loads_any_text_configuration(seed: int, tmp_path: Path) -> None:
    rng = random.Random(seed)

    def random_config() -> str:
        rows = []
        for key in rng.sample(KEYS, 8):
            comment = "".join(rng.choices(PIECES, k=2)).replace("#", "")
            rows.append(f"# {comment}")
            rows.append(f"{key} = {''.join(rng.choices(PIECES, k=rng.randint(1, 2)))}")
        return rng.choice(("\n", "\r\n")).join(rows)

    configs, parameters, _ = inferred({"config": random_config(), "config_b": random_config()})
    params_class = generated_class(parameters, tmp_path)
    for config, values in zip(configs, parameters.values, strict=True):
        file = tmp_path / "c.yaml"
        file.write_text(yaml_text("moved", parameters.tree, values, config.path.name), "utf-8")
        loaded = flat(params_class.load(file))
        for path, value in values.items():
            assert loaded[".".join(path)] == value
        entries = {entry.path: entry.value for entry in config.entries}
        for path, node in walk_parameters(parameters.tree):
            if isinstance(node, ScalarParameter) and node.old_path in entries and path in values:
                kind = type(values[path])
                text = entries[node.old_path]
                assert values[path] == ((text.lower() == "true") if kind is bool else kind(text))


def test_infer_reports_missing_keys_once_per_file() -> None:
    keys = "\n".join(f"k{i} = {i}" for i in range(7))
    _, _, report = inferred({"config": f"{keys}\nx = 1\n", "a": "x = 2\n", "b": f"{keys}\n"})
    messages = [d.message for d in report.sorted() if d.code.id == "RC936"]
    assert messages == [
        "`a` lacks `k0`, `k1`, `k2`, `k3`, `k4` and 2 more; their defaults apply",
        "`b` lacks `x`; its default applies",
    ]


@pytest.mark.parametrize(
    ("written", "texts"),
    [
        ("1", {}),
        ("1.5", {}),
        ("true", {}),
        ("1.50", {1.5: "1.50"}),
        ("1000.0", {1000.0: "1000.0"}),
        ("1e3", {1000.0: "1e3"}),
        ("+5", {5: "+5"}),
        ("-0", {0: "-0"}),
        ("TRUE", {True: "TRUE", False: "FALSE"}),
        ("False", {False: "False", True: "True"}),
        ("12345678901234567890", {12345678901234567890.0: "12345678901234567890"}),
        ("007", {}),
    ],
)
def test_infer_keeps_spelling_of_values(tmp_path: Path, written: str, texts: object) -> None:
    path = tmp_path / "config"
    path.write_text(f"a = {written}\n")
    config = read_config(Source.read(path), Report())
    assert config is not None
    parameters = infer([(config, config.entries)], Report())
    node = parameters.tree[0]
    assert isinstance(node, ScalarParameter)
    assert node.texts == texts


def test_infer_writes_lists_of_values(tmp_path: Path) -> None:
    file = tmp_path / "config.toml"
    file.write_text(f"gains = [1, 2.5]\nlong = {list(range(100, 140))}\nnone = []\n")
    config = read_config(file, Report())
    assert config
    parameters = infer([(config, config.entries)], Report())
    pdsl = pdsl_text("moved", parameters.tree, "config.toml")
    assert "    gains[] float;\n    long[] int;\n    none[] string;\n" in pdsl
    yaml = yaml_text("moved", parameters.tree, parameters.values[0], "config.toml")
    assert "# a list; each is a number\ngains: [1.0, 2.5]\n" in yaml
    assert "long:\n  - 100\n  - 101\n" in yaml
