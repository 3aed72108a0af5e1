#!/bin/sh
# Sources are as clang-format leaves them, which breaks no comment: none of their lines has more than 124 characters.
cd "$(dirname "$0")/../.." || exit 1
. tests/lint/files.sh
failed=0
files '*.c' '*.h' | xargs clang-format --dry-run --Werror || failed=1
files '*.c' '*.h' | xargs grep -nE '^.{125}' && {
  echo "these lines have more than 124 characters"
  failed=1
}
exit $failed
