"""The command line of a group in one process."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.runtime.group_process.arguments import parse_arguments

COMMAND = "--name left/arm --log-format json --component /c/motor --name motor --prefix left"


def test_group_arguments_have_those_of_each_component() -> None:
    words = f"{COMMAND} --component /c/eye --after left/motor --name eye --set a=b".split()
    group = parse_arguments(words)
    assert (group.name, group.log_format) == ("left/arm", "json")
    motor, eye = group.members
    assert (motor.folder, motor.name, motor.after) == (Path("/c/motor"), "left/motor", ())
    assert eye.arguments == ("--name", "eye", "--set", "a=b")
    assert eye.after == ("left/motor",)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--name arm", "a group has components: --component FOLDER"),
        ("--component /c/motor", "the following arguments are required: --name"),
        (f"{COMMAND} --component", "write the folder of the component"),
        (f"{COMMAND} --component --name x", "write the folder of the component"),
        (f"{COMMAND} --component /c/a --name motor --prefix left", "two components called"),
        (f"{COMMAND} --component /c/a --after nobody", "a waits for nobody, which is not in"),
        ("--name arm --no-such-option --component /c/motor", "unrecognized arguments"),
    ],
)
def test_group_arguments_report_what_is_wrong(
    words: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as exit_:
        parse_arguments(words.split())
    assert exit_.value.code == 2
    assert message in capsys.readouterr().err
