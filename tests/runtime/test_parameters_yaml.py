"""Configuration files in YAML: values, errors and limits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.runtime.parameters import ConfigError
from tests.runtime.arm_parameters import RequiredParams, error_lines, load

VALUES = [
    # text, attribute, value
    ("", "rate", 50.0),
    ("# only a comment\n", "device", "/dev/ttyUSB0"),
    ("---\nrate: 7\n", "rate", 7.0),
    ("rate: 1e2", "rate", 100.0),
    ("rate: 1_0.5", "rate", 10.5),
    ("rate: 0x10", "rate", 16.0),
    ("retries: 0x1F", "retries", 31),
    ("retries: 1_000", "retries", 1000),
    ("retries: 9007199254740993", "retries", 9007199254740993),
    ("mode: off", "mode", "off"),
    ("mode: 'velocity'", "mode", "velocity"),
    ("device: no", "device", "no"),
    ("device: 12:30:00", "device", "12:30:00"),
    ("device: 2024-01-01", "device", "2024-01-01"),
    ('device: "5"', "device", "5"),
    ("device: !!str 5", "device", "5"),
    ("device: |\n  two\n  lines\n", "device", "two\nlines\n"),
    ("device: ''", "device", ""),
    ("verbose: yes", "verbose", True),
    ("verbose: True", "verbose", True),
    ("verbose: off", "verbose", False),
    ("lambda: 2", "lambda_", 2.0),
    ("\ufeffrate: 2", "rate", 2.0),
    ("rate: 2\r\nmode: off\r\n", "mode", "off"),
    ("device: größe", "device", "größe"),
]


@pytest.mark.parametrize(("text", "attribute", "value"), VALUES)
def test_parameters_load_reads_yaml_values(
    tmp_path: Path, text: str, attribute: str, value: object
) -> None:
    found = getattr(load(tmp_path, text), attribute)
    assert found == value
    assert type(found) is type(value)


WRONG = [
    # text, error_lines (line:column message)
    ("rte: 5", ["1:1 unknown parameter `rte`"]),
    ("rate: fast", ["1:7 `rate` must be a number, not `fast`"]),
    ("rate: true", ["1:7 `rate` must be a number, not `true`"]),
    ('rate: "5"', ["1:7 `rate` must be a number, not a quoted string"]),
    ("rate: [5]", ["1:7 `rate` must be a number, not a list"]),
    ("rate: {a: 5}", ["1:7 `rate` must be a number, not a group"]),
    ("rate: .nan", ["1:7 `rate` is `.nan`, it must be a finite number"]),
    ("rate: -.INF", ["1:7 `rate` is `-.INF`, it must be a finite number"]),
    ("rate: 1e999", ["1:7 `rate` is inf, it must be a finite number"]),
    ("rate: 0", ["1:7 `rate` is 0 Hz, its lowest value is 1 Hz"]),
    ("rate: 1000.5", ["1:7 `rate` is 1000.5 Hz, its highest value is 1000 Hz"]),
    ("rate: 010", ["1:7 `rate` is `010`: YAML readers disagree on numbers that begin with 0"]),
    ("rate:", ["1:6 `rate` has no value"]),
    ("rate: ~", ["1:7 `rate` has no value"]),
    ("retries: 5.0", ["1:10 `retries` must be a whole number, not `5.0`"]),
    ("retries: -1", ["1:10 `retries` is -1, its lowest value is 0"]),
    ("device: 5", ["1:9 `device` must be a string, not the number 5"]),
    ("device: true", ["1:9 `device` must be a string, not the bool true"]),
    ("mode: speed", ["1:7 `mode` cannot be `speed`"]),
    ("verbose: 1", ["1:10 `verbose` must be true or false, not `1`"]),
    ("rate: 5\nmode: off\nrate: 6", ["3:1 `rate` is a duplicate key"]),
    ("- 1\n- 2", ["1:1 a configuration is a group of `key: value` lines"]),
    ("just words", ["1:1 a configuration is a group of `key: value` lines"]),
    ("rate: 5\n---\nrate: 6",
     ["2:1 a configuration is one YAML document; a second one starts here"]),
    ("device: !!python/name:os.system x",
     ["1:9 the tag `!!python/name:os.system` has no meaning here"]),
    ("rate: *b", ["1:7 the alias `*b` stands before the end of its anchor `&b`, or has none",
                  "1:7 `rate` has no value"]),
    ("rate: [5", ["2:1 this is not YAML"]),
    ("rate: 5\n\tmode: off", ["2:1 this is not YAML"]),
    ("rate: \x07", ["1:7 this is not YAML"]),
    ("motors: {name: a}", ["1:9 `motors` must be a list, not a group"]),
    ("motors: [5]", ["1:10 `motors[0]` must be a group of `key: value` lines, not a single value"]),
    ("motors: [{}]", ["1:10 `motors[0].name` is not given and has no default"]),
    ("motors: [{name: a, limits: {lo: 1}}]", ["1:29 `motors[0].limits` has no parameter `lo`"]),
    ("motors: [{name: a, id: 128}]", ["1:24 `motors[0].id` is 128, its highest value is 127"]),
    ("motors: [{name: a},{name: b},{name: c},{name: d}]",
     ["1:9 `motors` has 4 entries, it must have 0 to 3"]),
    ("? [a]\n: 5", ["1:3 a key must be a single word"]),
    ("rte: 5\nmode: speed\nmotors: 7\nrate: 0", [
        "1:1 unknown parameter `rte`",
        "2:7 `mode` cannot be `speed`",
        "3:9 `motors` must be a list, not a single value",
        "4:7 `rate` is 0 Hz, its lowest value is 1 Hz",
    ]),
]  # fmt: skip


@pytest.mark.parametrize(("text", "expected"), WRONG, ids=[text[:30] for text, _ in WRONG])
def test_parameters_load_reports_yaml_errors(
    tmp_path: Path, text: str, expected: list[str]
) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, text)
    found = error_lines(caught.value)
    # the words behind "this is not YAML" are those of the YAML library in use
    assert [re.sub("(not YAML): .+", r"\1", message) for message in found] == expected


def test_config_error_shows_file_excerpt_caret_and_help(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, "mode: position\nratte: 20\nretries: 5.0\n")
    assert (
        str(caught.value)
        == f"""\
error: unknown parameter `ratte`
  --> {tmp_path}/config.yaml:2:1
   |
 2 | ratte: 20
   | ^^^^^ did you mean `rate`?

error: `retries` must be a whole number, not `5.0`
  --> {tmp_path}/config.yaml:3:10
   |
 3 | retries: 5.0
   |          ^^^ expected int
help: write 5"""
    )


def test_parameters_load_reports_all_missing_values_at_once(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as caught:
        RequiredParams.load(None)
    assert error_lines(caught.value) == [
        "1:1 `serial` is not given and has no default",
        "1:1 `motors` is not given, it must have 1 to 2",
    ]


def unusable(tmp_path: Path) -> list[tuple[Path, str]]:
    binary, latin, huge = (tmp_path / name for name in ("b.yaml", "l.yaml", "h.yaml"))
    binary.write_bytes(b"rate: \0\0")
    latin.write_bytes("device: größe".encode("latin-1"))
    huge.write_bytes(b"# " + b"x" * 2_000_000)
    return [
        (tmp_path / "none.yaml", "file not found"),
        (tmp_path, "this is a folder, not a file"),
        (binary, "this is a binary file, not text"),
        (latin, "the text is not UTF-8: byte 0xf6 at offset 10"),
        (huge, "it is larger than 1024 kB"),
    ]


def test_parameters_load_reports_unreadable_file(tmp_path: Path) -> None:
    for path, reason in unusable(tmp_path):
        with pytest.raises(ConfigError) as caught:
            RequiredParams.load(path)
        assert error_lines(caught.value) == [f"1:1 unreadable configuration: {reason}"]
        assert str(path) in str(caught.value)


def test_parameters_load_bounds_hostile_yaml(tmp_path: Path) -> None:
    bomb = "a0: &a0 [x, x]\n" + "".join(
        f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 12)
    )
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, bomb)
    assert len(caught.value.findings) == 12
    group = "{name: a, limits: {low: 1}}"
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, f"motors: [{', '.join(['&a ' + group] + ['*a'] * 100_000)}]")
    assert error_lines(caught.value)[-1].endswith("the configuration has too many entries")
    for deep in ("[" * 100_000, "{a: " * 100_000, "- " * 100_000):
        with pytest.raises(ConfigError, match="nested too deeply"):
            load(tmp_path, deep)
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, "\n".join(f"k{i}: 1" for i in range(5000)))
    assert error_lines(caught.value)[-1].endswith("too many errors, the rest is not shown")
    assert len(caught.value.findings) == 101


def test_parameters_load_reads_yaml_merge_keys(tmp_path: Path) -> None:
    params = load(tmp_path, "motors:\n - &m {name: a, id: 5}\n - {<<: *m, name: b}\n")
    assert [(m.name, m.id) for m in params.motors] == [("a", 5), ("b", 5)]


def test_parameters_load_reports_number_beyond_float_range(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="finite"):
        load(tmp_path, "rate: 0x" + "f" * 300)
