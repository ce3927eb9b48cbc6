"""DDS through cyclonedds, with the topic names, types and QoS that ROS 2 uses on the wire. Needs the extra `dds`."""
