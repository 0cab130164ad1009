# `make` alone lists the targets. Times are for 2 cores.
.DEFAULT_GOAL := help
SHELL := /bin/bash
PYTHON ?= python3
BIN := .venv/bin
RUN := $(BIN)/python -m rkverify
# One thread per process: the runner already uses every core, and results must not depend on the count.
export OMP_NUM_THREADS ?= 1
export OPENBLAS_NUM_THREADS ?= 1
export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PYTHONNOUSERSITE := 1

.PHONY: help install reproduce smoke test property fuzz check lock notebooks report bench peers controls mutants clean

help: ## list the targets (now)
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## (.*)$$/\1|\2/' | \
	  while IFS='|' read -r name text; do printf '  make %-10s %s\n' "$$name" "$$text"; done

install: .venv/installed ## create .venv from requirements.lock (2 min)

.venv/installed: requirements.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "rkverify needs Python 3.11 or newer; try make PYTHON=python3.11")'
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --require-hashes --requirement requirements.lock
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	touch $@

reproduce: install ## compute every table and figure and build the report (5 min; 5 s if nothing changed)
	$(RUN) run
	$(RUN) report
	$(RUN) export --ro-crate

smoke: install ## reproduce in a quick form, under .rkverify/quick (40 s)
	$(RUN) run --quick
	$(RUN) report --quick

test: install ## the tests, property tests in their quick profile (7 min)
	$(BIN)/python -m pytest -n auto

property: install ## the property tests as in CI: derandomised, no deadline, no database (2 min)
	RKVERIFY_HYPOTHESIS=ci $(BIN)/python -m pytest -n auto tests/property

fuzz: install ## the property tests, large and climbing, then searches for worst cases from SEED, printed where to be kept (20 min)
	RKVERIFY_HYPOTHESIS=fuzz $(BIN)/python -m pytest -n auto tests/property
	$(BIN)/python -m rkverify.certify.worst.catalogue $(or $(SEED),1)

check: install ## formatter, linter, types and import rules (20 s)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

lock: install ## write requirements.lock anew from pyproject.toml, for maintainers (needs uv; 10 s)
	uv pip compile pyproject.toml --extra dev --universal --python-version 3.11 --generate-hashes \
	  --no-emit-index-url --no-annotate --no-header --quiet --output-file requirements.lock
	for name in peers-build peers; do uv pip compile benchmarks/$$name.in --constraint benchmarks/peers-build.lock --universal \
	  --python-version 3.11 --generate-hashes --no-emit-index-url --no-annotate --no-header --quiet \
	  --output-file benchmarks/$$name.lock; done
	uv pip compile controls/mutants.in --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-annotate \
	  --no-header --quiet --output-file controls/mutants.lock

notebooks: install ## execute the notebooks into reports/notebooks, beside the pages that they link to (30 s)
	$(RUN) run
	$(RUN) report
	$(BIN)/python -m rkverify.report.notebooks

report: install ## build reports/index.html and its metadata from finished studies (3 s)
	$(RUN) report
	$(RUN) export --ro-crate

bench: install ## measure the arithmetics, shape functions beside pycompadre, kinematic updates and steps into reports/benchmarks (5 min)
	$(BIN)/python benchmarks/arithmetics.py
	$(BIN)/python benchmarks/shape_functions.py
	$(BIN)/python benchmarks/kinematic_update.py
	$(BIN)/python benchmarks/semi_lagrangian_step.py

peers: .venv-peers/installed ## build the packages we compare with and compute their numbers anew (5 min; 1 min later)
	.venv-peers/bin/python benchmarks/peers/run.py

# Two steps: pip builds from source without isolation, so that the tools of the build are pinned by hash as well.
.venv-peers/installed: benchmarks/peers.lock benchmarks/peers-build.lock
	$(PYTHON) -m venv .venv-peers
	.venv-peers/bin/python -m pip install --quiet --require-hashes --requirement benchmarks/peers-build.lock
	.venv-peers/bin/python -m pip install --quiet --require-hashes --no-build-isolation --requirement benchmarks/peers.lock
	touch $@

controls: install ## deliberate faults, each in a copy of the checkout, and which test catches it; reports/controls/controls.csv (15 min)
	$(BIN)/python -m controls.run

mutants: install .venv-mutants/installed ## mutation score of paper/, solid/ and stability/ on a seeded sample; reports/controls/mutants.csv (60 min)
	$(BIN)/python -m controls.mutants

.venv-mutants/installed: controls/mutants.lock
	$(PYTHON) -m venv .venv-mutants
	.venv-mutants/bin/python -m pip install --quiet --require-hashes --requirement controls/mutants.lock
	touch $@

clean: ## remove .venv, caches and built pages; committed results stay (1 s)
	rm -rf .venv .rkverify .mypy_cache .ruff_cache .import_linter_cache .hypothesis reports/*.html reports/*.js reports/*.css reports/ro-crate-metadata.json \
	  reports/notebooks reports/benchmarks
