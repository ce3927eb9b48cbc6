"""A git repository for tests."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path


class Repository:
    """A repository in `folder`, with nobody's configuration but its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.git("init", "-q", "-b", "main")
        self.git("config", "user.email", "nobody@example.org")
        self.git("config", "user.name", "Nobody")
        self.git("config", "commit.gpgsign", "false")

    def git(self, *arguments: str) -> str:
        environment = {**os.environ, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
        done = subprocess.run(
            ["git", *arguments], cwd=self.folder, check=True, capture_output=True, text=True, env=environment
        )
        return done.stdout.strip()

    def write(self, **files: str | None) -> None:
        """Write files (``a_sleec`` for ``a.sleec``), or remove those that are None."""
        for name, text in files.items():
            self.put(name.replace("_", "."), text)

    def put(self, path: str, text: str | None) -> None:
        target = self.folder / path
        if text is None:
            target.unlink()
        else:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")

    def keep(self, *paths: str) -> None:
        """Commit these files, as they are, and nothing else."""
        self.git("add", "--", *paths)
        self.git("commit", "-q", "--allow-empty", "-m", "settings", "--", *paths)

    def commit(self, message: str = "a change", **files: str | None) -> str:
        self.write(**files)
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", message)
        return self.git("rev-parse", "HEAD")
