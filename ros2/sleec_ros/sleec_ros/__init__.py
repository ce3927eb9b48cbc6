"""Nodes of sleec-runtime as programs of ROS 2."""
