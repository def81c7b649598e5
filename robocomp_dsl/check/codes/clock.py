"""RC53x: the clock of a deployment."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

INVALID_CLOCK = Code(
    "RC530",
    Severity.ERROR,
    "invalid clock",
    """\
All components of a deployment use one clock: the wall clock, or simulated time from one of the
components, the clock source. In lock-step the components run one at a time, in the same order in
every run. A component that exceeds the step limit times out: the others continue (`drop`), or the
deployment stops (`stop`).

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
    "no unique clock source",
    """\
The clock source is the component that publishes `Clock` (of Clock.idsl). If several components
publish it, name the clock source after `from`.

Wrong, where no component of the deployment publishes `Clock`:

    Deployment demo { clock sim; component wander; };

Right, where `mobile_base` publishes it:

    Deployment demo { clock sim from base; component base : mobile_base; component wander; };
""",
)

CLOCK_SOURCE_PERIOD = Code(
    "RC532",
    Severity.ERROR,
    "the clock source has no period",
    """\
Simulated time advances by the period of the clock source, so the source needs a period. It is the
time resolution of all components: choose it so that their periods are multiples of it.

Wrong, in the CDSL file of the source:

    period 0;

Right:

    period 10;
""",
)
