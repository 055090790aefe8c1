# Everything runs in .venv, which is made by the first target that needs it.
PYTHON ?= python3.11
BIN := .venv/bin

.venv/.base: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/pip install -q --disable-pip-version-check -c constraints.txt -e .
	@touch $@

.venv/.dev: .venv/.base
	$(BIN)/pip install -q --disable-pip-version-check -c constraints.txt -e '.[dev]'
	@touch $@ 

.PHONY: setup
setup: .venv/.dev
