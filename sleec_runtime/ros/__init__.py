"""The rules in the processes of a robot: nodes that exchange messages (paper, Section 4 and Figure 1).

See docs/ros.md.
"""

from __future__ import annotations

from sleec_runtime.ros.context_manager.context_manager_node import ContextManagerNode as ContextManagerNode
from sleec_runtime.ros.in_process import Network as Network
from sleec_runtime.ros.mission_manager_node import MissionManagerNode as MissionManagerNode
from sleec_runtime.ros.monitoring.monitor_node import MonitorNode as MonitorNode
from sleec_runtime.ros.monitoring.recorder_node import RecorderNode as RecorderNode
from sleec_runtime.ros.task_manager.task_manager_node import TaskManagerNode as TaskManagerNode
from sleec_runtime.ros.transport import Topic as Topic
