"""State machines of components, executed by python-statemachine.

In: a `MachineSpec`, the worker's methods, a clock. Out: a `Machine`, which the worker uses with
`self.machine.send("event")`.
"""

from robocomp_dsl.runtime.machine.machine import Machine, UnknownEvent
from robocomp_dsl.runtime.machine.spec import MachineSpec, StateSpec, TransitionSpec

__all__ = ["Machine", "MachineSpec", "StateSpec", "TransitionSpec", "UnknownEvent"]
