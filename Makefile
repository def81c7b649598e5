# make demo   run the demo: a finger touches two robots, and a reflex withdraws their arms
# make test   run the tests
# make docs   build the documentation into build/docs
# They install everything else into .venv; they require only Python (3.11 or newer) and make.

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready
WORKERS ?= 3
MINUTES ?= 10

# Without bytecode files every command would compile the project at its start.
unexport PYTHONDONTWRITEBYTECODE
# Processes started by tests use the commands of this checkout.
export PATH := $(CURDIR)/$(BIN):$(PATH)

.PHONY: campaign campaign-hosts conformance test-wheel test-tools test-hosts test-peers fuzz highlight demo demo-wander test test-slow lint format bench golden clean test-editors vsix docs

demo: $(READY)
	$(BIN)/python components/touch_demo/demo.py $(ARGS)

# A simulated robot drives around in a room.
demo-wander: $(READY)
	$(BIN)/python components/wander/demo.py $(ARGS)

test: $(READY)
	$(BIN)/python -m pytest -q -n $(WORKERS) --dist worksteal $(TESTS)

# Tests with many random inputs; they take minutes.
test-slow: $(READY)
	$(BIN)/python -m pytest -q -n $(WORKERS) -m slow -o timeout=7200 -o faulthandler_timeout=0 $(TESTS)

# Build the wheel, install it outside the checkout, and run the demos from copied folders.
test-wheel: $(READY)
	$(BIN)/python -m pytest -q -m wheel tests/packaging

# MINUTES is the total for all languages; failing inputs are stored in build/fuzz/found.
fuzz: $(READY)
	$(BIN)/pip install -q --disable-pip-version-check -e '.[fuzz]' || echo "atheris could not be installed: fuzzing without coverage feedback"
	$(BIN)/python -m tests.fuzz $(MINUTES)

# Inject faults into running deployments: 10 minutes.
campaign: $(READY)
	$(BIN)/python -m tests.campaign

# Inject faults into deployments over simulated hosts; the figures go to build/host_faults.json.
campaign-hosts: $(READY)
	tests/hosts/install.sh
	mkdir -p build
	FAULT_ROUNDS=25 FAULT_CUT_S=30 FAULT_FIGURES=build/host_faults.json \
	$(BIN)/python -m pytest -q -m hosts tests/hosts/faults

# Generate the editors' keyword files from the grammars.
highlight: $(READY)
	$(BIN)/python -m editors.highlight

# Install the programs that tests use besides Python: editors, the Slice compiler, systemd, libraries
# of Qt.
test-tools: $(READY)
	tests/hosts/install.sh
	editors/install-test-tools.sh $(CURDIR)/$(BIN)/python
	tests/runtime/gui/install.sh
	$(BIN)/pip install -q --disable-pip-version-check kubernetes-validate

test-editors: test-tools
	$(BIN)/python -m pytest -q -m editors tests/editors

# Programs of other projects call components, and are called by them: ZeroC Ice, YARP, ROS 1, ROS 2, DDS.
# One test at a time: every yarpserver gives its programs the same TCP ports.
test-peers: $(READY)
	tests/middleware/install-peers.sh $(CURDIR)/$(BIN)/python
	tests/middleware/yarp/install-peers.sh build/yarp-venv
	tests/middleware/ros1/install-peers.sh
	$(BIN)/python -m pytest -q -m peers tests/middleware tests/bridge --ignore tests/middleware/ros2
	$(BIN)/python -m pytest -q -n $(WORKERS) tests/middleware/conformance --middleware ice
	tests/middleware/ros2/install-peers.sh $(PYTHON) build/peers-venv
	build/peers-venv/bin/python -m pytest -q -m peers tests/middleware/ros2 tests/bridge/peers/test_ros2_bridge_peers.py

# Deployments over several hosts: OpenSSH servers, systemd and networks in namespaces of their own.
test-hosts: $(READY)
	tests/hosts/install.sh
	$(BIN)/python -m pytest -q -n $(WORKERS) --dist loadfile -m hosts tests/hosts

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

# Warnings are errors. The pages work without a network.
docs: $(READY)
	$(BIN)/pip install -q --disable-pip-version-check -e '.[docs]'
	rm -rf build/docs
	$(BIN)/python -m docs.build_site build/docs

# Test all middlewares that are installed, and write the table of the documentation.
conformance: $(READY)
	$(BIN)/python -m pytest -q -n $(WORKERS) tests/middleware/conformance --conformance-report build/conformance.json
	$(BIN)/python -m tests.middleware.conformance_table build/conformance.json

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
