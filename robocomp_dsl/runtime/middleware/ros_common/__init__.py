"""What the three ROS 2 middlewares share: names, types, type hashes, and the receive queue."""
