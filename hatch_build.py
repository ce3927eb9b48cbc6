"""Add to the metadata that sleec-verify depends on its own version of sleec-runtime."""

from __future__ import annotations

from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface


class Dependencies(MetadataHookInterface):
    def update(self, metadata: dict[str, Any]) -> None:
        metadata["dependencies"] = [f"sleec-runtime=={metadata['version']}", *self.config["dependencies"]]
