"""The application of Qt, of which each worker has one.

In: the stop request of the component. Out: `quit` and the signal `aboutToQuit`.
"""

from __future__ import annotations

from collections.abc import Callable

from robocomp_dsl.runtime.robocomp.event_loop import EventLoop
from robocomp_dsl.runtime.robocomp.signals import BoundSignal


class WorkerApplication:
    """`QApplication.instance()`. `aboutToQuit` is emitted when the component finalizes."""

    def __init__(self, loop: EventLoop, request_stop: Callable[[], None]) -> None:
        self.aboutToQuit = BoundSignal(loop)
        self._request_stop = request_stop

    def quit(self) -> None:
        """Stop the component."""
        self._request_stop()

    exit = quit  # noqa: A003 - Qt's name

    def processEvents(self) -> None:
        """Call the slots that are due."""
        EventLoop.current().run_due()


class QApplication:
    """The class of the application: its methods are those of the current worker's."""

    @staticmethod
    def instance() -> WorkerApplication:
        """The application of the worker that runs."""
        application = EventLoop.current().application
        if not isinstance(application, WorkerApplication):
            raise TypeError("there is no application before the component initializes")
        return application

    @staticmethod
    def quit() -> None:
        """Stop the component."""
        QApplication.instance().quit()

    exit = quit  # noqa: A003 - Qt's name

    @staticmethod
    def processEvents() -> None:
        """Call the slots that are due."""
        QApplication.instance().processEvents()


class CurrentApplication:
    """`qApp`: the application of the worker that runs."""

    def __getattr__(self, name: str) -> object:
        return getattr(QApplication.instance(), name)


qApp = CurrentApplication()  # noqa: N816 - Qt's name
