"""Load the part of a description that a component's parameters name.

In: a file name, a part name, and the configuration that contains them. Out: the `GenericPart`, or
`ConfigError` with all findings.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.regular_file import read_text
from robocomp_dsl.runtime.config.data_file import data_file
from robocomp_dsl.runtime.parameters import ConfigError
from robocomp_dsl.runtime.parameters.errors import did_you_mean
from robocomp_dsl.tactile.description.model import GenericPart, RobotDescription
from robocomp_dsl.tactile.description.part_xml import read_part_xml
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.errors import DescriptionError


def load_arm_part(description: str, part: str, config: Path | None) -> GenericPart:
    """The part `part` of the file `description`; see `load_arm`. Raises `ConfigError`."""
    return load_arm(description, part, config)[1]


def load_arm(
    description: str, part: str, config: Path | None
) -> tuple[RobotDescription, GenericPart]:
    """The robot of the file `description`, which `data_file` searches for, and its part `part`.

    The part is an arm, or another one with any number of servos. Raises `ConfigError`.
    """
    file = data_file(description, "description", config)
    source = _read_source(file)
    text = SourceText.of_text(file, source)
    try:
        robot = _parse_robot(source, file)
    except DescriptionError as error:
        raise ConfigError(error.findings) from None
    found = next((candidate for candidate in robot.parts if candidate.name == part), None)
    if found is None:
        raise ConfigError([_unknown_part(part, robot, text)])
    if not any(servo.joint for servo in found.servos):
        message = f"`{part}` has no servo with a joint"
        raise ConfigError([_part_finding(found, message, "add one to `servos`")])
    return robot, found


def _parse_robot(source: str, file: Path) -> RobotDescription:
    """The robot in a YAML file, or the single part of an XML file."""
    if not source.lstrip().startswith("<"):
        return read_robot(source, file)
    part = read_part_xml(source, file)
    return RobotDescription(part.name, (part,), file)


def _read_source(file: Path) -> str:
    try:
        return read_text(file)
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "it is not UTF-8 text"
        place = Location(SourceText(str(file), ()), 1, 1)
        raise ConfigError([Finding(place, f"the description cannot be read: {why}")]) from None


def _unknown_part(part: str, robot: RobotDescription, text: SourceText) -> Finding:
    names = [known.name for known in robot.parts]
    message = f"the description has no part `{part}`; it has {', '.join(names) or 'none'}"
    if not robot.parts:
        return Finding(Location(text, 1, 1), message)
    return _part_finding(robot.parts[0], message, "set the parameter `part`", part, names)


def _part_finding(
    part: GenericPart,
    message: str,
    help: str,
    word: str = "",
    names: list[str] | None = None,
) -> Finding:
    return Finding(part.place, message, did_you_mean(word, names or []), help)
