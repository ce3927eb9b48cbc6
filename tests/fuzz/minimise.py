"""``python -m tests.fuzz.minimise [TARGET …]``: renew the corpus from what `make fuzz` found since.

Of all inputs, the fewest and shortest are kept that reach the same code as all of them, beyond what the seeds reach.
Inputs that someone named, such as those that failed once, stay.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.fuzz.__main__ import WORK
from tests.fuzz.targets import CORPUS, TARGETS, corpus
from tests.support.paths import ROOT

_UNNAMED = re.compile(r"[0-9a-f]{40}")


def minimise(name: str) -> None:
    kept, found = CORPUS / name, WORK / name
    kept.mkdir(parents=True, exist_ok=True)
    found.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as folder:
        merged = Path(folder)
        seeds = {sha256(data).hexdigest(): data for data in TARGETS[name].seeds()}
        for digest, data in seeds.items():
            (merged / digest).write_bytes(data)
        options = ["-set_cover_merge=1", "-use_counters=0", str(merged), str(kept), str(found)]
        subprocess.run([sys.executable, "-m", "tests.fuzz.fuzzer", name, *options], cwd=ROOT, check=True)
        for path in corpus(name):
            if _UNNAMED.fullmatch(path.name):
                path.unlink()
        for path in merged.iterdir():
            if path.name not in seeds:
                shutil.copy(path, kept)


if __name__ == "__main__":
    for target in sys.argv[1:] or TARGETS:
        minimise(target)
