"""The ROS 2 package, built by colcon."""

from setuptools import setup

NAME = "sleec_ros"

setup(
    name=NAME,
    version="0.1.0",
    packages=[NAME],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/launch", ["launch/sleec.launch.py"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="The sleec-verify developers",
    maintainer_email="maintainers@example.org",
    description="Nodes that apply SLEEC rules on a robot",
    license="MIT",
    entry_points={
        "console_scripts": [
            f"{program} = {NAME}.programs:{program}"
            for program in ("context_manager", "task_manager", "mission_manager", "recorder", "monitor")
        ]
    },
)
