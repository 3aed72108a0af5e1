#!/bin/sh
# Sources are as clang-format leaves them.
cd "$(dirname "$0")/../.." || exit 1
. tests/lint/files.sh
files '*.c' '*.h' | xargs clang-format --dry-run --Werror
