# Koksma's entry points. Each target installs the Debian packages that it needs and then does what its line says.
#
#   Use
#   make demo        build; reproduce the tables and figures of two papers; print where the report is (4 to 5 minutes on 2 cores)
#                    DEMO=DIR: where (demo); TRIALS=N: trials for each table row (fewer than in the papers)
#   make install     install the release build; PREFIX=/usr/local, DESTDIR= as usual
#   make explorer    build the page for a browser: build/explorer/koksma-explorer.html
#   make masks       make blue-noise masks for common filters, 64 to 256 pixels, with their errors: build/masks (10 minutes)
#   make experiment  search sets for 15 targets, render them, and compare what they win: docs/findings/optimised.md (half an hour of
#                    one core); SEED=R: another one; QUICK=1: 3 minutes, no page. Interrupted, it continues
#   make docs        write the documents to build/docs: tutorial, commands, C and Python reference, a page for every pattern,
#                    measure, scene, ..., findings; with the explorer if it is built
#   make paper       write the paper on optimised sets to build/paper/paper.pdf, from the stored rows
#
#   Develop
#   make release     build the optimised program: build/release/koksma
#   make check       for daily work, under 2 minutes from a warm build: unit tests, claims of the patterns that changed,
#                    tests of the directories that changed, lint; BASE=main: changed since that branch
#   make test        what guards a change, as continuous integration runs it: optimised, and readers and kernels with sanitizers
#   make test-all    every test, optimised and with sanitizers, lean builds, another machine, packages: before a release
#   make bench       print a table of speeds beside peers and an older commit (bench/speed.py), in about 10 minutes
#   make clean       remove build/ and demo/
#
#   Release
#   make dist        write build/dist/koksma-VERSION.tar.gz; the same commit gives the same bytes
#   make dist-test   build and test from that archive, in an empty directory without git
#   make wheel       build a self-contained Python wheel, and try it with the newest NumPy and SciPy
#   make targets     build wheels for other systems than this one, and a static program: build/targets; TAGS="win_amd64"
#   make npm         build the package @koksma/koksma for Node and browsers: build/npm
#   make deb         write Debian packages to build/deb and check them with lintian
#   make cross       build for aarch64 and run the tests of libkoksma under qemu; MACHINES="aarch64 s390x i686"
#                    MACHINES=windows: by mingw-w64, with the tests of commands, under wine
#   make same-bits   compare all patterns, measures, warps and scenes on Linux, Windows, ARM, s390x and WebAssembly
#
#   make help        print this list
#
# One test, a debugger, sanitizers, a profiler: CONTRIBUTING.md has the commands.

PREFIX ?= /usr/local
DEMO ?= demo
TRIALS ?=
BASE ?= main
MACHINES ?= aarch64
TAGS ?=
SEED ?= 1
QUICK ?=

.PHONY: help experiment demo check test test-all bench install masks docs paper explorer wheel targets npm deb dist dist-test cross same-bits release clean

help:
	@sed -n 's/^#   //p; s/^#$$//p' Makefile | sed '1{/^$$/d}'

release:
	@scripts/setup build
	@cmake --preset release -G Ninja -DCMAKE_INSTALL_PREFIX=$(PREFIX) -DBUILD_TESTING=OFF >/dev/null
	@cmake --build --preset release

demo: release
	build/release/koksma reproduce shirley1991 mitchell1992 --papers-only -o $(DEMO) $(if $(TRIALS),--trials $(TRIALS),--quick)

check:
	@scripts/setup build test
	@scripts/check $(BASE)

test:
	@scripts/setup build test
	@scripts/setup browser || echo "make test: Chromium is missing; the tests that need it are skipped" >&2
	@scripts/test

test-all:
	@scripts/setup build test
	@scripts/setup explorer browser || echo "make test-all: emcc or Chromium is missing; the tests that need it are skipped" >&2
	@scripts/test clang dev
	@scripts/test-lean
	@scripts/setup cross
	@scripts/cross $(MACHINES)
	@$(MAKE) deb

bench: release
	@scripts/bench

masks: release
	@scripts/masks build/release/koksma build/masks

experiment: release
	@scripts/setup test
	/usr/bin/python3 tools/optimised.py --koksma build/release/koksma -o build/experiment --seed $(SEED) $(if $(QUICK),--quick,--keep)
	$(if $(QUICK),,/usr/bin/python3 tools/optimised_models.py -o docs/findings/optimised.json)

install: release
	cmake --install build/release
	@test -n "$(DESTDIR)" || PATH=$$PATH:/usr/sbin:/sbin ldconfig 2>/dev/null || \
	  echo "make install: ldconfig did not run (it needs root); until it does, LD_LIBRARY_PATH must name the directory of libkoksma.so" >&2

explorer:
	@scripts/setup explorer
	@scripts/explorer

paper: release
	@scripts/paper

docs: release
	@scripts/setup docs
	@tools/make_docs.py build/release/koksma build/docs

dist:
	@scripts/dist

dist-test:
	@scripts/setup build test
	@scripts/dist-test

wheel:
	@scripts/setup build
	@scripts/wheel

targets:
	@scripts/setup build cross
	@scripts/targets $(TAGS)

npm:
	@scripts/setup explorer
	@scripts/npm

deb:
	@scripts/setup build deb
	@scripts/deb

cross:
	@scripts/setup build test cross
	@scripts/cross $(MACHINES)

same-bits: release
	@scripts/setup cross explorer
	@scripts/same-bits

clean:
	rm -rf build demo
