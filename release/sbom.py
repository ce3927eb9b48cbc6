"""Write a CycloneDX SBOM for each distribution in a folder: the packages that its lock installs.

python release/sbom.py dist
"""

from __future__ import annotations

import json
import subprocess
import sys
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

ROOT = Path(__file__).parents[1]
LOCKS = {"sleec-runtime": "runtime.lock", "sleec-verify": "verify.lock"}


def sbom(name: str, lock: Path, dist: Path) -> dict[str, Any]:
    """The SBOM of an environment with the distribution `name` of the folder `dist` and everything that `lock` pins."""
    with TemporaryDirectory() as folder:
        wheels, environment = Path(folder, "wheels"), Path(folder, "environment")
        _run(
            "pip",
            "wheel",
            "--quiet",
            "--no-build-isolation",
            "--use-pep517",
            "--require-hashes",
            "-w",
            wheels,
            "-r",
            lock,
        )
        _run("venv", "--without-pip", environment)
        index = ("--no-index", "--find-links", wheels, "--find-links", dist)
        _run("pip", "--python", environment, "install", "--quiet", "--no-compile", *index, name)
        content: dict[str, Any] = json.loads(
            _run("cyclonedx_py", "environment", "--sv", "1.6", "--output-reproducible", environment)
        )
    (component,) = (one for one in content["components"] if one["name"] == name)
    content["components"].remove(component)
    content["metadata"]["component"] = component
    (wheel,) = dist.glob(f"{name.replace('-', '_')}-{component['version']}-*.whl")
    component["hashes"] = [{"alg": "SHA-256", "content": sha256(wheel.read_bytes()).hexdigest()}]
    return content


def _run(module: str, *arguments: str | Path) -> str:
    command = [sys.executable, "-m", module, *map(str, arguments)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def main(dist: Path) -> None:
    validator = JsonStrictValidator(SchemaVersion.V1_6)
    for name, lock in LOCKS.items():
        content = sbom(name, ROOT / "requirements" / lock, dist)
        text = json.dumps(content, indent=2) + "\n"
        wrong = validator.validate_str(text)
        if wrong:
            raise SystemExit(f"the SBOM of {name} does not follow CycloneDX: {wrong}")
        version = content["metadata"]["component"]["version"]
        path = dist / f"{name.replace('-', '_')}-{version}.cdx.json"
        path.write_text(text, encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
