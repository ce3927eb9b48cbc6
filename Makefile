# All that is needed is Python (3.10 to 3.13), git and make: each target sets up .venv on its own. `make proofs` alone
# needs Coq besides.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# Named after the Python and the lock's content: with another one of either, the environment is made anew.
LOCKED := $(VENV)/lock-$(lastword $(shell $(PYTHON) --version))-$(firstword $(shell cksum <requirements/dev.lock))
INSTALLED := $(VENV)/installed
DOCS_LOCKED := $(VENV)/docs-lock-$(firstword $(shell cksum <requirements/docs.lock))
FUZZ_LOCKED := $(VENV)/fuzz-lock-$(firstword $(shell cksum <requirements/fuzz.lock))
TOOLS_LOCKED := $(VENV)/tools-lock-$(firstword $(shell cksum <requirements/tools.lock))
INSTALL := $(BIN)/python -m pip --quiet --disable-pip-version-check --no-input install --no-build-isolation --use-pep517
# Without build isolation, what builds contextpy3 from its source is locked, too.
INSTALL_LOCKED := $(INSTALL) --require-hashes -r

.PHONY: help setup demo test fast lint types check-tests coverage site fuzz long proofs theorems bench mutants dist sbom lock clean

help:
	@echo 'make demo     check the shipped rulesets and ask one question of them'
	@echo 'make test     lint, types, and every test but the long ones'
	@echo 'make fast     the tests that take less than a minute and reach everything once'
	@echo 'make coverage the branches that the tests reach, with a bound that fails'
	@echo 'make site     the docs as a site, in site/'
	@echo 'make fuzz     fuzz everything that reads a file; SECONDS=60 for all targets, TARGET=english for one'
	@echo 'make long     the long tests, and ten minutes of fuzzing'
	@echo 'make proofs   all that is proved, checked by Coq, and the programs extracted from it (needs coq and ocaml-findlib)'
	@echo 'make theorems writes the theorems about the shipped rulesets anew, after a change of them'
	@echo 'make bench    the measurements of benchmarks/'
	@echo 'make mutants  mutation testing of the core'
	@echo 'make dist     both distributions of the last commit, in dist/'
	@echo 'make sbom     both distributions, each with an SBOM'
	@echo 'make lock     renew the locks from pyproject.toml'
	@echo 'make clean    remove .venv and what tests and proofs leave behind'

setup: $(INSTALLED)

$(LOCKED):
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 10) <= sys.version_info < (3, 14))' \
	  || { echo 'Python 3.10 to 3.13 is needed; say which with: make PYTHON=python3.12 …'; exit 1; }
	@echo 'Setting up $(VENV) (about half a minute) …'
	@rm -rf $(VENV)
	@$(PYTHON) -m venv $(VENV) \
	  || { echo 'No venv: on Debian and Ubuntu, install the package python3-venv'; exit 1; }
	@$(INSTALL_LOCKED) requirements/build.lock
	@$(INSTALL_LOCKED) requirements/dev.lock
	@touch $@

# In its own step, so that a change of pyproject.toml costs no new environment. Each editable installation is one line
# in a .pth file, which costs a start of Python next to nothing. Compiling is what pip does for packages that it copies.
$(INSTALLED): $(LOCKED) pyproject.toml sleec_runtime/pyproject.toml hatch_build.py
	@$(INSTALL) --no-deps --no-index -e ./sleec_runtime -e .
	@$(BIN)/python -m compileall -q sleec_runtime sleec_verify
	@touch $@

# Some of the shipped rulesets are there to show findings; that check ends in 1, and the demo is fine.
demo: $(INSTALLED)
	@echo '$$ sleec-verify check rulesets/*.sleec --format concise'
	@$(BIN)/sleec-verify check rulesets/*.sleec --format concise || test $$? -eq 1
	@echo
	@echo '$$ sleec-verify explain rulesets/household.sleec --when CurtainOpenRequest --given UserUndressed'
	@$(BIN)/sleec-verify explain rulesets/household.sleec --when CurtainOpenRequest --given UserUndressed
	@echo
	@echo 'More of this is in README.md; the command is $(BIN)/sleec-verify.'

test: lint types check-tests

lint: $(INSTALLED)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/python tools/prose.py

types: $(INSTALLED)
	$(BIN)/mypy

fast: $(INSTALLED)
	$(BIN)/pytest tests/fast -n auto --dist worksteal

check-tests: $(INSTALLED)
	$(BIN)/pytest -n auto --dist worksteal

coverage: $(INSTALLED)
	$(BIN)/pytest -n auto --dist worksteal -m 'not long and not slow' --cov --cov-report=term

# What the site needs besides, into the same environment: the pages are made by running the commands.
$(DOCS_LOCKED): requirements/docs.lock | $(INSTALLED)
	@$(INSTALL_LOCKED) $<
	@touch $@

$(TOOLS_LOCKED): requirements/tools.lock | $(INSTALLED)
	@$(INSTALL_LOCKED) $<
	@touch $@

# As a module, so that website/ can be imported, and not --quiet, which has --strict overlook every warning. The
# variable silences an advertisement of the theme.
site: $(DOCS_LOCKED)
	@NO_MKDOCS_2_WARNING=true $(BIN)/python -m mkdocs build --strict
	@echo 'The site is in site/; read it with: $(BIN)/python -m http.server --directory site'

# The fuzzer comes with a libFuzzer of its own, 130 MB, which nothing else needs.
$(FUZZ_LOCKED): requirements/fuzz.lock | $(INSTALLED)
	@$(INSTALL_LOCKED) $<
	@touch $@

SECONDS = 60
TARGET =
fuzz: $(FUZZ_LOCKED)
	@$(BIN)/python -m tests.fuzz --seconds $(SECONDS) $(TARGET)

long: $(INSTALLED)
	HYPOTHESIS_PROFILE=long $(BIN)/pytest -m long --timeout=7200
	@$(MAKE) --no-print-directory fuzz SECONDS=600

# Needs no Python; where Coq is missing, it says in one line how to get it.
proofs:
	@$(MAKE) --no-print-directory -C proofs check

# After a change of rulesets/: the theorems about them, in Coq.
theorems: $(INSTALLED)
	@$(MAKE) --no-print-directory -C proofs oracle-alone
	$(BIN)/python -m sleec_verify.certificates.theory.theorems rulesets/*.sleec -o proofs/rulesets
	@rm -f proofs/Makefile.coq  # it has the list of them

bench: $(INSTALLED)
	$(BIN)/python -m benchmarks

mutants: $(TOOLS_LOCKED)
	HYPOTHESIS_PROFILE=mutants $(BIN)/mutmut run
	$(BIN)/mutmut results

# The same bytes everywhere: of committed files only, with the time of the commit.
DATED = SOURCE_DATE_EPOCH=$$(git log -1 --format=%ct)
BUILD = $(abspath $(BIN))/python -m hatchling build -d $(CURDIR)/dist
dist: $(INSTALLED)
	@test -z "$$(git status --porcelain)" || { echo 'Commit first: a distribution is made of a commit'; exit 1; }
	@rm -rf dist
	@cd sleec_runtime && $(DATED) $(BUILD)
	@$(DATED) $(BUILD)

sbom: dist $(TOOLS_LOCKED)
	@$(DATED) $(BIN)/python release/sbom.py dist

# One version of each package, which every Python from the oldest on can install; the same one in all locks.
COMPILE := $(BIN)/uv --no-config pip compile --quiet --upgrade --python $(BIN)/python --universal --python-version 3.10 \
  --fork-strategy fewest --generate-hashes --no-strip-extras --no-header --no-emit-package sleec-runtime
lock: $(TOOLS_LOCKED)
	$(COMPILE) pyproject.toml --all-extras --group dev -o requirements/dev.lock
	$(COMPILE) pyproject.toml -c requirements/dev.lock -o requirements/verify.lock
	$(COMPILE) sleec_runtime/pyproject.toml -c requirements/dev.lock -o requirements/runtime.lock
	$(COMPILE) --group build -c requirements/dev.lock -o requirements/build.lock
	$(COMPILE) --group docs -c requirements/dev.lock -o requirements/docs.lock
	$(COMPILE) --group fuzz -c requirements/dev.lock -o requirements/fuzz.lock
	$(COMPILE) --group tools -c requirements/dev.lock -o requirements/tools.lock

clean:
	@$(MAKE) --no-print-directory -C proofs clean
	@$(MAKE) --no-print-directory -C proofs/checker clean
	rm -rf $(VENV) $(VENV)-* build site dist *.egg-info .mypy_cache .ruff_cache .pytest_cache .hypothesis .fuzz .coverage* mutants
