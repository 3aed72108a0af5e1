#!/bin/sh
# exports.sh LIBKOKSMA LIBKOKSMA-LAB: the shared libraries show the functions that the headers declare with KOKSMA_API,
# every one and no other; what libkoksma-lab takes from libkoksma beside them has the private version.
set -u
cd "$(dirname "$0")/../.." || exit 1
declared=$(grep -hv '#define' include/koksma/*.h | tr '\n' ' ' | grep -oE 'KOKSMA_API [^(;]*\(' | sed 's/.*[ *]\(koksma_[a-z0-9_]*\)(/\1/' | sort)
shown=$(nm -D --defined-only "$1" "$2" | awk 'NF == 3 && $2 != "A" {print $3}' |
  grep -vE '^(___?(asan|odr_asan|ubsan|sanitizer|interceptor|lsan)|_edata|_end|__bss_start|_fini|_init)' | sort)
public=$(echo "$shown" | sed -n 's/@@KOKSMA_[0-9]*$//p')
rest=$(echo "$shown" | grep -vE '^koksma_[a-z0-9_]*@@KOKSMA_[0-9]*$|^koksma__[a-z0-9_]*@@KOKSMA_PRIVATE_[0-9.]*$')
code=0
[ -z "$rest" ] || { echo "symbols that nobody may see:" "$rest"; code=1; }
[ -n "$declared" ] && [ "$declared" = "$public" ] || {
  echo "declared and shown differ:"
  printf '%s\n' "$declared" >"/tmp/koksma-declared.$$"
  printf '%s\n' "$public" | diff "/tmp/koksma-declared.$$" -
  rm -f "/tmp/koksma-declared.$$"
  code=1
}
exit $code
