# The verbs: check (gates), test, bench, docs, demo.
.PHONY: check test test-all bench bench-check docs demo

check:            ## format, lint, types, import rules, frame letters
	uv run ruff format --check lpcal tests tools examples
	uv run ruff check lpcal tests tools examples
	uv run mypy
	uv run lint-imports
	uv run python tools/frame_letters.py lpcal

test:             ## the default tests, some six minutes on two cores
	uv run pytest

test-all:         ## the slow ones too
	uv run pytest -m "slow or not slow"

bench:            ## lpcal beside a peer on the same input
	uv run python tools/bench.py

bench-check:      ## speed and memory beside the committed table, docs/benchmarks.md
	uv run python tools/bench_speed.py --check

docs:             ## the README's tour, run and compared
	uv run pytest tests/house/test_readme.py -m "slow or not slow"

demo:             ## the whole chain on the bundled rig, into out/demo
	uv run lpcal demo out/demo
