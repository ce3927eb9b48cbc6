"""A checkout that somebody hostile wrote: all that Python or pip could pick up from it."""

from __future__ import annotations

from pathlib import Path

MODULES = ["venv", "pip", "ensurepip", "sitecustomize", "usercustomize", "json", "click", "rich", "contextpy3"]
PACKAGES = ["sleec_verify", "sleec_runtime", "setuptools", "hatchling", "hatch_fancy_pypi_readme"]


def plant(folder: Path, marks: Path) -> dict[str, str]:
    """Put everything into a folder that Python or pip could pick up there, and return the variables of a job that even
    points to it. What is run writes its name to `marks`."""
    folder.mkdir(exist_ok=True)
    trap = f"with open({str(marks)!r}, 'a') as file: file.write(__name__ + ' in ' + __file__ + chr(10))\n"
    for name in MODULES:
        (folder / f"{name}.py").write_text(trap)
    for name in PACKAGES:
        (folder / name).mkdir()
        (folder / name / "__init__.py").write_text(trap)
        (folder / name / "__main__.py").write_text(trap)
    (folder / "setup.py").write_text(trap)
    (folder / "setup.cfg").write_text("[install]\nprefix = /nowhere\n[easy_install]\nindex_url = http://127.0.0.1:9\n")
    (folder / "pyproject.toml").write_text(
        '[build-system]\nrequires = []\nbuild-backend = "click"\nbackend-path = ["."]\n'
    )
    (folder / "requirements.txt").write_text(".\n")
    settings = "[global]\nindex-url = http://127.0.0.1:9\n[install]\nrequirement = requirements.txt\n"
    (folder / "config" / "pip").mkdir(parents=True)
    for pip in (folder / "pip.conf", folder / "config" / "pip" / "pip.conf"):
        pip.write_text(settings)
    return {
        "PYTHONPATH": str(folder),
        "PYTHONSTARTUP": str(folder / "click.py"),
        "PYTHONHOME": str(folder),
        "XDG_CONFIG_HOME": str(folder / "config"),
        "PIP_CONFIG_FILE": str(folder / "pip.conf"),
        "PIP_REQUIREMENT": str(folder / "requirements.txt"),
        "PIP_INDEX_URL": "http://127.0.0.1:9",
        "PIP_REQUIRE_VIRTUALENV": "0",
        "PIP_TARGET": str(folder),
    }
