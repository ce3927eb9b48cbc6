"""The environment variables of ROS 2 and cyclonedds for discovery."""

from __future__ import annotations

import os

from sleec_runtime.ros.transport_errors import TransportUnavailable
from sleec_runtime.support.messages import represent

HIGHEST_DOMAIN = 232
"""The highest DDS domain whose ports exist (DDS-RTPS 2.5, Section 9.6.2.3)."""

LOOPBACK = """<CycloneDDS><Domain>
  <General><Interfaces><NetworkInterface address="127.0.0.1" multicast="false"/></Interfaces></General>
  <Discovery>
    <ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>
    <Peers><Peer address="127.0.0.1"/></Peers>
  </Discovery>
</Domain></CycloneDDS>"""
"""The value of CYCLONEDDS_URI for processes of one computer that has no multicast."""


def domain_of_environment() -> int:
    """The DDS domain: ROS_DOMAIN_ID, or 0 without it. Raises TransportUnavailable."""
    text = os.environ.get("ROS_DOMAIN_ID", "").strip() or "0"
    if text.isascii() and text.isdigit() and len(text) < 9 and int(text) <= HIGHEST_DOMAIN:
        return int(text)
    raise TransportUnavailable(
        f"ROS_DOMAIN_ID is {represent(text)}, which is not a DDS domain", f"set a number from 0 to {HIGHEST_DOMAIN}"
    )


def refuse_unsecured_start() -> None:
    """Raises TransportUnavailable if the environment demands SROS 2, which only rclpy has."""
    if (os.environ.get("ROS_SECURITY_ENABLE"), os.environ.get("ROS_SECURITY_STRATEGY")) == ("true", "Enforce"):
        raise TransportUnavailable(
            "ROS_SECURITY_STRATEGY is Enforce, and the DDS transport does not read the keystore of SROS 2",
            "use RclpyTransport, or configure DDS Security in CYCLONEDDS_URI and unset ROS_SECURITY_ENABLE",
        )


def distribution_of_environment() -> str:
    """The ROS distribution whose message definitions are used: ROS_DISTRO, by default jazzy."""
    return os.environ.get("ROS_DISTRO", "").strip() or "jazzy"
