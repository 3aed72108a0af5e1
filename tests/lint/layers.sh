#!/bin/sh
# The plan of the house: which folder may include which, which file may include which outside library.
set -u
cd "$(dirname "$0")/../.." || exit 1
failed=0
complain() { echo "$1"; failed=$((failed + 1)); }

# FOLDER: the folders below it in src/, which it may include beside itself. study/ is one folder for each of its parts.
below() {
  case $1 in
    core) ;;
    kernels | warps | json) echo "core" ;;
    stats) echo "core" ;;
    patterns) echo "core kernels stats" ;;
    measures) echo "core kernels warps" ;;
    verify) echo "core kernels patterns measures" ;;
    image) echo "core kernels stats" ;;
    meshes) echo "core json image" ;;
    scene) echo "core json image meshes warps" ;;
    plot) echo "core kernels patterns warps measures image scene" ;;
    render) echo "core kernels stats patterns warps measures image meshes scene" ;;
    study/plan) echo "core json render" ;;
    study/store) echo "core json study/plan" ;;
    study/run) echo "core json stats image scene render study/plan study/store" ;;
    study/ranking | study/images) echo "core stats image render study/plan study/store study/run" ;;
    study/report) echo "core stats image measures plot study/plan study/store study/run" ;;
    *) echo "$1 is a folder without a line in tests/lint/layers.sh" >&2 ;;
  esac
}
git ls-files 'src/*.[ch]' | sed -nE 's#^src/(study/[a-z_]+|[a-z_]+)/.*#\1#p' | sort -u | while read -r folder; do
  ok=" $folder $(below "$folder" 2>&1) "
  grep -rnoE '#include "(study/[a-z_0-9]+|[a-z_0-9]+)/' "src/$folder" --include='*.[ch]' | while IFS=: read -r file line include; do
    target=${include#*\"}
    target=${target%/}
    case "$ok" in *" $target "*) ;; *) echo "$file:$line: $folder may not include $target" ;; esac
  done
done >/tmp/koksma-lint.$$
while read -r problem; do complain "$problem"; done </tmp/koksma-lint.$$
rm -f /tmp/koksma-lint.$$

grep -nE '#include "[a-z_0-9]+/' cli/*.[ch] && complain "cli/ includes include/koksma/ only"

grep -nE '#include "' explorer/*.c && complain "explorer/ includes include/koksma/ only"

# One outside library, one source file.
only() {
  others=$(grep -rlE "#include <$1" src cli include | grep -vxF "$2")
  for file in $others; do complain "$file includes <$1; only $2 may"; done
}
only 'png\.h' src/image/png.c
only 'openexr\.h' src/image/exr.c
only 'OpenEXR/' src/image/exr_rgba.c
only 'cairo' src/plot/cairo.c
only 'sqlite3\.h' src/study/store/database.c
only 'jansson\.h' src/json/json.c
only 'embree' src/render/accel/accel_embree.c
only 'mpi\.h' src/study/run/transport_mpi.c
only 'Random123' src/core/random.h

# Every source says its licence; no file is long without a reason at its top.
git ls-files 'src/*.[ch]' 'cli/*.[ch]' 'include/*.h' 'tests/*.[ch]' 'bench/*.[ch]' 'explorer/*.[ch]' '*.mjs' '*.cjs' |
  xargs awk '
    FNR == 1 { excused = 0; if (!/SPDX-License-Identifier: Apache-2.0/) print FILENAME ": no SPDX line" }
    FNR >= 2 && FNR <= 12 && tolower($0) ~ /long because/ { excused = 1 }
    FNR == 601 && !excused { print FILENAME ": over 600 lines without \"Long because ...\" at the top" }
  ' >/tmp/koksma-lint.$$
while read -r problem; do complain "$problem"; done </tmp/koksma-lint.$$
rm -f /tmp/koksma-lint.$$

# File names are unique in the tree, as a reader looks them up by name.
git ls-files '*.c' | xargs -n1 basename | grep -vx registry.c | sort | uniq -d | while read -r name; do echo "$name is in two folders"; done |
  grep . && failed=$((failed + 1))

# Every key cited in a table entry is in docs/references.bib.
for key in $(grep -rhoE '\.cite = "[^"]*"' src | sed 's/.*"\(.*\)"/\1/' | tr ' ' '\n' | grep -vx -e - | sort -u); do
  grep -q "^@[a-z]*{$key," docs/references.bib || complain "docs/references.bib has no $key"
done
echo "$failed problems"
[ "$failed" -eq 0 ]
