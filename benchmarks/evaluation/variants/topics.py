"""The topics that all variants share: the context, and one topic for each trigger."""

from __future__ import annotations

import re

from sleec_runtime.ros.transport import Topic

DOMAIN = Topic("/domain")
CONDITIONS = Topic("/conditions")


def trigger_topic(trigger: str) -> Topic:
    """The topic whose messages mean that `trigger` occurs: `/curtain_open_request` for `CurtainOpenRequest`."""
    return Topic("/" + re.sub(r"(?<!^)(?=[A-Z])", "_", trigger).lower(), "std_msgs/msg/Empty")
