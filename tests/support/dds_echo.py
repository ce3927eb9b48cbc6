"""A process that sends each message on the topic of its argument back, with `echo: ` before it.

It publishes `ready` on a latched topic when it starts. On `fork` it says what a forked process sees, and on `end` it
ends without closing the transport.
"""

from __future__ import annotations

import os
import sys
from queue import SimpleQueue
from typing import Any

from sleec_runtime.ros.dds.transport import DdsPublisher, DdsTransport
from sleec_runtime.ros.transport import Topic
from sleec_runtime.ros.transport_errors import TransportUnavailable


def main(name: str) -> None:
    transport = DdsTransport()
    received: SimpleQueue[Any] = SimpleQueue()
    answers = transport.publisher(Topic(f"{name}/answers", latched=True, depth=100))
    transport.subscribe(Topic(name, depth=100), received.put)
    answers.publish({"data": "ready"})
    while (text := received.get()["data"]) != "end":
        answers.publish({"data": f"forked: {forked(answers)}" if text == "fork" else f"echo: {text}"})


def forked(answers: DdsPublisher) -> str:
    """What a forked process gets that publishes, and how it ends."""
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        try:
            answers.publish({"data": "from the forked process"})
        except TransportUnavailable as error:
            os.write(writing, error.message.encode())
        sys.exit(3)
    os.close(writing)
    with open(reading, encoding="utf-8") as pipe:
        message = pipe.read()
    return f"{message}, exit {os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])}"


if __name__ == "__main__":
    main(sys.argv[1])
