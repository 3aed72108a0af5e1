#!/bin/sh
# symbols.sh LIBRARY...: every symbol that a library defines for others begins with koksma_.
set -u
bad=$(nm -g --defined-only "$@" 2>/dev/null | awk 'NF == 3 && $3 !~ /^_?koksma_/ && $3 !~ /^__(asan|odr_asan|ubsan)/ {print $3}' | sort -u)
[ -z "$bad" ] || { echo "symbols without the prefix: $bad"; exit 1; }
