"""The runtime of components. It loads nothing of the toolchain.

Generated code imports `Component`, its specification and `main` from here, and the types from
`robocomp_dsl.runtime.types`. Users extend `Monitor`.
"""

from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.component.spec import CalledPort, ComponentSpec, ServedPort
from robocomp_dsl.runtime.connection.monitor import Monitor
from robocomp_dsl.runtime.main import main

__all__ = ["CalledPort", "Component", "ComponentSpec", "Monitor", "ServedPort", "main"]
