"""hostile: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from hostile_generated.genericworker import GenericWorker
from hostile_generated.interfaces import A


class SpecificWorker(GenericWorker):
    """| a | table | <b>bold</b> \"\"\" {{ 7 * 7 }}
    # Heading
    ```
    """

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 100 ms."""
        # For example (the types are in hostile_generated.interfaces; a call without
        # a reply raises NoServer or Timeout of robocomp_dsl.runtime.types):
        # result = self.hostile_proxy.call(A())
        # self.topic_proxy.tell(A())

    # implements RoboCompHostile::Hostile

    def Hostile_call(self, a: A) -> A:
        """\\u0041 \\x41 \\N{DIGIT ONE} ""

        May raise X.
        """
        # Put your code here. Until then callers receive an error.
        return super().Hostile_call(a)

    # subscribesTo RoboCompHostile::HostileTopic

    def HostileTopic_tell(self, a: A) -> None:
        """' '' '''"""
