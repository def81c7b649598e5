"""TCP connections, as the middlewares `ros1` and `yarp` use them."""
