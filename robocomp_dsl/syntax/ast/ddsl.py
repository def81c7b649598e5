"""The tree of a DDSL file: components, their hosts, settings and connections."""

from __future__ import annotations

from robocomp_dsl.syntax.ast.base import (
    Duration,
    Import,
    Literal,
    LiteralList,
    Name,
    Node,
    Number,
    QualifiedName,
    Text,
)


class Host(Node):
    """`host robot { address "10.0.0.2"; user robot; labels arm, gpu; port 7450; };`."""

    name: Name
    address: Text | None = None
    user: Name | Text | None = None
    labels: tuple[Name, ...] = ()
    port: Number | None = None
    doc: str = ""


class Setting(Node):
    """`set motors[2].min = -1.5;`; `key.text` is the dotted key without spaces."""

    key: Name
    value: Literal | LiteralList


class Environment(Node):
    """`env LOG_LEVEL = debug;`; `value` is the string that the process gets."""

    name: Name
    value: Text


class Restart(Node):
    """`restart on-failure max 5 in 60 s;`; `policy.text` is `on-failure`, `always` or `never`."""

    policy: Name
    max: Number | None = None
    window: Duration | None = None


class ReadyWhen(Node):
    """`ready when log matches "listening";`, `ready when port 8080 answers;`, `ready after 2 s;`.

    Exactly one of the three is set.
    """

    pattern: Text | None = None
    port: Number | None = None
    delay: Duration | None = None


class Memory(Node):
    """`memory 500 MB;`."""

    amount: Number
    unit: Name


class OnLabel(Node):
    """`on label gpu`: on a host that has this label."""

    label: Name


class CoreRange(Node):
    """`0` or `2-3`: CPU cores; without `last` it is one core."""

    first: Number
    last: Number | None = None


class Place(Node):
    """`place by load on robot, desk;` or `place by load on label gpu;`.

    Without `hosts` and `label` all hosts of the deployment are candidates.
    """

    hosts: tuple[Name, ...] = ()
    label: Name | None = None


class Device(Node):
    """`device arm : control_board { set part = LArm; };`."""

    name: Name
    kind: Name
    settings: tuple[Setting, ...] = ()
    doc: str = ""


class Attach(Node):
    """`attach zeroing to arm, leg;`."""

    device: Name
    to: tuple[Name, ...]


class Action(Node):
    """`on startup level 5 calibrate arm by zeroing;`; `by` is optional."""

    phase: Name
    level: Number
    verb: Name
    device: Name
    by: Name | None = None


class OwnPort(Node):
    """`port Laser over ice at "tcp -p 10001";`: the middleware and address of a port."""

    port: Name
    over: Name
    address: Text | None = None


class Instance(Node):
    """`component reflex : reflex on robot { … };`.

    `component` is None if it has the name of the instance; `from_` is the file of `from`. At most
    one of `host`, `label` (of `on label gpu`) and `place` is valid; without any it runs on this
    machine. `is_program`: written as `program`, without component. If a setting is
    repeated, the first one is stored (the second was reported).
    """

    name: Name
    component: Name | None = None
    host: Name | None = None
    config: Text | None = None
    context: Text | None = None
    from_: Text | None = None
    prefix: Name | Text | None = None
    settings: tuple[Setting, ...] = ()
    devices: tuple[Device, ...] = ()
    attachments: tuple[Attach, ...] = ()
    actions: tuple[Action, ...] = ()
    environment: tuple[Environment, ...] = ()
    executable: Text | None = None
    port: Number | None = None
    after: tuple[Name, ...] = ()
    restart: Restart | None = None
    ready: Duration | None = None
    ready_when: ReadyWhen | None = None
    memory: Memory | None = None
    cpu: Number | None = None
    watchdog: Duration | None = None
    middleware: Name | None = None
    own_ports: tuple[OwnPort, ...] = ()
    doc: str = ""
    is_program: bool = False
    label: Name | None = None
    place: Place | None = None
    cores: tuple[CoreRange, ...] = ()
    realtime: Number | None = None
    files: tuple[Text, ...] = ()


class PortRef(Node):
    """`body.SkinFrame`: a port of an instance or of a group."""

    instance: Name
    port: Name


class Qos(Node):
    """`best_effort; keep last 1; deadline 40 ms; priority high;`; unset values are None.

    `reliability.text` is `reliable` or `best_effort`; `depth` is also that of `keep last N`.
    """

    reliability: Name | None = None
    priority: Name | None = None
    depth: Number | None = None
    keep_all: Name | None = None
    latched: Name | None = None
    deadline: Duration | None = None
    liveliness: Duration | None = None
    thread_priority: Number | None = None


class Argument(Node):
    """`max = 3;`: an argument of a monitor."""

    name: Name
    value: Literal


class Monitor(Node):
    """`monitor "limits.py" Limit { max = 3; } at receiver on failure close;`.

    `class_name` is a class in the file; `at.text` is `sender` or `receiver`, `on_failure.text` is
    `bypass` or `close`.
    """

    file: Text
    class_name: Name
    arguments: tuple[Argument, ...] = ()
    at: Name | None = None
    on_failure: Name | None = None


class Connection(Node):
    """`connect reflex.Skin -> body.Skin over local { … };`; `qos` is None without braces."""

    source: PortRef
    target: PortRef
    over: Name | None = None
    qos: Qos | None = None
    monitors: tuple[Monitor, ...] = ()


class Condition(Node):
    """`seen && !(stop || fault)`; `events` are the names in it, and the text is that of `span`."""

    events: tuple[Name, ...]


class Candidate(Node):
    """`from face.Target when seen;`: one connection into a port that is arbitrated."""

    source: PortRef
    condition: Condition


class Arbitration(Node):
    """`arbitrate gaze.Target { from face.Target when seen; … };`."""

    target: PortRef
    candidates: tuple[Candidate, ...]


class External(Node):
    """`extern laser over ice at "laser:tcp -h 10.0.0.2 -p 10001" implements Laser;`.

    `role.text` is as written: `implements`, `requires`, `publishes` or `subscribesTo`.
    """

    name: Name
    over: Name
    address: Text | None
    role: Name
    interface: QualifiedName
    doc: str = ""


class ExternalConnection(Node):
    """`connect yarp "/camera:o" -> "/view:i" carrier fast_tcp;`: between two external programs."""

    middleware: Name
    source: Text
    target: Text
    carrier: Name | Text | None = None


class Export(Node):
    """`export JointMotor from motor;`: a port of an instance becomes a port of the group.

    `export JointMotor from motor as Left;` gives it another name outside.
    """

    port: Name
    target: PortRef


class Group(Node):
    """`group arm on robot { … };`: several components that appear as one from outside.

    They run on one host, given by `host`, `label` or `place`, unless they name a host themselves,
    and start after those in `after`. A group of a `File` is a definition. `group left : arm { … };`
    is an instance of the `definition` `arm`. The keys of `settings` start with a member:
    `set motor.speed = 3;`. `inprocess` is the keyword; `restart`, `ready`, `memory`, `cpu`, `cores`
    and `realtime` are of the one process.
    """

    name: Name
    host: Name | None = None
    after: tuple[Name, ...] = ()
    instances: tuple[Instance, ...] = ()
    connections: tuple[Connection, ...] = ()
    exports: tuple[Export, ...] = ()
    groups: tuple[Group, ...] = ()
    arbitrations: tuple[Arbitration, ...] = ()
    doc: str = ""
    definition: Name | None = None
    prefix: Name | Text | None = None
    settings: tuple[Setting, ...] = ()
    inprocess: Name | None = None
    restart: Restart | None = None
    ready: Duration | None = None
    memory: Memory | None = None
    cpu: Number | None = None
    cores: tuple[CoreRange, ...] = ()
    realtime: Number | None = None
    label: Name | None = None
    place: Place | None = None


class LockStep(Node):
    """`lockstep limit 5 s lost stop`; `lost.text` is `drop` or `stop`."""

    limit: Duration | None = None
    lost: Name | None = None


class Clock(Node):
    """`clock sim from body lockstep;`; `kind.text` is `wall` or `sim`."""

    kind: Name
    source: Name | None = None
    lockstep: LockStep | None = None


class Deployment(Node):
    """`Deployment name { … };`."""

    name: Name
    middleware: Name | None = None
    clock: Clock | None = None
    hosts: tuple[Host, ...] = ()
    instances: tuple[Instance, ...] = ()
    connections: tuple[Connection, ...] = ()
    groups: tuple[Group, ...] = ()
    externals: tuple[External, ...] = ()
    external_connections: tuple[ExternalConnection, ...] = ()
    arbitrations: tuple[Arbitration, ...] = ()
    doc: str = ""


class File(Node):
    """One DDSL file; `deployment` is None if the file has none; `groups` are definitions.

    `complete` is False if syntax errors were reported, so parts may be missing.
    """

    imports: tuple[Import, ...]
    deployment: Deployment | None
    complete: bool = True
    groups: tuple[Group, ...] = ()
