# `make demo` runs every method on three made recordings, `make test` runs the tests; both need Python >= 3.11 and make only.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
RESULTS := build/demo

.PHONY: demo test lint accuracy speed faults clean

$(VENV)/ready: pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "poise needs Python 3.11 or newer; set PYTHON=")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e '.[all]'
	touch $@

demo: $(VENV)/ready
	$(BIN)/poise demo -o $(RESULTS)
	@echo "Open $(RESULTS)/report.html; then try: $(BIN)/poise estimate YOUR_FILE --plot picture.png"

test: $(VENV)/ready
	$(BIN)/python -m pytest -n 2 --dist worksteal

lint: $(VENV)/ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

accuracy: $(VENV)/ready
	$(BIN)/python benchmarks/accuracy.py --peers

speed: $(VENV)/ready
	$(BIN)/python benchmarks/speed.py

faults: $(VENV)/ready
	$(BIN)/python benchmarks/faults.py

clean:
	rm -rf $(VENV) build
