# Everything runs in .venv, which the first target that needs it makes. No other tool is needed
# than Python 3.11 and make; the tests of the web page also want a chromium, and skip without one.
PYTHON ?= python3.11
BIN := .venv/bin
PIP := $(BIN)/pip install -q --disable-pip-version-check -c constraints.txt

.PHONY: setup nqe browser test test-slow check bench

setup: .venv/.dev browser

.venv/.base: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(PIP) -e .
	@touch $@

.venv/.dev: .venv/.base
	$(PIP) -e '.[dev]'
	@touch $@

browser:
	@bash tools/browser.sh

nqe: .venv/.base
	$(BIN)/ion drive nqe --seed 0 --out runs

test: .venv/.dev browser
	$(BIN)/pytest -n auto

test-slow: .venv/.dev
	$(BIN)/pytest -m slow

check: .venv/.dev browser
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/pyright
	$(BIN)/lint-imports
	$(BIN)/pytest -n auto

# What a simulated second costs, part by part and against others; then twenty seeds of the NQE, two
# at a time: what a change to the navigator is measured by.
bench: .venv/.dev
	$(BIN)/ion bench
	$(BIN)/python tests/bench_physics.py
	$(BIN)/python tests/bench_random_field.py
	$(BIN)/ion drive nqe --seeds 0-19 --jobs 2 --out runs/bench --json
