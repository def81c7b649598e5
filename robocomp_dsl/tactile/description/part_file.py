"""Load the part of a description that a component's parameters name.

In: a file name, a part name, and the configuration that contains them. Out: the `GenericPart`, or
`ConfigError` with all findings.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.regular_file import read_text
from robocomp_dsl.runtime.config.data_file import data_file
from robocomp_dsl.runtime.parameters import ConfigError, ConfigFinding, ConfigLocation
from robocomp_dsl.runtime.parameters.findings import ConfigText, did_you_mean
from robocomp_dsl.tactile.description.model import GENERIC_ARM, GenericPart, RobotDescription
from robocomp_dsl.tactile.description.part_xml import read_part_xml
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.errors import DescriptionError


def load_arm_part(description: str, part: str, config: Path | None) -> GenericPart:
    """The arm `part` of the file `description`, which `data_file` searches for.

    Raises `ConfigError`.
    """
    file = data_file(description, "description", config)
    source = _read_source(file)
    text = ConfigText(str(file), tuple(source.splitlines()))
    try:
        robot = _parse_robot(source, file)
    except DescriptionError as error:
        raise ConfigError(_config_findings(error, text)) from None
    found = next((candidate for candidate in robot.parts if candidate.name == part), None)
    if found is None:
        raise ConfigError([_unknown_part(part, robot, text)])
    if len(found.servos) != len(GENERIC_ARM):
        message = f"`{part}` is not an arm: it has {len(found.servos)} servos"
        raise ConfigError(
            [_part_finding(found, text, message, f"an arm has {', '.join(GENERIC_ARM)}")]
        )
    return found


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
        place = ConfigLocation(ConfigText(str(file), ()), 1, 1)
        raise ConfigError(
            [ConfigFinding(place, f"the description cannot be read: {why}")]
        ) from None


def _config_findings(error: DescriptionError, text: ConfigText) -> list[ConfigFinding]:
    return [
        ConfigFinding(
            ConfigLocation(text, finding.line, finding.column), finding.message, help=finding.help
        )
        for finding in error.findings
    ]


def _unknown_part(part: str, robot: RobotDescription, text: ConfigText) -> ConfigFinding:
    names = [known.name for known in robot.parts]
    message = f"the description has no part `{part}`; it has {', '.join(names) or 'none'}"
    if not robot.parts:
        return ConfigFinding(ConfigLocation(text, 1, 1), message)
    return _part_finding(robot.parts[0], text, message, "set the parameter `part`", part, names)


def _part_finding(
    part: GenericPart,
    text: ConfigText,
    message: str,
    help: str,
    word: str = "",
    names: list[str] | None = None,
) -> ConfigFinding:
    place = ConfigLocation(text, part.place.line, part.place.column)
    return ConfigFinding(place, message, did_you_mean(word, names or []), help)
