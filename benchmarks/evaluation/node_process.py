"""A process of a variant: `python -m benchmarks.evaluation.node_process VARIANT RULES DOMAIN NODE…` over DDS.

Prints `ready` when its nodes have started, and ends when its input ends.
"""

from __future__ import annotations

import gc
import sys
from pathlib import Path

from benchmarks.evaluation.variants.systems import nodes
from sleec_runtime.ros.dds.transport import DdsTransport


def main() -> None:
    variant, rules, domain, *names = sys.argv[1:]
    transport = DdsTransport(int(domain))
    start = nodes(variant, Path(rules))
    started = [start[name](transport) for name in names]
    # What was created until now stays, so the collector need not visit it.
    gc.freeze()
    print("ready", flush=True)
    sys.stdin.read()
    transport.close()
    del started


if __name__ == "__main__":
    main()
