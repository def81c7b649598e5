"""Chooses a host for each component that names none, by label or by load. Pure.

In: a deployment, the loads of its hosts, and where its components run now. Out: the deployment with
a host for each instance, the reason for each choice with its numbers, and findings.

1. Components that must run on one host (`one_host`) are placed together.
2. A running component stays where it runs, if its host is still a candidate.
3. By label: the candidate with the fewest components.
4. By load: the candidate with the lowest score (`host_load`), to which each component that does not
   run yet adds its share.

Among equals the host that is declared first is chosen. All hosts on this machine are one.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.deploy import codes
from robocomp_dsl.deploy.placement.host_load import HostLoad, local_load
from robocomp_dsl.deploy.placement.one_host import one_host_sets
from robocomp_dsl.deploy.placement.placed_deployment import with_hosts
from robocomp_dsl.deploy.placement.placement_choice import (
    CandidateScore,
    PlacementChoice,
    PlacementResult,
)
from robocomp_dsl.diagnostics import Diagnostic, Note
from robocomp_dsl.model.deployment import THIS_MACHINE, UNPLACED, Deployment, Host, Instance
from robocomp_dsl.model.placement import LOAD


def place(
    deployment: Deployment,
    loads: Mapping[str, HostLoad],
    running: Mapping[str, str],
    known: KnownMiddlewares | None = None,
) -> PlacementResult:
    """Choose the hosts. `loads`: by name of host; `running`: name of instance to name of host.

    A host without an entry in `loads` is not chosen by load; that of this machine is measured.
    """
    if is_placed(deployment):
        return PlacementResult(deployment, (), ())
    placer = _Placer(deployment, loads, running, known or KnownMiddlewares())
    placer.place()
    placed = with_hosts(deployment, placer.hosts)
    return PlacementResult(placed, tuple(placer.choices), tuple(placer.findings))


def is_placed(deployment: Deployment) -> bool:
    """Whether each instance has a host."""
    return all(instance.host is not UNPLACED for instance in deployment.instances)


def placeable_locally(deployment: Deployment) -> bool:
    """Whether all instances without a host have candidates on this machine only."""
    hosts = _hosts_by_name(deployment)
    return all(
        hosts[name].is_local
        for instance in deployment.instances
        if instance.host is UNPLACED
        for name in instance.placement.candidates
    )


def _hosts_by_name(deployment: Deployment) -> dict[str, Host]:
    known = {host.name: host for host in deployment.hosts}
    return {THIS_MACHINE: Host(THIS_MACHINE, THIS_MACHINE), **known}


class _Placer:
    """Places one deployment."""

    def __init__(
        self,
        deployment: Deployment,
        loads: Mapping[str, HostLoad],
        running: Mapping[str, str],
        known: KnownMiddlewares,
    ) -> None:
        self._deployment = deployment
        self._hosts = _hosts_by_name(deployment)
        self._order = {name: i for i, name in enumerate(self._hosts)}
        self._loads = loads
        self._running = {
            name: self._hosts[host].machine if host in self._hosts else host
            for name, host in running.items()
        }
        self._sets = one_host_sets(deployment, known)
        self._components: Counter[str] = Counter()
        self._starting: Counter[str] = Counter()
        self.hosts: dict[str, Host] = {}
        self.choices: list[PlacementChoice] = []
        self.findings: list[Diagnostic] = []

    def place(self) -> None:
        """Choose a host for each set of instances."""
        for instance in self._deployment.instances:
            if instance.host is not UNPLACED:
                self._count(instance, instance.host)
        todo = []
        for members in self._sets:
            unplaced = [instance for instance in members if instance.host is UNPLACED]
            if not unplaced:
                continue
            candidates = self._candidates(members, unplaced)
            if candidates and not self._keep_running(unplaced, candidates):
                todo.append((unplaced, candidates))
        for unplaced, candidates in sorted(todo, key=lambda each: _by_load(each[0])):
            if _by_load(unplaced):
                self._choose_by_load(unplaced, candidates)
            else:
                self._choose_by_label(unplaced, candidates)

    def _count(self, instance: Instance, host: Host) -> None:
        self._components[host.machine] += 1
        if instance.name not in self._running:
            self._starting[host.machine] += 1

    def _candidates(self, members: Sequence[Instance], unplaced: Sequence[Instance]) -> list[Host]:
        """The hosts on which all `members` can run, in order of declaration."""
        fixed = [instance for instance in members if instance.host is not UNPLACED]
        machines = {instance.host.machine for instance in fixed}
        names = set.intersection(*(set(i.placement.candidates) for i in unplaced))
        hosts = [self._hosts[name] for name in sorted(names, key=self._order.__getitem__)]
        fitting = [host for host in hosts if machines <= {host.machine}]
        if not fitting:
            self.findings.append(self._no_fitting_host(fixed, unplaced))
        return fitting

    def _keep_running(self, unplaced: Sequence[Instance], candidates: Sequence[Host]) -> bool:
        """Place instances where they run, or where most of them run; whether any of them runs."""
        where = Counter(self._running.get(instance.name) for instance in unplaced)
        running = [host for host in candidates if where[host.machine]]
        if not running:
            return False
        host = max(running, key=lambda host: where[host.machine])
        scores = [CandidateScore(h.name, self._components[h.machine]) for h in candidates]
        self._assign(unplaced, host, "runs there", scores)
        return True

    def _choose_by_label(self, unplaced: Sequence[Instance], candidates: Sequence[Host]) -> None:
        counts = [self._components[host.machine] for host in candidates]
        scores = [
            CandidateScore(host.name, count) for host, count in zip(candidates, counts, strict=True)
        ]
        host = candidates[counts.index(min(counts))]
        self._assign(unplaced, host, "fewest components", scores)

    def _choose_by_load(self, unplaced: Sequence[Instance], candidates: Sequence[Host]) -> None:
        scores = [self._score(host) for host in candidates]
        known = [score for score in scores if score.score is not None]
        if not known:
            self.findings.append(self._no_load(unplaced, candidates))
            return
        lowest = min(score.score for score in known if score.score is not None)
        chosen = next(score.host for score in known if score.score == lowest)
        self._assign(unplaced, self._hosts[chosen], "lowest score", scores)

    def _score(self, host: Host) -> CandidateScore:
        load = self._loads.get(host.name)
        if load is None and host.is_local:
            load = self._loads.get(THIS_MACHINE) or local_load()
        components = self._components[host.machine]
        if load is None:
            return CandidateScore(host.name, components)
        score = load.score + self._starting[host.machine] * load.score_of_component
        return CandidateScore(host.name, components, load, score)

    def _assign(
        self,
        instances: Sequence[Instance],
        host: Host,
        reason: str,
        scores: Sequence[CandidateScore],
    ) -> None:
        for instance in instances:
            self.hosts[instance.name] = host
            self._count(instance, host)
        marked = (
            CandidateScore(s.host, s.components, s.load, s.score, s.host == host.name)
            for s in scores
        )
        names = tuple(instance.name for instance in instances)
        self.choices.append(PlacementChoice(names, host.name, reason, tuple(marked)))

    def _no_fitting_host(
        self, fixed: Sequence[Instance], unplaced: Sequence[Instance]
    ) -> Diagnostic:
        """Names the instances that must run together, and what each of them asks for."""
        first = unplaced[0]
        demands = [f"`{i.name}` runs on `{i.host.name or THIS_MACHINE}`" for i in fixed]
        demands += [f"`{i.name}` is placed {_demand(i)}" for i in unplaced]
        labelled = [f"`{host.name}` ({_labels(host)})" for host in self._deployment.hosts]
        return Diagnostic(
            codes.NO_FITTING_HOST,
            first.host_span or first.span,
            f"no host fits `{first.name}` and the components that must run on the same host: "
            + ", ".join(dict.fromkeys(demands)),
            notes=tuple(_places([*fixed, *unplaced[1:]])),
            help=f"the hosts are {', '.join(labelled)}; a connection between hosts needs a "
            "middleware that connects hosts, such as zenoh",
        )

    def _no_load(self, unplaced: Sequence[Instance], candidates: Sequence[Host]) -> Diagnostic:
        first = unplaced[0]
        names = join_names([host.name for host in candidates])
        return Diagnostic(
            codes.NO_FITTING_HOST,
            first.host_span or first.span,
            f"the load of {names} is not known, so no host can be chosen for `{first.name}`",
            help="`rcdeploy hosts` shows which hosts answer",
        )


def _by_load(unplaced: Sequence[Instance]) -> bool:
    return any(instance.placement.kind == LOAD for instance in unplaced)


def _demand(instance: Instance) -> str:
    text = str(instance.placement)
    candidates = ", ".join(instance.placement.candidates)
    return f"{text} ({candidates})" if instance.placement.label else text


def _labels(host: Host) -> str:
    if not host.labels:
        return "no labels"
    return f"label{'s' * (len(host.labels) > 1)} {', '.join(host.labels)}"


def _places(instances: Sequence[Instance]) -> Iterator[Note]:
    for instance in instances:
        yield Note(instance.host_span or instance.span, f"`{instance.name}` is placed here")
