# make run        a private environment in .venv, then the first example solved and printed
# make test       the same environment with what the tests need; ruff, pytest
# make lint       ruff, mypy --strict
# make gallery    drawings and worked solutions of the bundled problems, in build/gallery
# make test-browser  the live pages in a real Chromium, which it installs where there is none (Debian, as root)
# make docs       the site, in build/site: every example and notebook run, every page opened in Chromium where there is one
# make audit      known vulnerabilities of the packages that are used
# make test-long  mypy and the long tests too; make test-exhaustive all there are (over an hour)
# Needs nothing but make and Python 3.11 or newer.

VENV ?= .venv
PYTEST_ARGS ?=
BIN := $(VENV)/bin
PYTEST = $(BIN)/python -m pytest -n 2 --dist worksteal
# The matrices are small and tests run side by side: more threads would only wait for each other.
export OPENBLAS_NUM_THREADS ?= 1
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet

FIND_PYTHON = for p in $(PYTHON) python3 python3.14 python3.13 python3.12 python3.11 python; do \
    "$$p" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo "$$p" && exit 0; \
  done; \
  echo "dalembert needs Python 3.11 or newer with its venv module; none was found." \
       "Install it, or name it: make $(MAKECMDGOALS) PYTHON=/path/to/python3" >&2; exit 1

.PHONY: run test test-browser test-long test-exhaustive web check-web docs audit style lint gallery clean

run: $(VENV)/.run
	@$(BIN)/dalembert solve examples/four_bar.yaml

# mypy takes one core for a minute: it runs beside the tests and prints after them.
TESTED = @mkdir -p build; $(BIN)/mypy --strict > build/mypy.txt 2>&1 & typed=$$!; \
  $(PYTEST) $(1) $(PYTEST_ARGS); tests=$$?; wait $$typed; typed=$$?; cat build/mypy.txt; exit $$((tests | typed))

# In a new checkout it takes half a minute of each core to rewrite the assertions: only what fails is run again with them.
test: style
	@$(PYTEST) --assert=plain $(PYTEST_ARGS) || { [ $$? = 1 ] && $(PYTEST) --last-failed $(PYTEST_ARGS); exit 1; }

test-long: style
	$(call TESTED,-m "not exhaustive")

test-exhaustive: style
	$(call TESTED,-m "")

gallery: $(VENV)/.test
	@$(BIN)/python docs/gallery.py

docs: $(VENV)/.test
	@$(PIP) install --editable '.[docs]'
	@$(BIN)/python docs/site/build.py $(DOCS_ARGS)
	@! command -v chromium >/dev/null || $(BIN)/python docs/site/check_pages.py

test-browser: $(VENV)/.test
	@command -v chromium >/dev/null || { apt-get update -qq && apt-get install -y -qq chromium; }
	@DALEMBERT_BROWSER=$$(command -v chromium) $(PYTEST) -m "not exhaustive" tests/browser $(PYTEST_ARGS)

# The front end of the live pages: web/ to the bundles of pages and studio; needs Node. check-web fails where they differ.
web:
	@cd web && npm ci --no-audit --no-fund --silent && npm run --silent build

check-web: web
	@git diff --exit-code --stat src/dalembert/pages/bundle src/dalembert/studio/bundle

# Known vulnerabilities of what is installed, and of the packages that the front end is built with; needs a network.
audit: $(VENV)/.test
	@$(PIP) install pip-audit && $(BIN)/pip-audit --skip-editable
	@cd web && npm audit

style: $(VENV)/.test
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .

lint: style
	@$(BIN)/mypy --strict

$(BIN)/python:
	@python=$$($(FIND_PYTHON)) || exit 1; \
	  echo "Making $(VENV) with $$("$$python" --version)"; "$$python" -m venv "$(VENV)"

$(VENV)/.run: pyproject.toml | $(BIN)/python
	@echo "Installing dalembert into $(VENV)"
	@$(PIP) install --editable . && touch $@

$(VENV)/.test: pyproject.toml | $(BIN)/python
	@echo "Installing dalembert and its test requirements into $(VENV)"
	@$(PIP) install --editable '.[test]' && touch $@ $(VENV)/.run

clean:
	@rm -rf "$(VENV)" build dist .pytest_cache .mypy_cache .ruff_cache
