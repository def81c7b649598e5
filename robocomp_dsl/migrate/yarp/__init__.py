"""Applications of yarpmanager and descriptions of yarprobotinterface become deployments."""
