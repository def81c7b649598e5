"""What a running component needs; nothing of the toolchain is loaded here.

Generated code imports `Component`, its specification and `main` from here, and the types from
`robocomp_dsl.runtime.types`.
"""

from robocomp_dsl.runtime.component import Component
from robocomp_dsl.runtime.main import main
from robocomp_dsl.runtime.spec import CalledPort, ComponentSpec, ServedPort

__all__ = ["CalledPort", "Component", "ComponentSpec", "ServedPort", "main"]
