"""The face of the runtime: the class `Sleec`, which chooses a dispatcher for its rules."""
