"""Units of the fields of well-known ROS messages, for definitions without comments.

Sources: the comments of the official definitions (https://github.com/ros2/common_interfaces,
https://github.com/ros2/rcl_interfaces) and REP 103 (SI units; https://www.ros.org/reps/rep-0103.html).
The unit of a field with a struct applies to all numbers in it. Left out: fields whose unit depends
on the device (the position of a joint is rad or m), and covariances, which mix units.
"""

from __future__ import annotations

from collections.abc import Mapping

ROS_UNITS: Mapping[str, Mapping[str, str]] = {
    "builtin_interfaces/msg/Duration": {"sec": "s", "nanosec": "ns"},
    "builtin_interfaces/msg/Time": {"sec": "s", "nanosec": "ns"},
    "geometry_msgs/msg/Accel": {"linear": "m/s^2", "angular": "rad/s^2"},
    "geometry_msgs/msg/Inertia": {
        "m": "kg",
        "com": "m",
        **dict.fromkeys(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), "kg m^2"),
    },
    "geometry_msgs/msg/Point": {"x": "m", "y": "m", "z": "m"},
    "geometry_msgs/msg/Point32": {"x": "m", "y": "m", "z": "m"},
    "geometry_msgs/msg/Pose2D": {"x": "m", "y": "m", "theta": "rad"},
    "geometry_msgs/msg/Transform": {"translation": "m"},
    "geometry_msgs/msg/Twist": {"linear": "m/s", "angular": "rad/s"},
    "geometry_msgs/msg/Wrench": {"force": "N", "torque": "Nm"},
    "nav_msgs/msg/GridCells": {"cell_width": "m", "cell_height": "m"},
    "nav_msgs/msg/MapMetaData": {"resolution": "m"},
    "sensor_msgs/msg/BatteryState": {
        "voltage": "V",
        "temperature": "degC",
        "current": "A",
        "charge": "Ah",
        "capacity": "Ah",
        "design_capacity": "Ah",
        "cell_voltage": "V",
        "cell_temperature": "degC",
    },
    "sensor_msgs/msg/CameraInfo": {"height": "px", "width": "px"},
    "sensor_msgs/msg/FluidPressure": {"fluid_pressure": "Pa", "variance": "Pa^2"},
    "sensor_msgs/msg/Illuminance": {"illuminance": "lx", "variance": "lx^2"},
    "sensor_msgs/msg/Image": {"height": "px", "width": "px", "step": "bytes"},
    "sensor_msgs/msg/Imu": {
        "angular_velocity": "rad/s",
        "angular_velocity_covariance": "rad^2/s^2",
        "linear_acceleration": "m/s^2",
        "linear_acceleration_covariance": "m^2/s^4",
        "orientation_covariance": "rad^2",
    },
    "sensor_msgs/msg/LaserScan": {
        "angle_min": "rad",
        "angle_max": "rad",
        "angle_increment": "rad",
        "time_increment": "s",
        "scan_time": "s",
        "range_min": "m",
        "range_max": "m",
        "ranges": "m",
    },
    "sensor_msgs/msg/MagneticField": {"magnetic_field": "T", "magnetic_field_covariance": "T^2"},
    "sensor_msgs/msg/MultiEchoLaserScan": {
        "angle_min": "rad",
        "angle_max": "rad",
        "angle_increment": "rad",
        "time_increment": "s",
        "scan_time": "s",
        "range_min": "m",
        "range_max": "m",
        "ranges": "m",
    },
    "sensor_msgs/msg/NavSatFix": {
        "latitude": "deg",
        "longitude": "deg",
        "altitude": "m",
        "position_covariance": "m^2",
    },
    "sensor_msgs/msg/PointCloud2": {"point_step": "bytes", "row_step": "bytes"},
    "sensor_msgs/msg/PointField": {"offset": "bytes"},
    "sensor_msgs/msg/Range": {
        "field_of_view": "rad",
        "min_range": "m",
        "max_range": "m",
        "range": "m",
        "variance": "m^2",
    },
    "sensor_msgs/msg/RegionOfInterest": dict.fromkeys(
        ("x_offset", "y_offset", "height", "width"), "px"
    ),
    "sensor_msgs/msg/Temperature": {"temperature": "degC", "variance": "degC^2"},
}
"""Name of a ROS message to the units of its fields."""
