"""Converts the configurations of yarp-bottle-generator to bridges."""
