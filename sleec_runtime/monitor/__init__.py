"""The online monitor: it compares what a dispatch executes with what is due."""
