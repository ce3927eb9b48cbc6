# You need Python (3.10 to 3.13), git and make. Each target installs .venv if necessary. `make proofs` also needs Coq.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# Named after the Python version and the content of the lock. If either changes, the environment is installed again.
LOCKED := $(VENV)/lock-$(lastword $(shell $(PYTHON) --version))-$(firstword $(shell cksum <requirements/dev.lock))
INSTALLED := $(VENV)/installed
DOCS_LOCKED := $(VENV)/docs-lock-$(firstword $(shell cksum <requirements/docs.lock))
FUZZ_LOCKED := $(VENV)/fuzz-lock-$(firstword $(shell cksum <requirements/fuzz.lock))
EVALUATION_LOCKED := $(VENV)/evaluation-lock-$(firstword $(shell cksum <requirements/evaluation.lock))
BROWSER_LOCKED := $(VENV)/browser-lock-$(firstword $(shell cksum <requirements/browser.lock))
TOOLS_LOCKED := $(VENV)/tools-lock-$(firstword $(shell cksum <requirements/tools.lock))
INSTALL := $(BIN)/python -m pip --quiet --disable-pip-version-check --no-input install --no-build-isolation --use-pep517
# Without build isolation, the tools that build contextpy3 from source are locked, too.
INSTALL_LOCKED := $(INSTALL) --require-hashes -r

.PHONY: help setup demo robot test fast lint types check-tests slow coverage site page browser fuzz long proofs theorems bench evaluation check-evaluation mutants dist sbom lock clean

help:
	@echo 'make demo     check the shipped rulesets, and explain one situation'
	@echo 'make robot    run a robot in processes over DDS, with a mission, and audit its record'
	@echo 'make test     lint, types, and all tests except those of `make slow` and `make long`; COVERAGE=1 also measures coverage'
	@echo 'make fast     the fast tests, which cover every feature once in about three minutes of processor time'
	@echo 'make slow     the slow tests, which take seconds each, and then those that compare times'
	@echo 'make coverage the tests of `make test`, with branch coverage; fails below a bound'
	@echo 'make site     build the documentation in site/'
	@echo 'make page     build the page of `serve` from frontend/ (needs npm); CHECK=1 fails if that changes anything'
	@echo 'make browser  test the page in Chromium; screenshots are in .browser/ (needs npm and chromium)'
	@echo 'make fuzz     fuzz everything that reads a file; SECONDS=60 for all targets, TARGET=english for one target'
	@echo 'make long     run the long tests, and fuzz for ten minutes'
	@echo 'make proofs   check all proofs with Coq, and build the extracted programs (needs coq and ocaml-findlib)'
	@echo 'make theorems write the theorems about the shipped rulesets, after a change to these'
	@echo 'make bench    run the benchmarks'
	@echo 'make evaluation  repeat the evaluation of the paper'
	@echo 'make check-evaluation  test the evaluation, and run its short version'
	@echo 'make mutants  run mutation tests of the core'
	@echo 'make dist     build both distributions of the last commit in dist/'
	@echo 'make sbom     build both distributions, each with an SBOM'
	@echo 'make lock     update the locks from pyproject.toml'
	@echo 'make clean    remove .venv and the output of tests and proofs'

setup: $(INSTALLED)

$(LOCKED):
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 10) <= sys.version_info < (3, 14))' \
	  || { echo 'Python 3.10 to 3.13 is required; select one with: make PYTHON=python3.12 …'; exit 1; }
	@echo 'Setting up $(VENV) (about a minute) …'
	@rm -rf $(VENV)
	@$(PYTHON) -m venv $(VENV) \
	  || { echo 'Python has no venv module; on Debian and Ubuntu, install the package python3-venv'; exit 1; }
	@$(INSTALL_LOCKED) requirements/build.lock
	@$(INSTALL_LOCKED) requirements/dev.lock
	@touch $@

# A separate step, so that a change to pyproject.toml needs no new environment. An editable installation is one line in
# a .pth file, which costs almost no start-up time. pip would compile packages that it copies, so compile them here.
$(INSTALLED): $(LOCKED) pyproject.toml sleec_runtime/pyproject.toml hatch_build.py
	@$(INSTALL) --no-deps --no-index -e ./sleec_runtime -e .
	@$(BIN)/python -m compileall -q sleec_runtime sleec_verify
	@touch $@

# The robot of examples/robot, in processes of its own. It ends by itself.
robot: $(INSTALLED)
	@$(BIN)/python -m examples.robot

# Some of the shipped rulesets show findings, so the check exits with 1 and the demo still passes.
demo: $(INSTALLED)
	@echo '$$ sleec-verify check rulesets/*.sleec --format concise'
	@$(BIN)/sleec-verify check rulesets/*.sleec --format concise || test $$? -eq 1
	@echo
	@echo '$$ sleec-verify explain rulesets/household.sleec --when CurtainOpenRequest --given UserUndressed'
	@$(BIN)/sleec-verify explain rulesets/household.sleec --when CurtainOpenRequest --given UserUndressed
	@echo
	@echo 'See README.md for more; the command is $(BIN)/sleec-verify.'

test: lint types check-tests

lint: $(INSTALLED)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/python tools/prose.py

types: $(INSTALLED)
	$(BIN)/mypy

SHORT_TESTS := not long and not slow and not speed

fast: $(INSTALLED)
	$(BIN)/pytest tests/fast -n auto --dist worksteal -m '$(SHORT_TESTS)'

# COVERAGE=1 measures branch coverage in the same run, which doubles the time of the tests.
COVERAGE =
check-tests: $(INSTALLED)
	$(BIN)/pytest -n auto --dist worksteal -m '$(SHORT_TESTS)' $(if $(COVERAGE),--cov --cov-report= --timeout=600)

# The tests that `make test` leaves out because of its time; .ci/run has them, too.
slow: $(INSTALLED)
	$(BIN)/pytest -n auto --dist worksteal --timeout=600 -m 'slow and not long'
	$(BIN)/pytest --timeout=600 -m speed

coverage:
	@$(MAKE) --no-print-directory check-tests COVERAGE=1
	@$(BIN)/coverage report

# Into the same environment, because the pages are generated by running the commands.
$(DOCS_LOCKED): requirements/docs.lock | $(INSTALLED)
	@$(INSTALL_LOCKED) $<
	@touch $@

$(TOOLS_LOCKED): requirements/tools.lock | $(INSTALLED)
	@$(INSTALL_LOCKED) $<
	@touch $@

# As a module, so that website/ can be imported. Not with --quiet, because then --strict ignores warnings. The variable
# silences an advertisement of the theme.
site: $(DOCS_LOCKED)
	@NO_MKDOCS_2_WARNING=true $(BIN)/python -m mkdocs build --strict
	@echo 'The site is in site/; open it with: $(BIN)/python -m http.server --directory site'

# The built page is committed, so that only those who change frontend/ need npm. The same bytes on every machine.
PAGE := sleec_verify/serve/page
# Node has certificates of its own; those of the system can include that of a local proxy.
frontend/node_modules: export NODE_EXTRA_CA_CERTS ?= $(wildcard /etc/ssl/certs/ca-certificates.crt)
# Not `npm ci`: the lock has the parts of rollup for Linux on x86-64 only, and elsewhere npm adds those of its platform.
frontend/node_modules: frontend/package-lock.json
	npm --prefix frontend install --no-save --ignore-scripts --no-audit --no-fund
	@touch $@

page: frontend/node_modules
	npm --prefix frontend run build
ifdef CHECK
	@test -z "$$(git status --porcelain $(PAGE))" || { echo 'The committed page differs; run: make page'; exit 1; }
endif

$(BROWSER_LOCKED): requirements/browser.lock | $(INSTALLED)
	@$(INSTALL_LOCKED) $<
	@touch $@

# The folder frontend/node_modules has axe-core, which looks for barriers.
browser: $(BROWSER_LOCKED) frontend/node_modules
	$(BIN)/pytest tests/browser --timeout=600

# The fuzzer includes libFuzzer (130 MB), which nothing else needs.
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

# Needs no Python. If Coq is missing, one line says how to install it.
proofs:
	@$(MAKE) --no-print-directory -C proofs check

# The theorems about the shipped rulesets in Coq, after a change to rulesets/.
theorems: $(INSTALLED)
	@$(MAKE) --no-print-directory -C proofs oracle-alone
	$(BIN)/python -m sleec_verify.certificates.theory.theorems rulesets/*.sleec -o proofs/rulesets
	@rm -f proofs/Makefile.coq  # it has the list of them

bench: $(INSTALLED)
	$(BIN)/python -m benchmarks

$(EVALUATION_LOCKED): requirements/evaluation.lock | $(INSTALLED)
	@$(INSTALL_LOCKED) $<
	@touch $@

# The evaluation of the paper, repeated. QUICK=--quick for the short version.
QUICK =
evaluation: $(EVALUATION_LOCKED)
	$(BIN)/python -m benchmarks.evaluation $(QUICK)

# What `make test` skips, because it does not install scipy and matplotlib.
check-evaluation: $(EVALUATION_LOCKED)
	@$(BIN)/pytest tests/fast/benchmarks tests/thorough/benchmarks

mutants: $(TOOLS_LOCKED)
	HYPOTHESIS_PROFILE=mutants $(BIN)/mutmut run
	$(BIN)/mutmut results

# The same bytes on every machine: only committed files, with the time of the commit.
DATED = SOURCE_DATE_EPOCH=$$(git log -1 --format=%ct)
BUILD = $(abspath $(BIN))/python -m hatchling build -d $(CURDIR)/dist
dist: $(INSTALLED)
	@test -z "$$(git status --porcelain)" || { echo 'Commit first: distributions are built from a commit'; exit 1; }
	@rm -rf dist
	@cd sleec_runtime && $(DATED) $(BUILD)
	@$(DATED) $(BUILD)

sbom: dist $(TOOLS_LOCKED)
	@$(DATED) $(BIN)/python release/sbom.py dist

# One version of each package for all locks, which every supported Python can install.
COMPILE := $(BIN)/uv --no-config pip compile --quiet --upgrade --python $(BIN)/python --universal --python-version 3.10 \
  --fork-strategy fewest --generate-hashes --no-strip-extras --no-header --no-emit-package sleec-runtime
lock: $(TOOLS_LOCKED)
	$(COMPILE) pyproject.toml --all-extras --group dev -o requirements/dev.lock
	$(COMPILE) pyproject.toml -c requirements/dev.lock -o requirements/verify.lock
	$(COMPILE) sleec_runtime/pyproject.toml -c requirements/dev.lock -o requirements/runtime.lock
	$(COMPILE) --group build -c requirements/dev.lock -o requirements/build.lock
	$(COMPILE) --group browser -c requirements/dev.lock -o requirements/browser.lock
	$(COMPILE) --group docs -c requirements/dev.lock -o requirements/docs.lock
	$(COMPILE) --group fuzz -c requirements/dev.lock -o requirements/fuzz.lock
	$(COMPILE) --group evaluation -c requirements/dev.lock -o requirements/evaluation.lock
	$(COMPILE) --group tools -c requirements/dev.lock -o requirements/tools.lock

clean:
	@$(MAKE) --no-print-directory -C proofs clean
	@$(MAKE) --no-print-directory -C proofs/checker clean
	rm -rf $(VENV) $(VENV)-* build site dist *.egg-info .mypy_cache .ruff_cache .pytest_cache .hypothesis .fuzz .coverage* mutants
