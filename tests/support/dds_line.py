"""A process that connects its input and output with DDS: one direction for each of its two topics.

It publishes each line of its input on the first topic, and writes each message on the second, which is latched. It
writes `found` and `lost` when the other side joins and leaves the first topic.
"""

from __future__ import annotations

import sys
import threading
import time

from sleec_runtime.ros.dds.transport import DdsPublisher, DdsTransport
from sleec_runtime.ros.transport import Topic


def main(outgoing: str, incoming: str) -> None:
    transport = DdsTransport()
    publisher = transport.publisher(Topic(outgoing, latched=True, depth=1))
    transport.subscribe(Topic(incoming, latched=True, depth=1), lambda fields: write(fields["data"]))
    threading.Thread(target=watch, args=(publisher,), daemon=True).start()
    for line in sys.stdin:
        publisher.publish({"data": line.rstrip("\n")})
    transport.close()


def write(text: object) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def watch(publisher: DdsPublisher) -> None:
    known = 0
    while True:
        count = publisher.subscription_count()
        if bool(count) != bool(known):
            write("found" if count else "lost")
        known = count
        time.sleep(0.02)


if __name__ == "__main__":
    main(*sys.argv[1:])
