"""`ControlBoard.idsl` and what answers for it keep step."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.servants.joints.control_board import ControlBoardServant
from robocomp_dsl.model.types import Enum

INTERFACE = Path(__file__).parents[2] / "interfaces" / "ControlBoard.idsl"


def _module():
    report = Report()
    modules = check_idsl(INTERFACE, Workspace(environ={}), report)
    assert not report.has_errors
    return modules[0]


def test_control_board_interface_operations_have_servants():
    board = next(
        interface for interface in _module().interfaces if interface.name == "ControlBoard"
    )
    assert len(board.operations) > 35
    for operation in board.operations:
        answers = getattr(ControlBoardServant, operation.name, None)
        assert answers is not None, operation.name


def test_control_board_modes_match_interface_order():
    """The servant turns one into the other by its place."""
    enums = {
        declaration.name: declaration
        for declaration in _module().declarations
        if isinstance(declaration, Enum)
    }
    own = {"HardwareFault": "HW_FAULT", "CalibrationDone": "CALIB_DONE"}
    for name, modes in (("ControlMode", Mode), ("InteractionMode", Interaction)):
        for enumerator, mode in zip(enums[name].enumerators, modes, strict=True):
            words = "".join(f"_{c}" if c.isupper() else c for c in enumerator.name)
            assert own.get(enumerator.name, words.lstrip("_").upper()) == mode.name
