#!/bin/sh
# macros.sh CC INCLUDE: the public headers define and undefine macros of their own prefix only, and leave a program's
# macros alone, whatever they are called; sampler.h has the sizes of arrays checked.
set -u
cc=$1 include=$2
failed=0
others=$(grep -nE '^ *# *(define|undef) +[A-Za-z_0-9]+' "$include"/koksma/* | grep -vE '# *(define|undef) +KOKSMA_')
[ -z "$others" ] || { echo "$others: no prefix KOKSMA_"; failed=1; }

# A program that has a macro of every name that the headers put together or might use for a moment.
names="X N OK DIM IO ARGUMENT UNKNOWN IMPOSSIBLE MISSING MALFORMED MEMORY SYSTEM UNSUPPORTED INTERRUPTED FORBIDDEN STATUS NAME"
for language in c c++; do
  {
    for name in $names; do echo "#define $name 4711 - 0"; done
    for header in "$include"/koksma/*.h; do echo "#include <koksma/$(basename "$header")>"; done
    echo "typedef char all[2 * (sizeof(int) > 0 && KOKSMA_INTERRUPTED == 12 && KOKSMA_STATUS_COUNT == 14"
    for name in $names; do echo " && ($name) == 4711"; done
    echo ") - 1];"
    for name in $names KOKSMA_VERSION; do printf '#ifndef %s\n#error %s is gone\n#endif\n' "$name" "$name"; done
    printf '#ifdef %s\n#error %s is left\n#endif\n' KOKSMA_STATUS KOKSMA_STATUS KOKSMA_CLAIM KOKSMA_CLAIM
  } | $cc -x $language -I"$include" -Wall -Wextra -Werror -Wno-unused -fsyntax-only - || failed=1
done

# A C compiler warns about an array that is shorter than what a function of sampler.h fills.
for size in 2 3; do
  printf '#include <koksma/sampler.h>\nfloat f(void) { float xs[%s]; koksma_sobol_3f(koksma_domain_of_pixel(1, 2, 3), 0, xs); return xs[0]; }\n' $size |
    $cc -x c -I"$include" -O2 -Wall -Werror -c -o /dev/null - 2>/dev/null
  [ $? -eq 0 ] && accepted=3 || accepted=2
  [ $accepted = $size ] || { echo "an array of $size numbers for koksma_sobol_3f is wrongly judged"; failed=1; }
done

# What the preprocessor knows after all headers, less what it knew after those of the system that they include.
system=$(grep -hE '^ *# *include <' "$include"/koksma/*.h | grep -v '<koksma/' | sort -u)
known=$(mktemp) && all=$(mktemp) || exit 4
trap 'rm -f "$known" "$all"' EXIT INT TERM
echo "$system" | $cc -x c -dM -E - | sort >"$known"
{
  echo "$system"
  for header in "$include"/koksma/*.h; do echo "#include <koksma/$(basename "$header")>"; done
} | $cc -x c -I"$include" -dM -E - | sort >"$all"
grep -q KOKSMA_VERSION "$all" || { echo "the headers define nothing"; failed=1; }
more=$(comm -13 "$known" "$all" | grep -v '^#define KOKSMA_')
[ -z "$more" ] || { echo "$more: no prefix KOKSMA_"; failed=1; }
exit $failed
