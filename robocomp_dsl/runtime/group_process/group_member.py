"""Runs one component of a group in one process, in a thread of its own.

In: its folder and arguments. Out: it is loaded, ready, ended; whether it failed.
"""

from __future__ import annotations

import logging
import os
import threading
from collections.abc import Callable

from robocomp_dsl.extras import MissingExtra
from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.supervision import Supervision
from robocomp_dsl.runtime.component.thread_context import create_context, own_folder
from robocomp_dsl.runtime.component.user_errors import describe_error, log_failure
from robocomp_dsl.runtime.entry_point import create_runner
from robocomp_dsl.runtime.group_process.arguments import MemberArguments
from robocomp_dsl.runtime.group_process.component_modules import ComponentModules

WORKER_CLASS = "SpecificWorker"
log = logging.getLogger("robocomp")


class GroupMember:
    """One component. `loaded`: it waits for `start`, or has failed; `ready`: it computes."""

    def __init__(self, arguments: MemberArguments, on_ended: Callable[[GroupMember], None]) -> None:
        self.name = arguments.name
        self.after = arguments.after
        self.loaded = threading.Event()
        self.ready = threading.Event()
        self.ended = threading.Event()
        self.failed = False
        self.abandoned = False
        self.has_own_folder = True
        self._arguments = arguments
        self._on_ended = on_ended
        self._wake = threading.Condition()
        self._may_start = self._is_stopping = False
        self._runner: Runner | None = None

    def load(self, supervision: Supervision) -> None:
        """Load the component in its thread; returns when it is `loaded`."""
        target = lambda: self._run(supervision)  # noqa: E731 - the thread has one argument
        threading.Thread(target=target, name=f"{self.name}.main", daemon=True).start()
        self.loaded.wait()

    def start(self) -> None:
        """Let it start."""
        with self._wake:
            self._may_start = True
            self._wake.notify()

    def stop(self) -> None:
        """Request its end; returns at once."""
        with self._wake:
            self._is_stopping = True
            self._wake.notify()
            runner = self._runner
        if runner:
            runner.stop()

    def _run(self, supervision: Supervision) -> None:
        try:
            self.failed = not self._load_and_run(supervision)
        except BaseException as error:
            self.failed = True
            log_failure(self.name, error)
        finally:
            self.loaded.set()
            self.ended.set()
            self._on_ended(self)

    def _load_and_run(self, supervision: Supervision) -> bool:
        folder = self._arguments.folder
        try:
            context = create_context(self.name, folder)
        except OSError as error:
            log.error("the folder %s cannot be opened: %s", folder, error.strerror)  # noqa: TRY400
            return False
        self.has_own_folder = own_folder(context)
        if not self.has_own_folder:
            os.chdir(folder)  # members are loaded one after the other
        modules = ComponentModules(self.name, folder)
        context.builtins = modules.builtins
        worker = self._worker_class(modules)
        if worker is None:
            return False
        runner = create_runner(worker, self._arguments.arguments, supervision)
        if runner is None:
            return False
        with self._wake:
            self._runner = runner
            self.loaded.set()
            self._wake.wait_for(lambda: self._may_start or self._is_stopping)
            starts = not self._is_stopping
        if not starts:
            runner.ports.close()
            return True
        runner.start()
        succeeded = runner.wait()
        self.abandoned = runner.abandoned
        return succeeded

    def _worker_class(self, modules: ComponentModules) -> type[Component] | None:
        """The class that `main.py` of the component runs; None if it cannot be imported."""
        try:
            worker: type[Component] = getattr(modules.load("main"), WORKER_CLASS)
        except MissingExtra as error:
            log.error("%s", error)  # noqa: TRY400 - the message is all there is to know
        except SystemExit as error:
            log.error("%s", error.code)  # noqa: TRY400 - `main.py` says what is missing
        except AttributeError:
            log.error("main.py of %s names no class %s", self.name, WORKER_CLASS)  # noqa: TRY400
        except Exception as error:
            log.error("import failed: %s", describe_error(error))  # noqa: TRY400
        else:
            return worker
        return None
