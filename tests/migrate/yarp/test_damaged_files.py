"""Damaged files of YARP end in findings and valid deployments, never in an exception."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from tests.migrate.yarp.conftest import MigratedFiles
from tests.migrate.yarp.robot_files import ARM

Migrate = Callable[..., MigratedFiles]
APPLICATION = """\
<?xml version="1.0"?>
<application>
  <name>Demo</name> <var name="v">x</var> <description>a ${v}</description>
  <module><name>yarpview</name><parameters>--name /view "a b</parameters><node>${v}</node>
    <prefix>/left</prefix><environment>A=1;B</environment><ensure><wait>2</wait></ensure>
    <dependencies><port timeout="5.0">/cam</port></dependencies></module>
  <application><name>Demo</name><prefix>/p</prefix></application>
  <connection id="1"><from external="true">/a</from><to>/b</to><protocol>tcp</protocol></connection>
</application>
"""
PIECES = ("<", ">", "</", '"', "&", "<!--", "<![CDATA[", "${", "é", "(", "-1", "1e999", "")


def damaged(text: str, randomness: random.Random) -> str:
    """`text` with a few pieces removed, repeated or replaced, but the start of the root."""
    start = text.index("name")
    for _ in range(randomness.randint(1, 4)):
        a = randomness.randint(start, len(text))
        b = min(len(text), a + randomness.randint(0, 30))
        piece = randomness.choice((*PIECES, text[a:b] * 2))
        text = text[:a] + piece + text[b:]
    return text


@pytest.mark.parametrize("seed", range(40))
def test_damaged_application_becomes_a_valid_deployment(migrate: Migrate, seed: int) -> None:
    migrate({"demo.xml": damaged(APPLICATION, random.Random(seed))})


@pytest.mark.parametrize("seed", range(40))
def test_damaged_robot_is_migrated_without_exception(migrate: Migrate, seed: int) -> None:
    randomness = random.Random(seed)
    files = dict(ARM)
    for name in randomness.sample(sorted(files), 3):
        files[name] = damaged(files[name], randomness)
    migrate({"arm.xml": files.pop("arm.xml"), **files})
