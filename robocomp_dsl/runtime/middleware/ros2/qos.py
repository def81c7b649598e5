"""The quality of service of a port as a profile of rclpy."""

from __future__ import annotations

from typing import Any

from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from robocomp_dsl.runtime.connection.endpoint import Qos

DEFAULT_DEPTH = 10
"""As `rmw_qos_profile_default`."""


def publisher_profile(qos: Qos) -> Any:
    """The profile that a publisher offers; reliable unless the user says otherwise."""
    profile = subscription_profile(qos)
    if qos.deadline:
        profile.deadline = Duration(nanoseconds=round(qos.deadline * 1e9))
    return profile


def subscription_profile(qos: Qos) -> Any:
    """The profile that a subscription requests.

    It requests no deadline: DDS would refuse publishers that offer none. Missed deadlines are
    counted for every middleware by the component.
    """
    return QoSProfile(
        reliability=(
            ReliabilityPolicy.BEST_EFFORT if qos.reliable is False else ReliabilityPolicy.RELIABLE
        ),
        durability=(DurabilityPolicy.TRANSIENT_LOCAL if qos.latched else DurabilityPolicy.VOLATILE),
        history=HistoryPolicy.KEEP_ALL if qos.keep_all else HistoryPolicy.KEEP_LAST,
        depth=qos.depth or DEFAULT_DEPTH,
    )
