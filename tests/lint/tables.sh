#!/bin/sh
# tables.sh CC: where lines of a table have numbers or kinds, their order means nothing: what the compiler makes of the
# table is the same with the lines from the last to the first. Tables that are lists (patterns, measures and the like)
# have lines of one name each, and what is listed is in their order; tests/test_tables.c has what they stand for.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lint/files.sh
cc=$1
folder=$(mktemp -d) || exit 4
trap 'rm -rf "$folder"' EXIT INT TERM
failed=0
complain() { echo "$1"; failed=1; }

# TABLE FOLDER SOURCE: SOURCE with the lines of FOLDER/TABLE as they are, and reversed.
same() {
  mkdir -p "$folder/turned/$(dirname "$1")"
  grep -E '^[A-Z_]+\(' "$2/$1" | tac >"$folder/turned/$1"
  [ "$(wc -l <"$folder/turned/$1")" -gt 1 ] || complain "$2/$1: no lines found"
  for way in "" "-I$folder/turned"; do
    $cc -std=c11 -O1 -S -D_XOPEN_SOURCE=700 $way -Iinclude -Isrc -Isrc/engine "$3" -o "$folder/${way:+turned}.s" ||
      complain "$3: does not compile"
  done
  cmp -s "$folder/.s" "$folder/turned.s" || complain "$2/$1: the order of its lines changes $3"
  rm -f "$folder"/*.s
}
same render/samples/uses.def src src/render/samples/uses.c
same koksma/status.def include src/engine/core/status.c

# Every other table is a list of names, a list of functions that structs call by name, or names and numbers that are
# made together.
for table in $(files 'src/*.def' 'cli/*.def' 'include/*.def'); do
  case $table in
    */uses.def | */status.def) ;;
    */patterns.def | */measures.def | */integrands.def | */metrics.def | */materials.def | */lights.def | */shapes.def | */adaptive.def | */formats.def | \
      */commands.def | */methods.def | */sections.def) grep -nE '^[A-Z]+\([^)]*,' "$table" && complain "$table: lines of more than a name" ;;
    */kernels.def | */batch.def | */file_kinds.def | */palette.def | */keys.def | */keys_4d.def | */keys_4d_single.def | */keys_4d_four.def) ;;
    */properties.def | */claims.def | */curves.def | */questions.def | */conclusions.def) ;;
    *) complain "$table: a table that tests/lint/tables.sh doesn't know" ;;
  esac
done
exit $failed
