"""``python -m sleec_runtime.ros``: starts one node as a process."""

from __future__ import annotations

import sys

from sleec_runtime.ros.command_line import main

if __name__ == "__main__":
    sys.exit(main())
