"""Which names ROS allows, as the descriptions of the middlewares state it."""

import re

VALID_NAMES = r"/?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*"
"""Names of components and ports of which a ROS name can be made."""

MAX_LENGTH = 240
"""Characters of a name: DDS allows 256, with the prefix and suffix that ROS adds."""


def address_problem(address: str) -> str:
    """What is wrong with the name of a topic or service; empty if nothing is."""
    if not re.fullmatch(VALID_NAMES, address):
        return (
            f"`{address}` is not a valid ROS name: parts of letters, digits and `_`, not"
            " starting with a digit, separated by `/`, as in `/base/scan`"
        )
    if len(address) > MAX_LENGTH:
        return (
            f"the ROS name `{address[:40]}…` has {len(address)} characters,"
            f" at most {MAX_LENGTH} are allowed"
        )
    return ""
