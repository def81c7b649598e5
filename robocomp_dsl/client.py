"""Programs that look into a running deployment, with or without generated code.

    from robocomp_dsl.client import DomainClient, struct_to_plain

    with DomainClient("my-domain") as client:
        base = client.describe("base")
        laser = base.port("Laser")
        data = client.operations(laser.interface, "base", "Laser").getLaserData()

`describe` asks a component for its schema and builds the classes and the codec that generated code
would have. `to_plain`, `struct_to_plain` and `result_to_plain` make dicts and lists of values.
"""

from robocomp_dsl.runtime.client import DomainClient, load_generated_interfaces
from robocomp_dsl.runtime.dynamic.build import build_interfaces, build_types
from robocomp_dsl.runtime.dynamic.describe import describe_interfaces
from robocomp_dsl.runtime.dynamic.description import ComponentDescription, DescribedPort
from robocomp_dsl.runtime.dynamic.plain import result_to_plain, struct_to_plain, to_plain
from robocomp_dsl.runtime.errors import SchemaError

__all__ = [
    "ComponentDescription",
    "DescribedPort",
    "DomainClient",
    "SchemaError",
    "build_interfaces",
    "build_types",
    "describe_interfaces",
    "load_generated_interfaces",
    "result_to_plain",
    "struct_to_plain",
    "to_plain",
]
