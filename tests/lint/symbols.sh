#!/bin/sh
# symbols.sh LIBRARY...: every symbol that a library defines for others begins with koksma_.
set -u
bad=$(nm -g --defined-only "$@" 2>/dev/null | awk 'NF == 3 && $3 !~ /^_?koksma_/ && $3 !~ /^__(asan|odr_asan|ubsan)/ {print $3}' | sort -u)
[ -z "$bad" ] || { echo "symbols without the prefix: $bad"; exit 1; }
# None calls a function of libm whose last bits differ between systems: core/elementary.h has its own.
bad=$(nm -gu "$@" 2>/dev/null | sed 's/@.*//' | awk '$NF ~ /^(a?(sin|cos|tan)h?|sincos|atan2|exp(2|10|m1)?|log(2|10|1p)?|pow|cbrt|hypot|erfc?|[lt]gamma(_r)?|[jy][01n])[fl]?$/ {print $NF}' | sort -u)
[ -z "$bad" ] || { echo "functions of libm: $bad"; exit 1; }
