"""Which wheels the Python of a host can install."""

from __future__ import annotations

import platform
import sys
import sysconfig

import pytest
from packaging.markers import default_environment
from packaging.tags import sys_tags

from robocomp_dsl.deploy.content.wheel_target import WheelTarget

ROBOT = WheelTarget("/usr/bin/python3", (3, 12), "aarch64", (2, 31))


def own_target() -> WheelTarget:
    """The Python that runs the test."""
    libc = platform.libc_ver()[1].split(".")
    return WheelTarget(
        sys.executable, sys.version_info[:2], platform.machine(), (int(libc[0]), int(libc[1]))
    )


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="compares with packaging on glibc")
def test_wheel_target_has_the_tags_of_packaging() -> None:
    machine = sysconfig.get_platform().replace("-", "_")
    expected = {str(tag) for tag in sys_tags()}
    built_here = {tag for tag in expected if tag.endswith(machine)}  # of no other machine
    assert own_target().tags() == expected - built_here


def test_wheel_target_has_the_markers_of_packaging() -> None:
    own, expected = own_target().marker_environment(), default_environment()
    ignored = {"implementation_version", "platform_release", "platform_version"}
    ignored |= {"python_full_version", "extra"}
    assert own.keys() - {"extra"} == expected.keys()
    assert {k: own[k] for k in own if k not in ignored} == {
        k: v for k, v in expected.items() if k not in ignored
    }


@pytest.mark.parametrize(
    ("tag", "fits"),
    [
        ("cp312-cp312-manylinux_2_17_aarch64", True),
        ("cp312-cp312-manylinux2014_aarch64", True),
        ("cp39-abi3-manylinux_2_31_aarch64", True),
        ("py3-none-any", True),
        ("cp312-cp312-manylinux_2_34_aarch64", False),
        ("cp312-cp312-manylinux1_aarch64", False),
        ("cp311-cp311-manylinux_2_17_aarch64", False),
        ("cp313-abi3-manylinux_2_17_aarch64", False),
        ("cp312-cp312-manylinux_2_17_x86_64", False),
        ("cp312-cp312-musllinux_1_2_aarch64", False),
        ("cp312-cp312-linux_aarch64", False),
    ],
)
def test_wheel_target_of_another_machine(tag: str, *, fits: bool) -> None:
    assert (tag in ROBOT.tags()) == fits


def test_wheel_target_with_musl() -> None:
    alpine = WheelTarget("/usr/bin/python3", (3, 12), "x86_64", None)
    assert "cp312-cp312-musllinux_1_2_x86_64" in alpine.tags()
    assert not [tag for tag in alpine.tags() if "manylinux" in tag]
    assert (alpine.platform, ROBOT.platform) == ("x86_64-musl", "aarch64-glibc")
