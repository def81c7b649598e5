"""State machines of components: what generated code describes, run by python-statemachine.

In: a `MachineSpec`, the worker's methods, a clock. Out: a `Machine`, which the worker drives with
`self.machine.go("event")`.
"""

from robocomp_dsl.runtime.machine.machine import Machine, UnknownEvent
from robocomp_dsl.runtime.machine.spec import MachineSpec, StateSpec, TransitionSpec

__all__ = ["Machine", "MachineSpec", "StateSpec", "TransitionSpec", "UnknownEvent"]
