"""Which names ROS allows, as the descriptions of the middlewares state it; no imports."""

VALID_NAMES = r"/?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*"
"""Names of components and ports of which a ROS name can be made."""
