# Both commands do all their own set-up on a bare machine, once:
#   make demo   a forest edge in a gust: windswept-demo.mp4 and .png, or a live window where there is a display
#   make test   lint, types, import contracts and the whole test suite

PYTHON ?= python3
BIN := .venv/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check

.PHONY: demo test check format clean

demo: .venv/.installed
	$(BIN)/windswept doctor --mend
	$(BIN)/windswept demo

test: .venv/.installed-dev
	$(BIN)/windswept doctor --mend
	$(MAKE) --no-print-directory check
	$(BIN)/python -m pytest

check: .venv/.installed-dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: .venv/.installed-dev
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

# Debian's python3 without python3-venv makes an environment without pip and fails: that is removed, also if it is
# left over from before.
.venv/.made:
	@if ! $(BIN)/python -m pip --version >/dev/null 2>&1; then \
		rm -rf .venv; \
		$(PYTHON) -m venv .venv >/dev/null || { \
			rm -rf .venv; \
			echo "no virtual environment could be made; on Debian and Ubuntu: apt-get install python3-venv" >&2; \
			exit 1; \
		}; \
	fi
	@touch $@

.venv/.installed: pyproject.toml constraints.txt | .venv/.made
	$(PIP) install --quiet --constraint constraints.txt --editable '.[view]'
	touch $@

.venv/.installed-dev: pyproject.toml constraints.txt | .venv/.made
	$(PIP) install --quiet --constraint constraints.txt --editable '.[view,dev]'
	touch $@ .venv/.installed

clean:
	rm -rf .venv build dist src/*.egg-info .mypy_cache .ruff_cache .pytest_cache .import_linter_cache
