"""YARP without YARP: ports, carriers, name server, and the IDSL interfaces on them."""
