"""RC53x: the clock of a deployment."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

CLOCK = Code(
    "RC530",
    Severity.ERROR,
    "a clock is not one",
    """\
All components of a deployment live by one clock: that of their machine, or simulated time, which
one of them makes. In lock-step they act one at a time, in the same order in every run; a component
that needs more than the limit for a step is lost, and the others go on (`drop`) or all stop.

Wrong:

    clock ros;
    clock wall from body;

Right, each of them:

    clock wall;
    clock sim;
    clock sim from body lockstep limit 5 s lost stop;
""",
)

CLOCK_SOURCE = Code(
    "RC531",
    Severity.ERROR,
    "it is not clear which component makes the time",
    """\
Simulated time is made by the component that publishes `Clock` (of Clock.idsl). There is exactly one
in a deployment, or `from` says which of them it is.

Wrong, where no component of the deployment publishes `Clock`:

    Deployment demo { clock sim; component wander; };

Right, where `mobile_base` publishes it:

    Deployment demo { clock sim from base; component base : mobile_base; component wander; };
""",
)

CLOCK_SOURCE_PERIOD = Code(
    "RC532",
    Severity.ERROR,
    "the component that makes the time has no period",
    """\
Simulated time goes on by one period of its source at a time, so the source has one. It is the
resolution of the time of all components: choose it so that their periods are multiples of it.

Wrong, in the CDSL file of the source:

    period 0;

Right:

    period 10;
""",
)
