"""ROS 1 without ROS: the XML-RPC interfaces of master and node, TCPROS, and its message types."""
