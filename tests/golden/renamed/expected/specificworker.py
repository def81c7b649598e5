"""class: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from class_generated.genericworker import GenericWorker
from class_generated.interfaces import (
    GenericWorker_,
    LaserProxy,
    RoboCompA_Pose,
    RoboCompB_Pose,
    dict_,
    list_,
    request,
)


class SpecificWorker(GenericWorker):
    """The component class."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    # implements RoboCompA::Forms

    def Forms_start(self, p: RoboCompA_Pose) -> None:
        """RoboCompA::Forms: start."""

    def Forms_move(self, w: GenericWorker_) -> None:
        """RoboCompA::Forms: move."""

    def Forms_first(self, p: RoboCompA_Pose) -> int:
        """RoboCompA::Forms: first."""
        # Put your code here. Until then callers receive an error.
        return super().Forms_first(p)

    def Forms_second(self, p: RoboCompA_Pose) -> int:
        """RoboCompA::Forms: second."""
        # Put your code here. Until then callers receive an error.
        return super().Forms_second(p)

    def Forms_third(self, w: GenericWorker_) -> int:
        """RoboCompA::Forms: third."""
        # Put your code here. Until then callers receive an error.
        return super().Forms_third(w)

    def Forms_fourth(self, r: request) -> int:
        """RoboCompA::Forms: fourth."""
        # Put your code here. Until then callers receive an error.
        return super().Forms_fourth(r)

    def Forms_names(self, rt_: int, super_: int, np: int) -> None:
        """RoboCompA::Forms: names."""
        # Put your code here. Until then callers receive an error.
        super().Forms_names(rt_, super_, np)

    # implements RoboCompA::Laser

    def Laser_query(self, p: RoboCompA_Pose) -> RoboCompA_Pose:
        """RoboCompA::Laser: query.

        May raise RoboCompA_Failed.
        """
        # Put your code here. Until then callers receive an error.
        return super().Laser_query(p)

    def Laser_publish(self, p: RoboCompA_Pose, q: int) -> None:
        """RoboCompA::Laser: publish."""
        # Put your code here. Until then callers receive an error.
        super().Laser_publish(p, q)

    def Laser_command(self, p: RoboCompA_Pose) -> None:
        """RoboCompA::Laser: command."""

    def Laser_close(self) -> None:
        """RoboCompA::Laser: close."""
        # Put your code here. Until then callers receive an error.
        super().Laser_close()

    def Laser___init__(self) -> None:
        """RoboCompA::Laser: __init__."""
        # Put your code here. Until then callers receive an error.
        super().Laser___init__()

    def Laser__bind(self) -> None:
        """RoboCompA::Laser: _bind."""
        # Put your code here. Until then callers receive an error.
        super().Laser__bind()

    def Laser_list(self, self_: RoboCompA_Pose, list: list_) -> list_:
        """RoboCompA::Laser: list."""
        # Put your code here. Until then callers receive an error.
        return super().Laser_list(self_, list)

    def Laser_Pose(self, None_: int, lambda_: int, n_: int, n__: int) -> dict_:
        """RoboCompA::Laser: Pose."""
        # Put your code here. Until then callers receive an error.
        return super().Laser_Pose(None_, lambda_, n_, n__)

    def Laser_INTERFACE(self) -> LaserProxy:
        """RoboCompA::Laser: INTERFACE.

        May raise Exception_.
        """
        # Put your code here. Until then callers receive an error.
        return super().Laser_INTERFACE()

    # implements RoboCompB::Laser

    def Laser1_where(self) -> RoboCompB_Pose:
        """RoboCompB::Laser: where.

        May raise RoboCompB_Failed.
        """
        # Put your code here. Until then callers receive an error.
        return super().Laser1_where()

    # implements RoboCompB::lower

    def lower_compute(self) -> None:
        """RoboCompB::lower: compute."""
        # Put your code here. Until then callers receive an error.
        super().lower_compute()

    # subscribesTo RoboCompB::lower

    def lower1_compute(self) -> None:
        """RoboCompB::lower: compute."""
