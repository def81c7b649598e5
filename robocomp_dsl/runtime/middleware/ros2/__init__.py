"""ros2: ROS 2 nodes through `rclpy`, with any middleware of ROS."""
