"""dds: ROS 2 topics over DDS through `cyclonedds`, without an installed ROS."""
