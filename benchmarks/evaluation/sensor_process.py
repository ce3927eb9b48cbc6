"""A sensor that changes the context all the time: `python -m benchmarks.evaluation.sensor_process RATE DOMAIN…`.

The input is a line with a list of situations, of which one after the other is reported, RATE times each second, in each
DDS domain. The process ends when its input ends.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from itertools import cycle

from benchmarks.evaluation.variants.topics import CONDITIONS
from sleec_runtime.ros.dds.transport import DdsTransport


def main() -> None:
    rate, *domains = sys.argv[1:]
    transports = [DdsTransport(int(domain)) for domain in domains]
    publishers = [transport.publisher(CONDITIONS) for transport in transports]
    reports = [json.dumps(conditions) for conditions in json.loads(sys.stdin.readline())]
    ended = threading.Event()

    def await_end() -> None:
        sys.stdin.read()
        ended.set()

    threading.Thread(target=await_end, daemon=True).start()
    following = time.monotonic()
    for report in cycle(reports):
        for publisher in publishers:
            publisher.publish({"data": report})
        following += 1 / float(rate)
        if ended.wait(max(0.0, following - time.monotonic())):
            break
    for transport in transports:
        transport.close()


if __name__ == "__main__":
    main()
