"""The operations of an interface that extends another one, as services of Thrift do.

In: the resolved base and the own operations. Out: all operations, those of the base first. An
operation that both declare is reported, and that of the base counts.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.interface import Interface, Operation


def with_inherited(
    base: Interface, own: tuple[Operation, ...], report: Report
) -> tuple[Operation, ...]:
    """Copies of the operations of `base`, then those of `own` that it does not have.

    Each operation belongs to one interface: generated names depend on both.
    """
    inherited = {operation.name: operation for operation in base.operations}
    for operation in own:
        earlier = inherited.get(operation.name)
        if earlier:
            report.add(
                codes.DUPLICATE_NAME,
                operation.span,
                f"the extended `{base.qualified}` has an operation `{operation.name}` too",
                notes=[Note(earlier.span, "it is declared here")],
                help="give one of them another name",
            )
    copies = (operation.replace() for operation in base.operations)
    return (*copies, *(o for o in own if o.name not in inherited))
