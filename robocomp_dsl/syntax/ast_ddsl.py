"""The tree of a DDSL file: which components run where, with what, wired how."""

from __future__ import annotations

from robocomp_dsl.syntax.ast_base import Duration, Import, Literal, Name, Node, Number, Text


class Host(Node):
    """`host robot { address "10.0.0.2"; user robot; labels arm, gpu; };`."""

    name: Name
    address: Text | None = None
    user: Name | Text | None = None
    labels: tuple[Name, ...] = ()
    doc: str = ""


class Setting(Node):
    """`set motors[2].min = -1.5;`; `key.text` is the dotted key without spaces."""

    key: Name
    value: Literal


class Environment(Node):
    """`env LOG_LEVEL = debug;`; `value` as the process gets it."""

    name: Name
    value: Text


class Restart(Node):
    """`restart on-failure max 5 in 60 s;`; `policy.text` is `on-failure`, `always` or `never`."""

    policy: Name
    max: Number | None = None
    window: Duration | None = None


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
    """`on startup level 5 calibrate arm by zeroing;`; `by` is None where nobody is named."""

    phase: Name
    level: Number
    verb: Name
    device: Name
    by: Name | None = None


class Instance(Node):
    """`component reflex : reflex on robot { … };`.

    `component` is None where it has the instance's own name; `host` None: this machine; `from_`
    is the file of `from`. Of a setting written twice the first is kept (the second was reported).
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
    doc: str = ""


class PortRef(Node):
    """`body.SkinFrame`: a port of an instance or of a group."""

    instance: Name
    port: Name


class Qos(Node):
    """`{ best_effort; depth 1; deadline 40 ms; priority high; }`; None where nothing was written.

    `reliability.text` is `reliable` or `best_effort`.
    """

    reliability: Name | None = None
    priority: Name | None = None
    depth: Number | None = None
    deadline: Duration | None = None


class Connection(Node):
    """`connect reflex.Skin -> body.Skin { … };`; `qos` is None without braces."""

    source: PortRef
    target: PortRef
    qos: Qos | None = None


class Export(Node):
    """`export JointMotor from motor;`: port of the group that is a port of an instance inside.

    `export JointMotor from motor as Left;` gives it another name outside.
    """

    port: Name
    target: PortRef


class Group(Node):
    """`group arm on robot { … };`: several components that appear as one outside.

    All of them are on `host`, unless they say it themselves, and start after what `after` names.
    """

    name: Name
    host: Name | None = None
    after: tuple[Name, ...] = ()
    instances: tuple[Instance, ...] = ()
    connections: tuple[Connection, ...] = ()
    exports: tuple[Export, ...] = ()
    groups: tuple[Group, ...] = ()
    doc: str = ""


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
    doc: str = ""


class File(Node):
    """One DDSL file; `deployment` is None when there is none to be seen.

    `complete` is False when form errors were reported, so that something may be missing here.
    """

    imports: tuple[Import, ...]
    deployment: Deployment | None
    complete: bool = True
