"""Writing files whole or not at all."""

from __future__ import annotations

import os

from sleec_runtime.errors import SleecError


def write_whole(path: str, text: str) -> None:
    """Put `text` in the file at `path`, whole or not at all. A link stays a link, and the rights stay as they are.

    Raises:
        SleecError: it cannot be written; what was there is still there.
    """
    from shutil import copymode
    from tempfile import NamedTemporaryFile

    target = os.path.realpath(path)
    try:
        with NamedTemporaryFile("wb", dir=os.path.dirname(target), prefix=".", suffix=".tmp", delete=False) as file:
            try:
                file.write(text.encode())
                file.close()
                if os.path.exists(target):
                    copymode(target, file.name)
                else:
                    os.chmod(file.name, 0o666 & ~_umask())
                os.replace(file.name, target)
            except BaseException:
                os.unlink(file.name)
                raise
    except OSError as error:
        raise SleecError(f"{path} cannot be written: {error.strerror}", "nothing of it was changed") from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
