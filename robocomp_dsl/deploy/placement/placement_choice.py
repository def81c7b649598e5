"""What placement chose, and why. Data only."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.deploy.placement.host_load import HostLoad
from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.model.deployment import Deployment


@dataclass(frozen=True, slots=True)
class CandidateScore:
    """A candidate and its components so far; load and score are set if the load decides."""

    host: str
    components: int
    load: HostLoad | None = None
    score: float | None = None
    chosen: bool = False


@dataclass(frozen=True, slots=True)
class PlacementChoice:
    """The host of components that are placed together, and why: `reason` is a text."""

    instances: tuple[str, ...]
    host: str
    reason: str
    candidates: tuple[CandidateScore, ...] = ()


@dataclass(frozen=True, slots=True)
class PlacementResult:
    """`deployment` has a host for each instance, unless `findings` say why one has none."""

    deployment: Deployment
    choices: tuple[PlacementChoice, ...]
    findings: tuple[Diagnostic, ...]
