"""speech: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from speech_generated.genericworker import GenericWorker
from speech_generated.interfaces import DatasayReq, DatasayResp


class SpecificWorker(GenericWorker):
    """Says what it is told, and what is in front of it.

    A second paragraph.
    """

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 20 ms."""
        # For example (the types are in speech_generated.interfaces; a call without
        # a reply raises NoServer or Timeout of robocomp_dsl.runtime.types):
        # result = self.range_proxy.getScan()
        # result = self.front_proxy.getScan()
        # self.speechevents_proxy.spoken(DatasayReq())

    # implements RoboCompSpeech::Speech

    def Speech_say(self, req: DatasayReq) -> tuple[int, DatasayResp]:
        """Say a sentence; the answer tells how many wait.

        Returns the result, resp.
        May raise NoVoice.
        """
        # Put your code here. Until then callers receive an error.
        return super().Speech_say(req)

    def Speech_isBusy(self) -> bool:
        """Whether something is being said."""
        # Put your code here. Until then callers receive an error.
        return super().Speech_isBusy()

    def Speech_stop(self) -> None:
        """Be quiet."""
