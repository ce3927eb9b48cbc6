"""One process of the fuzzer: ``python -m tests.fuzz.fuzzer TARGET …``, with the options and folders of libFuzzer.

Code is instrumented when it is imported, and many modules are imported where they are used. So the seeds and the corpus
run first: that imports everything that the target uses.
"""

from __future__ import annotations

import sys
from hashlib import sha256
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import atheris

from tests.fuzz.splicing import Splicer

INSTRUMENTED = ["sleec_runtime", "sleec_verify"]

with atheris.instrument_imports(include=INSTRUMENTED):
    from tests.fuzz.targets import TARGETS, corpus, run


def main(name: str, options: list[str]) -> None:
    target = TARGETS[name]
    inputs = [*target.seeds(), *(path.read_bytes() for path in corpus(name))]
    splicer = Splicer(inputs, target.words)

    def mutate(data: bytes, max_size: int, seed: int) -> bytes:
        random = Random(seed)
        return splicer.splice(data, random)[:max_size] if random.randrange(2) else atheris.Mutate(data, max_size)

    with TemporaryDirectory() as folder:
        here = Path(folder)
        files, seeds, words = (here / part for part in ("files", "seeds", "words"))
        files.mkdir()
        seeds.mkdir()
        with atheris.instrument_imports(include=INSTRUMENTED):
            for data in inputs:
                (seeds / sha256(data).hexdigest()).write_bytes(data)
                run(target, data, files)
        options = [f"-max_len={target.max_bytes}", *options, str(seeds)]
        if target.words:
            words.write_text("".join(f'"{escaped(word)}"\n' for word in target.words))
            options.append(f"-dict={words}")
        # To merge, libFuzzer starts itself again, by a shell.
        program = f"{sys.executable} -m tests.fuzz.fuzzer {name}"
        atheris.Setup([program, *options], lambda data: run(target, data, files), custom_mutator=mutate)
        atheris.Fuzz()


def escaped(word: str) -> str:
    return "".join(chr(c) if 32 <= c < 127 and chr(c) not in '"\\' else f"\\x{c:02x}" for c in word.encode())


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
