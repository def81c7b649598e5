"""The Bottle format of YARP: values, binary and text form, and the values of IDSL."""
