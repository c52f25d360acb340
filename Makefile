# `make demo` and `make test` do all set-up themselves: they need Python 3.11 or newer, make and a network.
VENV := .venv
BIN := $(VENV)/bin
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	if $$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then echo $$p; break; fi; done)
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
# modules are compiled when they are imported: most of what is installed never is
INSTALL := $(PIP) install --no-compile --editable
WORKERS ?= 2

.PHONY: help demo test check lint types examples bench format clean
help:  ## what can be made
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed 's/:.*## /\t/'

$(VENV)/made:
	@test -n "$(PYTHON)" || { echo "footwork needs Python 3.11 or newer; none was found" >&2; exit 2; }
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/installed: $(VENV)/made pyproject.toml
	$(INSTALL) '.[view,plots]'
	@touch $@

$(VENV)/developing: $(VENV)/made pyproject.toml
	$(INSTALL) '.[dev]'
	@touch $@ $(VENV)/installed

demo: $(VENV)/installed  ## build and serve a character made from embedded motions, and let one play it
	$(BIN)/footwork demo

test: $(VENV)/developing  ## run the tests
	$(BIN)/python -m pytest --numprocesses $(WORKERS) --dist worksteal --ignore tests/docs

check: lint types examples  ## lint, types, import rules, every example of the documentation

lint: $(VENV)/developing
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports

types: $(VENV)/developing
	$(BIN)/pyright

examples: $(VENV)/developing
	$(BIN)/python -m pytest tests/docs

bench: $(VENV)/developing  ## run the benchmarks, each prints JSON
	@for script in benchmarks/*.py; do echo "== $$script" >&2; $(BIN)/python $$script || exit 1; done

format: $(VENV)/developing  ## put the code into its usual form
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

clean:  ## remove the virtual environment and what was built
	rm -rf $(VENV) build dist
