"""One part of a description, as the parameters of a component name it.

In: the name of a file, that of a part, the configuration that they come from. Out: the `Part`, or
`ConfigError` with every fault at its place in the file.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.runtime.config.data_file import data_file
from robocomp_dsl.runtime.parameters import ConfigError, Finding, Place
from robocomp_dsl.runtime.parameters.findings import Text, did_you_mean
from robocomp_dsl.tactile.description.listing import read_listing
from robocomp_dsl.tactile.description.model import GENERIC_ARM, Part, Robot
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.errors import DescriptionError


def arm_part(description: str, part: str, config: Path | None) -> Part:
    """The arm `part` of the file `description`; see `data_file` for where that is looked for.

    Raises `ConfigError`.
    """
    file = data_file(description, "description", config)
    source = _source(file)
    text = Text(str(file), tuple(source.splitlines()))
    try:
        robot = _robot(source, file)
    except DescriptionError as error:
        raise ConfigError(_shown(error, text)) from None
    found = next((one for one in robot.parts if one.name == part), None)
    if found is None:
        raise ConfigError([_no_part(part, robot, text)])
    if len(found.servos) != len(GENERIC_ARM):
        said = f"`{part}` is no arm: it has {len(found.servos)} servos"
        raise ConfigError([_at(found, text, said, f"an arm has {', '.join(GENERIC_ARM)}")])
    return found


def _robot(source: str, file: Path) -> Robot:
    """The robot of a file in YAML, or the one part of a listing in XML."""
    if not source.lstrip().startswith("<"):
        return read_robot(source, file)
    part = read_listing(source, file)
    return Robot(part.name, (part,), file)


def _source(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "it is no text in UTF-8"
        place = Place(Text(str(file), ()), 1, 1)
        raise ConfigError([Finding(place, f"the description cannot be read: {why}")]) from None


def _shown(error: DescriptionError, text: Text) -> list[Finding]:
    return [
        Finding(Place(text, one.line, one.column), one.message, help=one.help)
        for one in error.findings
    ]


def _no_part(part: str, robot: Robot, text: Text) -> Finding:
    names = [one.name for one in robot.parts]
    said = f"the description has no part `{part}`; it has {', '.join(names) or 'none'}"
    if not robot.parts:
        return Finding(Place(text, 1, 1), said)
    return _at(robot.parts[0], text, said, "the parameter `part` says which one", part, names)


def _at(
    part: Part, text: Text, said: str, help: str, word: str = "", names: list[str] | None = None
) -> Finding:
    place = Place(text, part.place.line, part.place.column)
    return Finding(place, said, did_you_mean(word, names or []), help)
