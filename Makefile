# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# A thin wrapper: each target is a few lines one can as well type. The presets are in CMakePresets.json.
.DEFAULT_GOAL := help
.PHONY: help deps build demo test test-sanitizers test-threads bench fuzz format lint docs clean
SHELL := /bin/bash

JOBS := $(shell nproc)
# What the configuring step of `make build` and `make test` is given besides, e.g. -DCUSP_PRECOMPILE=ON.
CMAKE_ARGS ?=
# Rooms whose tests also run under the sanitizers in `make test`: those that read what strangers wrote.
PARSER_ROOMS := base toolpath kinematics post
# Of these, what reads nothing: numbers and campaigns that take minutes there.
SANITIZER_SKIPS := dynamics|post_verify_campaign|kinematics.Laws
# Rooms whose threads the thread sanitizer watches: those without TBB, of which it reports races that are none.
THREAD_ROOMS := comm
# What `make demo` posts: the example path, and a real CL file where the folder of real files lies beside the project.
CL ?= examples/benchmark/surface_finish.cls $(wildcard ../shared/data/cl/nx_variable_axis.cls)
# Seconds `make fuzz` spends on each fuzzer.
FUZZ_SECONDS ?= 300

help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

deps: ## Install the Debian packages that are absent (root, or sudo without a password)
	scripts/deps.sh build test

build: ## Build everything (release)
	cmake --preset release $(CMAKE_ARGS)
	cmake --build --preset release -j$(JOBS)

demo: ## Install what is absent, build, turn CL files (CL=…) into proven 840D programs, and close the loop once: out/demo/index.html
	scripts/deps.sh build
	cmake --preset release
	cmake --build --preset release --target cusp_cli -j$(JOBS)
	scripts/demo.sh build/release/bin/cusp out/demo $(CL)

test: ## Install what is absent, then all tests: readers and fuzzers under sanitizers, the whole suite last
	$(MAKE) --no-print-directory deps
	$(MAKE) --no-print-directory test-sanitizers
	$(MAKE) --no-print-directory build
	ctest --preset release -j$(JOBS)

test-sanitizers: ## The readers' tests and a short run of every fuzzer, address and undefined-behaviour sanitizers on (clang 19)
	cmake --preset fuzz $(CMAKE_ARGS)
	cmake --build --preset fuzz --target fuzzers $(PARSER_ROOMS:%=tests_%) -j$(JOBS)
	ctest --test-dir build/fuzz -L '^(fuzz|$(subst $(eval ) ,|,$(PARSER_ROOMS)))$$' -E '^($(SANITIZER_SKIPS))\.' --output-on-failure -j$(JOBS)

test-threads: ## The tests of what runs in threads of its own under the thread sanitizer
	cmake --preset tsan
	cmake --build --preset tsan --target $(THREAD_ROOMS:%=tests_%) -j$(JOBS)
	ctest --preset tsan -L '^($(subst $(eval ) ,|,$(THREAD_ROOMS)))$$' -j$(JOBS)

bench: ## Build and run the benchmarks
	scripts/deps.sh build bench
	cmake --preset bench
	cmake --build --preset bench -j$(JOBS)
	cmake --build --preset bench --target run_benchmarks

fuzz: ## Run every fuzzer for FUZZ_SECONDS each; findings stay in build/fuzz
	scripts/deps.sh build test
	cmake --preset fuzz -DCUSP_FUZZ_RUNS=-1 -DCUSP_FUZZ_SECONDS=$(FUZZ_SECONDS)
	cmake --build --preset fuzz -j$(JOBS)
	ctest --preset fuzz -j$(JOBS); status=$$?; \
	  cmake --preset fuzz -UCUSP_FUZZ_RUNS -UCUSP_FUZZ_SECONDS >/dev/null; exit $$status

format: ## Format every tracked source file in place
	scripts/deps.sh lint
	scripts/format.sh

lint: ## clang-tidy over every source file; warnings are errors
	scripts/deps.sh build lint
	scripts/lint.sh

docs: ## Write the pages made from the schemas (docs/*.md), and the reference of the public headers in build/docs
	scripts/deps.sh build docs
	cmake --preset release
	cmake --build --preset release --target cusp_cli -j$(JOBS)
	set -e; for page in $$(build/release/bin/cusp schema); do build/release/bin/cusp schema $$page > docs/$$page.md; done
	mkdir -p build/docs
	doxygen docs/Doxyfile

clean: ## Remove what was built (build/ and out/)
	rm -rf build out
