"""Starts the Context Manager, one task and the recorder:

ros2 launch sleec_ros sleec.launch.py rules:=rules.sleec task:=my_robot.tasks:Dressing log:=mission.jsonl
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    "rules": "the file with the rules",
    "task": "MODULE:CLASS of the task; copy its Node in this file for each further task",
    "log": "the file of the recorder, which must not exist",
}


def generate_launch_description():
    def node(executable, argument):
        arguments = [LaunchConfiguration(argument)]
        return Node(package="sleec_ros", executable=executable, arguments=arguments, output="screen")

    return LaunchDescription(
        [
            *(DeclareLaunchArgument(name, description=text) for name, text in ARGUMENTS.items()),
            node("context_manager", "rules"),
            node("task_manager", "task"),
            node("recorder", "log"),
        ]
    )
