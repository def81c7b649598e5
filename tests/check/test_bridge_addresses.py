"""Addresses in bridges: what each middleware allows."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.middleware.ice import addresses as ice
from robocomp_dsl.runtime.middleware.registry import BUILT_IN, description_of
from robocomp_dsl.runtime.middleware.ros_common import valid_names as ros
from robocomp_dsl.runtime.middleware.yarp import valid_addresses as yarp


@pytest.mark.parametrize("address", ["scan", "/base/scan", "/a_1/B2", "/" + "a" * 239])
def test_valid_ros_address(address: str) -> None:
    assert ros.address_problem(address) == ""


@pytest.mark.parametrize("address", ["", "/", "/1a", "/a b", "a//b", "/a/", "a-b", "a" * 241])
def test_invalid_ros_address(address: str) -> None:
    assert ros.address_problem(address)


@pytest.mark.parametrize(
    "address", ["/robot/laser:o", "fast_tcp:/robot/laser:o", "/laser:o@10.0.0.2:10005", "//a"]
)
def test_valid_yarp_address(address: str) -> None:
    assert yarp.address_problem(address) == ""


@pytest.mark.parametrize(
    "address", ["", "/", "laser", "/a b", "udp:/laser", "/laser@10.0.0.2:99999", "/laser@10.0.0.2"]
)
def test_invalid_yarp_address(address: str) -> None:
    assert yarp.address_problem(address)


@pytest.mark.parametrize(
    "address",
    [
        *("laser:tcp -h 10.0.0.2 -p 10001", "tcp -p 10001", "laser", "laser@Adapter"),
        *("robot/laser -t -e 1.1:tcp -p 10001", "icestorm:LaserPub", "laser:ws -p 1:tcp -p 2"),
    ],
)
def test_valid_ice_address(address: str) -> None:
    assert ice.address_problem(address) == ""


@pytest.mark.parametrize(
    "address", ["", "icestorm:", "a b", "laser:xyz -p 1", "tcp -p 70000", "/a/b", "laser:10001"]
)
def test_invalid_ice_address(address: str) -> None:
    assert ice.address_problem(address)


def test_middlewares_with_external_peers_check_addresses() -> None:
    descriptions = [description_of(name) for name in BUILT_IN]
    unchecked = [
        description.name
        for description in descriptions
        if description
        and description.capabilities.external_peers
        and not description.address_problem
    ]
    assert unchecked == []
