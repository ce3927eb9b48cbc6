"""Writes the folder of a certificate atomically. It never replaces anything but a certificate."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path

from sleec_runtime.certificate.coverage import MANIFEST, read_manifest
from sleec_runtime.certificate.signature import SIGNATURE
from sleec_runtime.errors import CertificateRefused, SleecError
from sleec_verify.files.temporary import with_temporary


class FolderExists(SleecError):
    """The folder for the certificate already exists."""


def check_free(folder: str, force: bool) -> None:
    """Checks that the folder can be written: it must not exist or be empty. With `force`, it may be a certificate.

    Raises FolderExists.
    """
    path = Path(folder)
    if not os.path.lexists(path):
        return
    if path.is_symlink() or not path.is_dir():
        raise FolderExists(f"{folder} exists and is not a folder", "choose another name")
    try:
        names = set(os.listdir(path))
    except OSError as error:
        raise FolderExists(f"the folder {folder} cannot be read: {error.strerror}") from None
    if not names:
        return
    try:
        ours = {MANIFEST, SIGNATURE, *read_manifest(folder).files}
    except CertificateRefused:
        ours = set()
    if not names <= ours:
        raise FolderExists(
            f"{folder} exists and contains files that are not part of a certificate",
            "choose another folder, or a new one",
        )
    if not force:
        raise FolderExists(f"{folder} already contains a certificate", "use --force to overwrite it")


def write_folder(
    folder: str,
    files: Iterable[tuple[str, bytes]],
    force: bool,
    accept: Callable[[str], object] = lambda made: None,
) -> None:
    """Write a certificate atomically. `accept` gets the new folder first; if it raises an error, nothing is written.

    Raises:
        FolderExists: the folder already exists.
        SleecError: the folder cannot be written.
    """
    check_free(folder, force)
    target = Path(os.path.abspath(folder))
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with_temporary(str(target), lambda path: _make(Path(path), target, files, accept))
    except OSError as error:
        raise SleecError(f"the certificate cannot be written to {folder}: {error.strerror}", "nothing was") from None


def _make(made: Path, target: Path, files: Iterable[tuple[str, bytes]], accept: Callable[[str], object]) -> None:
    """Write the files to a folder in `made`, and move it to `target`."""
    new, old = made / "new", made / "old"
    made.mkdir(0o700)
    new.mkdir()
    for name, data in files:
        (new / name).write_bytes(data)
    accept(str(new))
    try:
        try:
            if target.exists():
                target.rename(old)
            new.rename(target)
        finally:
            _restore(old, target)
    finally:  # a second Ctrl-C must not cost what was there either
        _restore(old, target)


def _restore(old: Path, target: Path) -> None:
    if old.exists() and not target.exists():
        old.rename(target)
