# make demo    the main job on an example, with a result to look at
# make quick   the core's tests without the slow ones, for every step of work
# make test    all tests (make test-core, -algorithms, -cli, -gui and -real run a part)
# make test-release  what another release of QGIS, Python or numpy may change, beside `make test` on one
# make lint    check the style of the code
# make types   check the types of the core
# make judges  programs of others that judge lane maps, into build/judges
# make qt6     PyQt6, into build/qt6, for the trial of the plugin's face with Qt 6
# make package the zip for QGIS's plugin repository
# make docs    the documentation as a website, build/site
# make translations  bring the translations up to date and compile them
# make bench soak   table of speed and memory
# make ablate  what each correcting mechanism of the ledger brings (ROWS: rooms or rows)
# make clean   remove what was made, but not .venv

PYTHON := .venv/bin/python
PARTS := core algorithms cli gui real
# Expression by which pytest chooses tests of each part, and of the core: all where it is empty.
MARKS :=
CORE_MARKS := $(MARKS)
# Processes that share the tests of a part by files: 0 runs them one after another. The files with most slow tests begin
# (tests/conftest.py), so that short ones fill the end. Two virtual screens that start at once can take the same number,
# so tests/gui stays in one.
WORKERS := 2
PYTEST = $(PYTHON) -m pytest --dist loadfile --no-loadscope-reorder -n

# QGIS takes the home of its Python from the first python3 on the path, which may be another one.
export PATH := /usr/bin:/bin:$(PATH)
export QGIS_NO_OVERRIDE_IMPORT := 1

# Threads of the linear algebra wait for each other in loops, which takes a fifth of the time of tests that share the
# processors. Runs in QGIS take one as well; tests of what more threads do set their own.
test quick test-release $(PARTS:%=test-%): export OPENBLAS_NUM_THREADS := 1

.PHONY: setup judges qt6 demo quick test test-release lint types package docs translations bench soak ablate clean
.PHONY: $(PARTS:%=test-%)

setup:
	@scripts/setup.sh

# What the tests of lane maps call in, where it can be installed; without it they are left out.
judges: setup
	$(PYTHON) -c 'import sys, subprocess; subprocess.check_call([sys._base_executable, "-m", "venv", "build/judges"])'
	build/judges/bin/pip install -q -r requirements-judges.txt

# Beside .venv, not in it: PyQt5, which QGIS has, and PyQt6 do not go together. Without it its test is left out.
qt6: setup
	$(PYTHON) -m pip install -q --disable-pip-version-check --upgrade --target build/qt6 'PyQt6>=6.6'

demo: setup
	scripts/demo/demo.sh

# Parts in processes of their own: the core must work without QGIS. tests/gui is one process and leaves a processor
# free, so tests/real, one process too then, runs beside it and is shown when both have ended. Exit code 5: a part has
# no tests.
test: setup
	@mkdir -p build; status=0; \
	run() { \
		marks="$(MARKS)"; [ "$$2" != core ] || marks="$(CORE_MARKS)"; \
		echo "== tests/$$2"; $(PYTEST) $$1 -m "$$marks" tests/$$2 || [ $$? -eq 5 ]; \
	}; \
	for part in $(filter-out gui real,$(PARTS)); do run $(WORKERS) $$part || status=1; done; \
	if [ -n "$(filter real,$(PARTS))" ]; then run 0 real; fi >build/real.log 2>&1 & real=$$!; \
	run 0 gui || status=1; wait $$real || status=1; cat build/real.log; exit $$status

# Slow tests of the core and what is marked "once" tell nothing on a second release that they have not told on the
# first; the sample city's figures, every algorithm, the command line and the windows are there again.
test-release: setup
	$(MAKE) test PARTS="core algorithms cli gui" MARKS="not once" CORE_MARKS="not slow and not once"

$(PARTS:%=test-%): test-%: setup
	$(PYTEST) $(if $(filter gui,$*),0,$(WORKERS)) tests/$*

quick: setup
	$(PYTEST) $(WORKERS) -q -m "not slow" tests/core

lint: setup
	$(PYTHON) -m ruff check .

types: setup
	$(PYTHON) -m mypy --cache-dir build/mypy

package: docs
	$(PYTHON) scripts/package.py

docs: setup
	$(PYTHON) scripts/make_docs.py
	$(PYTHON) -m mkdocs build --quiet --strict

translations: setup
	$(PYTHON) scripts/make_translations.py

bench: setup
	$(PYTHON) scripts/bench.py

# Needs the demo city; nightly, or a room at a time.
ablate: setup
	$(PYTHON) scripts/ablate.py $(ROWS)

soak: setup
	$(PYTHON) scripts/soak.py build/soak

clean:
	rm -rf build demo .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -not -path './.venv/*' -prune -exec rm -rf {} +
