"""rmw_zenoh: ROS 2 nodes that use `rmw_zenoh_cpp`, without an installed ROS."""
