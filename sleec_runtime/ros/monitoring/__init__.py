"""The nodes that observe a robot: the monitor and the recorder."""
