"""What the build adds to pyproject.toml: sleec-verify needs sleec-runtime of its own version."""

from __future__ import annotations

from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface


class Dependencies(MetadataHookInterface):
    def update(self, metadata: dict[str, Any]) -> None:
        metadata["dependencies"] = [f"sleec-runtime=={metadata['version']}", *self.config["dependencies"]]
