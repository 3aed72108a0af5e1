#!/bin/sh
# systems.sh CLANG INCLUDE: the headers that other programs include compile for Windows (MSVC and MinGW), macOS, wasm and musl,
# as the oldest and a new C and C++, without warnings. No system's own headers are needed: those of the C library that these
# headers include are declared here as far as they use them. Exit code 77: no clang.
set -u
clang=$1 include=$2
"$clang" --version 2>/dev/null | grep -q clang || { echo "skipped: $clang is not clang"; exit 77; }
libc=$(mktemp -d)
trap 'rm -rf "$libc"' EXIT
c='#ifdef __cplusplus\nextern "C" {\n#endif\n' end='#ifdef __cplusplus\n}\n#endif\n'
printf "#include <stddef.h>\n${c}void *memcpy(void *to, const void *from, size_t n);\nint strcmp(const char *a, const char *b);\n$end" >"$libc/string.h"
printf "${c}double floor(double);\ndouble sqrt(double);\ndouble fmod(double, double);\nfloat sqrtf(float);\ndouble fabs(double);\ndouble sin(double);\ndouble cos(double);\n$end" >"$libc/math.h"
failed=0 compiled=0
for target in x86_64-pc-windows-msvc aarch64-pc-windows-msvc x86_64-pc-windows-gnu arm64-apple-macos11 x86_64-apple-macos11 \
  wasm32-unknown-unknown aarch64-linux-musl; do
  for header in sampler keys mask koksma; do
    for language in c99 c17 c++98 c++20; do
      family=${language%%[0-9]*}
      "$clang" -target $target -ffreestanding -nostdlibinc -isystem "$libc" -x "$family" -std=$language -Wall -Wextra -pedantic \
        -Werror -Wno-unused-function -Wno-long-long -Wno-c++11-long-long -fsyntax-only "-I$include" "$include/koksma/$header.h" || {
        echo "$header.h, $target, $language"
        failed=$((failed + 1))
      }
      compiled=$((compiled + 1))
    done
  done
done
echo "$compiled compilations, $failed failed"
[ "$failed" -eq 0 ]
