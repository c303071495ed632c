# The front door. On a bare Debian 12 machine, `make demo` and `make test` each set up all they need.
SHELL := /bin/bash
.DEFAULT_GOAL := help

PACKAGES := g++ cmake ninja-build ccache pkg-config git ca-certificates \
  libopenexr-dev libopenimageio-dev openimageio-tools libassimp-dev libembree-dev libcli11-dev nlohmann-json3-dev libssl-dev zlib1g-dev libcsv-dev libboost-dev \
  libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers glslang-tools spirv-tools \
  libgtest-dev libbenchmark-dev glmark2-data assimp-testmodels \
  python3 python3-jsonschema python3-numpy python3-matplotlib python3-selenium help2man \
  snakemake slurm-wlm munge chromium chromium-driver
LINT_PACKAGES := clang-format clang-tidy

PRESET ?= release
BUILD := build/$(PRESET)
JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
PYTHON ?= /usr/bin/python3
SOURCES = $(shell git ls-files 'apps/*.cpp' 'libs/*.cpp' 'libs/*.h' 'tests/*.cpp' 'tests/*.h' 'shaders/interop/*.h')

.PHONY: help setup setup-lint configure build demo test experiment paper bench flicker stress atlas asan tidy format format-check install golden-update clean

help: ## show this list
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

setup: ## install the Debian packages that are missing
	@configs/workflow/setup.sh $(PACKAGES)

setup-lint:
	@configs/workflow/setup.sh $(LINT_PACKAGES)

configure: setup
	@cmake --preset $(PRESET) -Wno-dev $(if $(wildcard $(BUILD)/CMakeCache.txt),> /dev/null)

build: configure ## build everything: tools, tests, benchmark, manual
	@cmake --build --preset $(PRESET) -j $(JOBS)

demo: configure ## build the tools, run the chain on the demo scenes into out/demo, print the stages
	@cmake --build --preset $(PRESET) -j $(JOBS) --target tools
	@$(PYTHON) configs/workflow/demo.py --bin $(BUILD)/bin --output out/demo

test: build ## build and run every test
	@cd $(BUILD) && VSGL_VALIDATION=1 ctest --output-on-failure --no-tests=error -j $(JOBS)

# JOBS there means tools at once, and more than one disturbs the times; ARGS goes to snakemake.
NAME ?= error-vs-time
experiment: EXPERIMENT_JOBS = $(if $(filter command line environment,$(origin JOBS)),$(JOBS),1)
experiment: configure ## run configs/experiments/NAME.json into out/experiments/NAME (JOBS=n at once; ARGS for snakemake)
	@cmake --build --preset $(PRESET) --target tools
	@$(PYTHON) configs/workflow/experiment.py configs/experiments/$(NAME).json --bin $(BUILD)/bin \
	  --output out/experiments/$(NAME) --jobs $(EXPERIMENT_JOBS) --snakemake="$(ARGS)"

paper: configure ## reproduce the papers' figures and tables into out/paper (ARGS=--quick; ARGS="--only fig-2016-1")
	@cmake --build --preset $(PRESET) -j $(shell nproc) --target tools
	@$(PYTHON) configs/workflow/paper.py --bin $(BUILD)/bin --output out/paper $(ARGS)

bench: build ## time the shading kernel against native code, the demo chain stage by stage, and error against time of a small experiment
	@$(PYTHON) configs/workflow/bench.py --bin $(BUILD)/bin --output out/bench

flicker: configure ## render and trace 64 frames of a moving light into out/flicker: how the methods flicker, where they pop
	@cmake --build --preset $(PRESET) -j $(JOBS) --target tools
	@$(PYTHON) configs/workflow/flicker.py --bin $(BUILD)/bin --output out/flicker

atlas: configure ## errors of the lobe models over their whole range, float32 against quadrature, as heat maps into out/atlas
	@cmake --build --preset $(PRESET) -j $(JOBS) --target stability_atlas report
	@$(PYTHON) tests/stability/atlas.py --bin $(BUILD)/bin --output out/atlas

stress: configure ## drive the tools through extremes into out/stress (ARGS=--quick; ARGS="--groups place")
	@cmake --build --preset $(PRESET) -j $(shell nproc) --target tools stress_twin
	@$(PYTHON) configs/workflow/stress.py --bin $(BUILD)/bin --output out/stress $(ARGS)

asan: ## the test run under AddressSanitizer and UndefinedBehaviorSanitizer
	@$(MAKE) --no-print-directory build PRESET=asan
	@cd build/asan && VSGL_VALIDATION=1 LSAN_OPTIONS=suppressions=$(CURDIR)/tests/lsan.supp ctest --output-on-failure --no-tests=error -j $(JOBS) -LE 'perf|experiment|browser'

tidy: setup setup-lint ## clang-tidy over the whole tree
	@$(MAKE) --no-print-directory build PRESET=tidy

format: setup-lint ## clang-format the tree in place
	@clang-format -i $(SOURCES)

format-check: setup-lint ## fail where clang-format would change something
	@clang-format --dry-run -Werror $(SOURCES)

install: build ## install tools, man pages and completion below PREFIX (default /usr/local)
	@cmake --install $(BUILD) --prefix $(PREFIX)

golden-update: build ## write the golden images anew from this build; look at the differences before you commit
	@$(PYTHON) tests/golden/golden.py --bin $(BUILD)/bin --update

clean: ## remove build and output folders
	@rm -rf build out
