"""When a component is restarted, and after which delay."""

from __future__ import annotations

import pytest

from robocomp_dsl.deploy.supervisor.restart import decide_restart
from robocomp_dsl.model.deployment import Restart


@pytest.mark.parametrize(
    ("policy", "failed", "restarts", "wait"),
    [
        (Restart("never"), True, [], None),
        (Restart("on-failure"), False, [], None),
        (Restart("on-failure"), True, [], 0.1),
        (Restart("always"), False, [], 0.1),
        (Restart("on-failure", max=5), True, [99.0], 0.2),
        (Restart("on-failure", max=5), True, [90.0, 99.0], 0.4),
        (Restart("on-failure", max=90), True, [99.0] * 20, 10.0),
        (Restart("on-failure", max=2, window_s=60), True, [50.0, 99.0], None),
        (Restart("on-failure", max=2, window_s=60), True, [40.0, 99.0], 0.2),
        (Restart("on-failure", max=2000), True, [99.0] * 1999, 10.0),
    ],
)
def test_decide_restart_applies_policy_and_backoff(
    policy: Restart, failed: bool, restarts: list[float], wait: float | None
) -> None:
    assert decide_restart(policy, restarts, 100.0, failed=failed).delay_s == wait
