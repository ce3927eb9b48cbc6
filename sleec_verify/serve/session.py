"""What the server knows between requests: the file, its draft, the parsed texts, and the last good analysis."""

from __future__ import annotations

from collections import OrderedDict
from contextlib import suppress
from hashlib import sha256
from threading import Lock

from sleec_runtime.errors import SleecError
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks.incremental.checking import IncrementalChecks
from sleec_verify.results.finding import CheckResult
from sleec_verify.serve.analysis import Analysis, analysis_of
from sleec_verify.serve.cases_file import ServedCases
from sleec_verify.serve.drafts import DraftStore
from sleec_verify.serve.interest import held, require_interest
from sleec_verify.serve.rules_file import ServedFile

_KEPT = 4
"""The parsed texts that are kept: the one of the page, and those it is compared with. The same number of analyses."""


class UnknownText(SleecError):
    """The digest of a text that the server does not know, or no longer knows."""


class Session:
    """The state of one server. Several requests may use it at the same time."""

    def __init__(self, path: str, drafts: str | None = None) -> None:
        """`path` is the file with rules, and `drafts` the folder of drafts, by default that of the user."""
        self.file = ServedFile(path)
        self.cases = ServedCases(path)
        self.drafts = DraftStore(path, drafts)
        self._checks = IncrementalChecks()
        self._checking = Lock()
        self._analyses: OrderedDict[str, Analysis] = OrderedDict()
        self._parsed: OrderedDict[str, Ruleset] = OrderedDict()
        self._lock = Lock()

    def ruleset(self, text: str) -> Ruleset:
        """The ruleset of a text. Raises `LanguageError` if it is not one."""
        digest = sha256(text.encode()).hexdigest()
        with suppress(UnknownText):
            return self.known_ruleset(digest)
        ruleset = parse(text, self.file.path, digest)
        with self._lock:
            self._parsed[digest] = ruleset
            while len(self._parsed) > _KEPT:
                self._parsed.popitem(last=False)
        return ruleset

    def known_ruleset(self, digest: str) -> Ruleset:
        """The ruleset of a text that was read recently. Raises `UnknownText` if there is none with this digest."""
        with self._lock:
            if digest not in self._parsed:
                raise UnknownText("the server no longer knows this text", "send the text")
            self._parsed.move_to_end(digest)
            return self._parsed[digest]

    def check(self, ruleset: Ruleset) -> tuple[CheckResult, ...]:
        """The results of the checks, one text after the other. Raises `Superseded` if the client has cancelled its
        request. The first text is always checked completely, because later ones are compared with it."""
        with held(self._checking):
            return self._results(ruleset)

    def analysis(self, text: str, digest: str) -> Analysis:
        """The analysis of a text with this digest. Raises `LanguageError` if it is not a ruleset, and `Superseded` if
        the client has cancelled its request. Texts are read in turn, so stale ones would delay the newest."""
        with held(self._checking):
            ruleset = self.ruleset(text)
            found = analysis_of(ruleset, self._results(ruleset), digest, self.last_analysis)
            with self._lock:
                self._analyses[found.version] = found
                while len(self._analyses) > _KEPT:
                    self._analyses.popitem(last=False)
            return found

    @property
    def last_analysis(self) -> Analysis | None:
        """The analysis of the last text that was a ruleset."""
        with self._lock:
            return next(reversed(self._analyses.values()), None)

    def analysis_of_page(self, version: str) -> Analysis | None:
        """The analysis of this version, unless it is too old."""
        with self._lock:
            return self._analyses.get(version)

    def _results(self, ruleset: Ruleset) -> tuple[CheckResult, ...]:
        return self._checks.results(ruleset, require_interest if self._checks.is_prepared else None)
