"""The file of cases beside the served rules, as the pytest plugin reads it. Text that people wrote in it stays."""

from __future__ import annotations

from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from threading import Lock

from sleec_runtime.errors import SleecError
from sleec_runtime.support.files import read_file
from sleec_verify.conformance.cases.case import Case, CasesError
from sleec_verify.conformance.cases.reader import SUFFIX
from sleec_verify.conformance.cases.writer import list_of, situation_lines
from sleec_verify.files.folders import beside
from sleec_verify.files.placement import write_new, write_whole
from sleec_verify.files.toml import parse_toml
from sleec_verify.repairs.rules_file import require_writable
from sleec_verify.wording.phrases import quoted


class ServedCases:
    """The file of cases beside the rules at `path`."""

    def __init__(self, path: str) -> None:
        self.path = Path(beside(path, SUFFIX))
        self._lock = Lock()

    def exists(self) -> bool:
        return self.path.exists()

    def digest(self) -> str | None:
        """The SHA-256 of the file; None if it cannot be read."""
        try:
            return sha256(read_file(self.path)).hexdigest()
        except OSError:
            return None

    def add(self, case: Case) -> None:
        """Add a case at the end of the file, atomically. Create the file if it does not exist.

        Raises:
            CasesError: the file is not one of cases, or has a case of this name.
            SleecError: it cannot be read or written.
        """
        added = "".join(f"{line}\n" for line in _lines(case))
        shown = str(self.path)
        with self._lock:
            if not self.exists():
                write_new(shown, added.encode())
                return
            require_writable(shown)
            content = self._content()
            entries = parse_toml(content, shown, CasesError).get("case", [])
            if any(isinstance(entry, dict) and entry.get("name") == case.name for entry in entries):
                raise CasesError(f"the case {quoted(case.name)} already exists", "choose another name")
            between = "\n" if content.endswith(b"\n") else "\n\n"
            more = f"{between if content else ''}{added}"
            content += (more.replace("\n", "\r\n") if b"\r\n" in content else more).encode()
            parse_toml(content, shown, CasesError)  # a list of cases in another form cannot be continued
            write_whole(shown, content)

    def _content(self) -> bytes:
        try:
            return read_file(self.path)
        except OSError as error:
            raise SleecError(f"{self.path} cannot be read: {error.strerror}") from None


def _lines(case: Case) -> Iterator[str]:
    yield from situation_lines(case)
    yield "conflict = true" if case.conflict else f"obligations = {list_of(case.obligations)}"
    if case.prohibitions is not None:
        yield f"prohibitions = {list_of(case.prohibitions)}"
