# Koksma's front door: every target sets up what it needs (Debian packages) and says what it does.
#
#   make demo      install what is missing, build, reproduce both papers' tables and figures, say where the report is
#   make test      build with sanitizers and with clang, run all tests
#   make bench     speeds, each beside what it is compared with
#   make install   install the release build (PREFIX=/usr/local, DESTDIR=), run ldconfig without a DESTDIR
#   make explorer  one HTML file for a browser: patterns, measures and their witnesses, live
#   make docs      a page for every pattern, measure, scene, .. in build/docs, with pictures
#   make deb       Debian packages in build/deb, checked by lintian
#   make help      this list

PREFIX ?= /usr/local
DEMO ?= demo
TRIALS ?=

.PHONY: help demo test bench install docs explorer deb release clean

help:
	@sed -n 's/^#   //p' Makefile

release:
	@scripts/setup build
	@cmake --preset release -G Ninja -DCMAKE_INSTALL_PREFIX=$(PREFIX) -DBUILD_TESTING=OFF >/dev/null
	@cmake --build --preset release

demo: release
	build/release/koksma reproduce shirley1991 mitchell1992 --papers-only -o $(DEMO) $(if $(TRIALS),--trials $(TRIALS),--quick)

test:
	@scripts/setup build test
	@scripts/setup explorer browser || echo "make test: without emcc and Chromium; the tests that want them are skipped" >&2
	@scripts/test

bench: release
	@scripts/bench

install: release
	cmake --install build/release
	@test -n "$(DESTDIR)" || PATH=$$PATH:/usr/sbin:/sbin ldconfig 2>/dev/null || \
	  echo "make install: ldconfig did not run, which takes root: until it does, LD_LIBRARY_PATH must name the folder of libkoksma.so" >&2

explorer:
	@scripts/setup explorer
	@scripts/explorer

docs: release
	@tools/make_docs.py build/release/koksma build/docs

deb:
	@scripts/setup build deb
	@scripts/deb

clean:
	rm -rf build demo
