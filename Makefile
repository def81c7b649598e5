# make demo   see it work: a finger touches two robots, and one reflex withdraws their arms
# make test   run the tests
# make docs   build the documentation into build/docs
# They set up everything they need in .venv; only Python (3.11 or newer) and make must be there.

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready
WORKERS ?= 2
MINUTES ?= 10

# Without bytecode every start of a command would compile this project again.
unexport PYTHONDONTWRITEBYTECODE
# What a test starts finds the commands that belong to this checkout.
export PATH := $(CURDIR)/$(BIN):$(PATH)

.PHONY: campaign test-wheel test-tools fuzz highlight demo demo-wander test test-slow lint format bench golden clean test-editors vsix docs

demo: $(READY)
	$(BIN)/python components/touch_demo/demo.py $(ARGS)

# A simulated robot wanders through a room.
demo-wander: $(READY)
	$(BIN)/python components/wander/demo.py $(ARGS)

test: $(READY)
	$(BIN)/python -m pytest -q -n $(WORKERS) --dist worksteal $(TESTS)

# Many random rounds: minutes, not seconds.
test-slow: $(READY)
	$(BIN)/python -m pytest -q -n $(WORKERS) -m slow -o timeout=7200 -o faulthandler_timeout=0 $(TESTS)

# Build the wheel, install it outside the checkout, run the demos from copied folders.
test-wheel: $(READY)
	$(BIN)/python -m pytest -q -m wheel tests/packaging

# MINUTES shared by all languages; what breaks a rule is kept in build/fuzz/found.
fuzz: $(READY)
	$(BIN)/pip install -q --disable-pip-version-check -e '.[fuzz]' || echo "atheris is not to be had here"
	$(BIN)/python -m tests.fuzz $(MINUTES)

# Inject faults into running deployments: 10 minutes.
campaign: $(READY)
	$(BIN)/python -m tests.campaign

# The words that editors colour, from the grammars.
highlight: $(READY)
	$(BIN)/python -m editors.highlight

# What tests meet that is not Python: editors, and the Slice compiler.
test-tools: $(READY)
	editors/install-test-tools.sh $(CURDIR)/$(BIN)/python

test-editors: test-tools
	$(BIN)/python -m pytest -q -m editors tests/editors

vsix:
	cd editors/vscode && npm ci --no-audit --no-fund && npm run --silent package

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: $(READY)
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

# A warning is an error. The pages need no network.
docs: $(READY)
	$(BIN)/pip install -q --disable-pip-version-check -e '.[docs]'
	rm -rf build/docs
	$(BIN)/python -m docs.build_site build/docs

bench: $(READY)
	$(BIN)/python -m benchmarks $(ONLY)

golden: $(READY)
	$(BIN)/python -m pytest -q --update-golden

clean:
	rm -rf .venv build dist

$(READY): pyproject.toml
	@echo "setting up .venv (once, some minutes) ..."
	$(PYTHON) -m venv .venv
	$(BIN)/pip install -q --disable-pip-version-check -e '.[dev]'
	@touch $@
