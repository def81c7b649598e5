"""Migration of files of yarpmanager and yarprobotinterface."""
