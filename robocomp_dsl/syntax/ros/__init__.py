"""ROS definitions: `.msg`, `.srv` and `.action` files."""
