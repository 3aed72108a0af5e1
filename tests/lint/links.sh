#!/bin/sh
# Links of the documents lead to files, and so do the paths that they name between backticks, and the documents that
# comments name.
cd "$(dirname "$0")/../.." || exit 1
. tests/lint/files.sh
in_comments() {
  files '*' | grep -v '\.md$' | tr '\n' '\0' | xargs -0 grep -HIoE 'docs/[A-Za-z0-9_/-]+\.md' | sort -u | while IFS=: read -r file path; do
    [ -e "$path" ] || echo "$file: no file $path"
  done
}
in_documents() {
  files '*.md' | while read -r file; do
    folder=$(dirname "$file")
    grep -oE '\]\([^)#: ]+\)' "$file" | sed 's/](\(.*\))/\1/' | while read -r link; do
      [ -e "$folder/$link" ] || echo "$file: no file $link"
    done
    grep -oE '`(docs|src|cli|tests|scripts|examples|explorer|fuzz|cmake|include|python|tools|studies|scenes)/[A-Za-z0-9_./-]+`' "$file" | tr -d '`' |
      while read -r path; do
        case $path in *my_* | *my-*) continue ;; esac
        [ -e "$path" ] || echo "$file: no file $path"
      done
  done
}
{ in_comments; in_documents; } | grep . && exit 1
exit 0
