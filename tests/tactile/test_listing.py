"""Descriptions in the form of the published XML listing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.tactile.description.part_xml import read_part_xml
from robocomp_dsl.tactile.errors import DescriptionError, Fault

PRINTED = """\
<Generic_Robot_Part>head</Generic_Robot_Part>
  <generic_servo_number>2</generic_servo_number>
  <generic_servo id="1">
    <destination_servo_id>2</destination_servo_id>
    <transform_factor>1.00</transform_factor>
    <transform_displacement>0.00</transform_displacement>
    <stiffness>1.00</stiffness>
    <damping>0.00</damping>
    <speed>20.00</speed>
  </generic_servo>
  .....
<initial_positions>
  <servo type="deg" destination_servo_id="0" pos="-2.00"/>
  <servo type="deg" destination_servo_id="2" pos="15.00"/>
</initial_postions>
"""


def test_listing_is_read_with_printed_misspelling():
    part = read_part_xml(PRINTED, Path("l.xml"), ("neck_pitch", "neck_roll", "neck_yaw"))
    assert part.name == "head"
    assert part.joints == ("neck_yaw",)
    assert part.mapping.available.tolist() == [False, True]
    servo = part.servos[1]
    assert (servo.gamma, servo.sigma, servo.speed, servo.start) == (1, 0, 20, 15)
    assert servo.unit == "deg"
    assert [(position.joint, position.position) for position in part.fixed_joints] == [
        ("neck_pitch", np.deg2rad(-2))
    ]


def test_listing_reads_root_limits_and_destination_part():
    text = f"<?xml version='1.0'?><robot>{PRINTED}</robot>".replace(
        "<speed>", '<limits min="-55" max="55"/><destination_part>neck</destination_part><speed>'
    )
    part = read_part_xml(text, Path("l.xml"))
    assert part.joints == ("neck/2",)
    assert (part.servos[1].low, part.servos[1].high) == (-55, 55)


def test_listing_accepts_quotes_of_xml():
    part, other = (
        read_part_xml(servo, Path("l.xml")) for servo in (PRINTED, PRINTED.replace('"', "'"))
    )
    assert other.servos == part.servos


def test_listing_reports_duplicate_servo():
    start, end = PRINTED.index("<generic_servo "), PRINTED.index("</generic_servo>")
    again = PRINTED[start:end].replace('id="1"', 'id="0"') + "</generic_servo>"
    with pytest.raises(DescriptionError) as caught:
        read_part_xml(PRINTED[:start] + again + PRINTED[start:], Path("l.xml"))
    (error,) = caught.value.findings
    assert (error.message, error.kind) == (
        "the destination servo `2` is used twice",
        Fault.TWICE,
    )


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("</generic_servo>", "", "l.xml:3:3: <generic_servo> is never closed"),
        ('id="1"', 'id="2"', "l.xml:3:3: the ids of the generic servos must be 0 to 1"),
        ('id="1"', "", "l.xml:3:3: <generic_servo> has no attribute `id`"),
        ('pos="15.00"', "", "<servo> has no attribute `pos`"),
        (">1.00</transform_factor", ">0</transform_factor", "factor of 0 cannot be inverted"),
        (">20.00<", ">fast<", "l.xml:9:5: `fast` in <speed> is not a number"),
        (">2</generic_servo_number", ">0</generic_servo_number", "must be the number"),
        ("Generic_Robot_Part", "Part", "there is no <Generic_Robot_Part>"),
        ('type="deg"', 'type="turns"', "`turns` is not a unit"),
        ("</initial_postions>", "", "<initial_positions> is never closed"),
        (">2</destination", ">-2</destination", "no destination servo -2"),
        ("<speed>", '<limits min="2" max="1"/><speed>', "lower limit 2 is above"),
    ],
)
def test_listing_reports_faults(old, new, expected):
    with pytest.raises(DescriptionError) as caught:
        read_part_xml(PRINTED.replace(old, new), Path("l.xml"))
    assert expected in str(caught.value)


def test_deep_listing_is_read_without_recursion_error():
    with pytest.raises(DescriptionError):
        read_part_xml("<a>" * 50_000, Path("l.xml"))
