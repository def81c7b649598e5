"""Converts a configuration of yarp-bottle-generator to a bridge in BDSL.

In: a file. Out: a `ConvertedBridge`, and findings at positions in the file. A mux becomes a hub
that uses each message once, as the original does: a command is never sent twice.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.bdsl_lines import BdslLines, ConvertedBridge
from robocomp_dsl.migrate.bottle_generator.configuration import BottleConfiguration
from robocomp_dsl.migrate.bottle_generator.message_types import MessageTypes
from robocomp_dsl.migrate.bottle_generator.names import identifier
from robocomp_dsl.migrate.bottle_generator.read_configuration import read_configuration
from robocomp_dsl.migrate.bottle_generator.to_ros import RosOutput
from robocomp_dsl.migrate.bottle_generator.to_yarp import YarpOutput
from robocomp_dsl.source import Source, UnreadableSource


def convert_file(
    path: Path,
    workspace: Workspace,
    report: Report,
    types: Mapping[str, str] | None = None,
    lookup: Callable[[str], str] | None = None,
) -> ConvertedBridge | None:
    """The bridge of the configuration at `path`; None if the report contains errors.

    `types` are the types of ROS topics, `package/Type`, by topic. `lookup` asks for the type of
    another topic; it returns "" if it is not known.
    """
    try:
        source = workspace.sources.read(path)
    except UnreadableSource as error:
        report.add(codes.INVALID_LINE, Source(path, "").file_span, f"cannot read `{path}`: {error}")
        return None
    configuration = read_configuration(source, report)
    if configuration is None:
        return None
    messages = MessageTypes(workspace, path, report)
    name = identifier(path.stem)
    findings = Report()
    writer = (
        RosOutput(configuration, messages, types or {}, findings)
        if configuration.to_ros
        else YarpOutput(configuration, messages, types or {}, lookup, findings)
    )
    body = writer.lines()
    report.extend(findings)
    if body is None or report.has_errors:
        return None
    lines = _file(name, configuration, writer.imports, body)
    return ConvertedBridge(name, lines.text, tuple(lines.origins), source.file_span)


def _file(
    name: str, configuration: BottleConfiguration, imports: list[str], body: BdslLines
) -> BdslLines:
    """The whole file around the inputs, hubs and the output."""
    lines = BdslLines()
    for definition in imports:
        lines.add(f'import "{definition}";')
    if imports:
        lines.add("")
    ends = ("YARP", "ROS") if configuration.to_ros else ("ROS", "YARP")
    lines.add(f"/** From {ends[0]} to {ends[1]}: {configuration.output.text}. */")
    lines.add(f"Bridge {name}", configuration.output.span)
    lines.add("{")
    lines.lines += [f"    {line}" if line else "" for line in body.lines]
    lines.origins += body.origins
    lines.add("};")
    return lines
