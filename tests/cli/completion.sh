#!/bin/sh
# completion.sh PROGRAM: the completion scripts and manual pages hold what the tables say, and bash, zsh, fish and man
# read them (those that are installed).
set -u
program=$(readlink -f "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$program" "$work/koksma"
PATH="$work:$PATH"
failed=0
complain() { echo "completion.sh: $1"; failed=1; }

bash_completes() { # expected word, then the words typed
  wanted=$1; shift
  bash -c 'source <(koksma completion bash); COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _koksma; printf "%s\n" "${COMPREPLY[@]}"' \
    bash "$@" | grep -qxe "$wanted" || complain "bash: '$*' does not give $wanted"
}
bash_completes generate koksma ge
bash_completes n-rooks koksma generate n-
bash_completes --seed koksma generate --se
bash_completes jittered koksma render ball -p jit
bash_completes ball koksma render b
bash_completes l2-star koksma measure points.txt --measures l2-
bash_completes scenes koksma list sc
for shell in zsh fish; do
  koksma completion $shell >"$work/script" || complain "no script for $shell"
  if command -v $shell >/dev/null; then $shell -n "$work/script" || complain "$shell can't read its script"; fi
done
if command -v fish >/dev/null; then
  fish --no-config -c "source $work/script; complete -C 'koksma generate n-ro'" | grep -q '^n-rooks' || complain "fish: n-rooks"
fi
for command in "" $(koksma --help | sed -n 's/^  \([a-z]*\)  *[a-z].*/\1/p'); do
  koksma manual $command >"$work/page" || complain "no page for '$command'"
  if command -v man >/dev/null; then
    man --warnings -E UTF-8 -l -Tutf8 -Z "$work/page" 2>&1 >/dev/null | grep . && complain "man can't read the page of '$command'"
  fi
  for option in $([ -z "$command" ] || koksma $command --help | grep -oE '^ +(-., +)?--[a-z-]+' | grep -oE '[a-z]+[a-z-]*$'); do
    sed 's/\\-/-/g' "$work/page" | grep -qe "--$option" || complain "the page of $command lacks --$option"
  done
done
[ $failed -eq 0 ]
