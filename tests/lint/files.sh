# Sourced by the lints. files GLOB...: the project's files whose path matches one of the globs, where * also matches `/`:
# what git has in a clone, and what lies there in an unpacked archive, which has no .git.
files() {
  if [ -e .git ]; then
    git ls-files -- "$@"
  else
    for glob in "$@"; do
      find . -type f -not -path './build/*' -path "./$glob" -printf '%P\n'
    done | sort -u
  fi
}
