# Every target is one task of make.py, which needs only Python: on Windows, type `python -m make demo` instead.
PYTHON ?= python3

.DEFAULT_GOAL := help
.PHONY: demo web test bench studies nightly check docs clean help

demo: ## identify the example test, print the result, write the report
	@$(PYTHON) make.py demo

web: ## serve the pages, with a fleet to look at
	@$(PYTHON) make.py web

test: ## set up everything that the tests need and run all of them
	@$(PYTHON) make.py test

bench: ## time whole commands, the solver, campaigns, plans, programs, maps, paths, a history, pages (minutes)
	@$(PYTHON) make.py bench

studies: ## count how often each check of a verdict is right, and write docs/verdicts.md (half an hour)
	@$(PYTHON) make.py studies

nightly: ## the tests that take too long for every day, then the studies and a large history
	@$(PYTHON) make.py nightly

check: ## lint, format, types and import layers
	@$(PYTHON) make.py check

docs: ## build the documentation into docs/_build/html
	@$(PYTHON) make.py docs

clean: ## remove caches and built files; keep .venv and your results
	@$(PYTHON) make.py clean

help: ## show what each target does
	@$(PYTHON) make.py help
