#!/bin/sh
# Which directory uses which (tools/layers.py), which file may include which outside library, lengths and licences of
# files, citations.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lint/files.sh
failed=0
complain() { echo "$1"; failed=$((failed + 1)); }

# Directories, cycles of files, and where things are declared; the drawing shows what the code has.
python3 -B tools/layers.py check || failed=$((failed + 1))
python3 -B tools/layers.py draw - | cmp -s - docs/pictures/layers.svg ||
  complain "docs/pictures/layers.svg is not what the code has: run 'tools/layers.py draw docs/pictures/layers.svg'"

# The explorer is a program like others.
grep -nE '#include "' explorer/*.c && complain "explorer/ includes include/koksma/ only"

# One outside library, one source file.
only() {
  others=$(grep -rlE "#include <$1" src cli include | grep -vxF "$2")
  for file in $others; do complain "$file includes <$1; only $2 may"; done
}
only 'png\.h' src/files/image/png.c
only 'zlib\.h' src/files/meshes/mesh_serialized.c
only 'openexr\.h' src/files/image/exr_openexr.c
only 'OpenEXR/' src/files/image/exr_openexr.c
only 'jpeglib\.h' src/files/image/jpeg_turbo.c
only 'cairo' src/lab/plot/cairo.c
only 'sqlite3\.h' src/lab/study/store/database.c
only 'jansson\.h' src/files/json/json.c
only 'embree' src/render/accel/accel_embree.c
only 'expat\.h' src/render/scene/xml.c
only 'mpi\.h' src/lab/study/run/transport_mpi.c
only 'Random123' src/engine/core/random.h

# Every source says its licence; no file is long without a reason at its top.
files 'src/*.[ch]' 'cli/*.[ch]' 'include/*.h' 'tests/*.[ch]' 'bench/*.[ch]' 'explorer/*.[ch]' '*.mjs' '*.cjs' |
  xargs awk '
    FNR == 1 { excused = 0; if (!/SPDX-License-Identifier: Apache-2.0/) print FILENAME ": no SPDX line" }
    FNR >= 2 && FNR <= 12 && tolower($0) ~ /long because/ { excused = 1 }
    FNR == 601 && !excused { print FILENAME ": over 600 lines without \"Long because ...\" at the top" }
  ' >/tmp/koksma-lint.$$
while read -r problem; do complain "$problem"; done </tmp/koksma-lint.$$
rm -f /tmp/koksma-lint.$$

# File names are unique in the tree, as a reader looks them up by name.
files '*.c' | xargs -n1 basename | grep -vx registry.c | sort | uniq -d | while read -r name; do echo "$name is in two folders"; done |
  grep . && failed=$((failed + 1))

# Every key cited in a table entry is in docs/references.bib.
for key in $(grep -rhoE '\.cite = "[^"]*"' src | sed 's/.*"\(.*\)"/\1/' | tr ' ' '\n' | grep -vx -e - | sort -u); do
  grep -q "^@[a-z]*{$key," docs/references.bib || complain "docs/references.bib has no $key"
done
echo "$failed problems"
[ "$failed" -eq 0 ]
