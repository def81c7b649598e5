"""The DDS domains of this process, with the configuration that interoperates with other DDS.

Cyclone DDS compares the type descriptions that participants send, and rejects those of Fast DDS,
the default of ROS 2: their sequences are described in a way that it considers invalid
(eclipse-cyclonedds/cyclonedds, pull request 2333). Types of Fast DDS are compared by name instead.
"""

from __future__ import annotations

import os
import threading
from typing import Any

from cyclonedds.core import DDSException
from cyclonedds.domain import Domain

_FAST_DDS = "1.15"
"""The vendor id of eProsima, in the numbering of the RTPS standard."""
_CONFIGURATION = (
    "<CycloneDDS><Domain><Compatibility>"
    f"<IgnoreTypeInformation>{_FAST_DDS}</IgnoreTypeInformation>"
    "</Compatibility></Domain></CycloneDDS>"
)
_open: dict[int, tuple[Any, int]] = {}
_lock = threading.Lock()


def enter_domain(domain_id: int) -> None:
    """Configure a domain before its first participant. Raises `DDSException`.

    The configuration of the user, CYCLONEDDS_URI, is kept.
    """
    with _lock:
        domain, users = _open.get(domain_id, (None, 0))
        if users == 0:
            user_configuration = os.environ.get("CYCLONEDDS_URI", "")
            parts = [part for part in (user_configuration, _CONFIGURATION) if part]
            try:
                domain = Domain(domain_id, ",".join(parts))
            except DDSException as error:
                # The program itself has opened the domain, with its own configuration.
                if error.code != DDSException.DDS_RETCODE_PRECONDITION_NOT_MET:
                    raise
        _open[domain_id] = domain, users + 1


def leave_domain(domain_id: int) -> None:
    """Undo an `enter_domain`; the last call closes the domain."""
    with _lock:
        domain, users = _open.pop(domain_id)
        if users > 1:
            _open[domain_id] = domain, users - 1
