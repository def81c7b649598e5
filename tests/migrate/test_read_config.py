"""Reading of old configurations: text and TOML, and the settings of Ice in them."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.config import read_config
from robocomp_dsl.migrate.ice import split_ice_settings
from robocomp_dsl.source import Source


@pytest.mark.parametrize(
    ("text", "line"),
    [("a = \n", 1), ("a = 1\n\na = 2\n", 3), ("x = 1\n[[", 2), ("a" * 10, 1)],
)
def test_read_config_reports_broken_toml_with_line(text: str, line: int) -> None:
    report = Report()
    assert read_config(Source(Path("config.toml"), text), report) is None
    (finding,) = report
    assert (finding.code.id, finding.span.start_position[0]) == ("RC921", line)


def test_split_ice_settings_of_text_and_toml() -> None:
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
    settings, rest = split_ice_settings(config, report)
    ends = [(a.name, a.host, a.port) for a in settings.endpoints]
    assert ends == [("CommonBehavior", "", 10000), ("Laser", "robot", 10003)]
    calls = [(a.name, a.identity, a.host, a.port) for a in settings.proxies]
    assert calls == [("JointMotor0", "jointmotor", "10.0.30.11", 20000)]
    assert [entry.key for entry in rest] == ["CameraProxy"]


PYTHONIC = """noSafe=True
text = "x = True" # = False
[a]
b = False  # off
c = 'True'
"""


def test_read_config_accepts_python_booleans_in_toml() -> None:
    report = Report()
    config = read_config(Source(Path("config.toml"), PYTHONIC), report)
    assert config is not None
    values = {entry.key: entry.value for entry in config.entries}
    assert values == {"noSafe": True, "text": "x = True", "a.b": False, "a.c": "True"}
    findings = [(d.code.id, d.span.start_position, d.span.text) for d in report.sorted()]
    assert findings == [("RC939", (1, 8), "True"), ("RC939", (4, 5), "False")]


COMMENTED = """[a]
# ══════════════
# ── Early exit ──
early = true  # not this
far = 0.15  # in m
steps = 5     # warm-up
               # of random_config frames
               # ─────
next = 1

# alone

odd = "a # b"  # is 'it'
even = 'c # d'
list = [1, 2]  # random_config
"""


def test_read_config_reads_toml_comments() -> None:
    config = read_config(Source(Path("config.toml"), COMMENTED), Report())
    assert config is not None
    assert {entry.key: entry.doc for entry in config.entries} == {
        "a.early": "Early exit",
        "a.far": "in m",
        "a.steps": "warm-up\nof random_config frames",
        "a.next": "",
        "a.odd": "is 'it'",
        "a.even": "",
        "a.list": "random_config",
    }
