#!/bin/sh
# completion.sh PROGRAM: the completion scripts and manual pages hold what the tables say, and bash, zsh, fish and man
# read them (those that are installed); what bash offers, the others get by the same words.
set -u
program=$(readlink -f "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$program" "$work/koksma"
PATH="$work:$PATH"
failed=0
complain() { echo "completion.sh: $1"; failed=1; }

# ---- What bash offers: its script runs beside stand-ins for the shell's own functions ----
# A case is a line, ^ where the cursor stands, and the words that are offered; FILES: files when none of them fits.
cat >"$work/bash.driver" <<'END'
source "$1"
compopt() { [ "$*" = "-o nospace" ] || no_files=1; }
while IFS= read -r line; do
  typed=${line%^} no_files=''
  COMP_LINE="koksma $typed" COMP_POINT=$((${#typed} + 7)) COMP_WORDBREAKS=$' \t\n=:'
  _koksma
  echo "$line" "${COMPREPLY[@]##*,}" ${no_files:-FILES}
done | sed 's/ 1$//'
END
mkdir "$work/empty"
touch "$work/empty/a-file"
modifiers=$(koksma list modifiers | sed 1d | awk '{ printf "%s= ", $1 }')
all() { koksma list "$1" | sed 1d | cut -d' ' -f1 | tr '\n' ' '; }
properties=$({ koksma verify random@16; koksma verify random@16 --seeds 32; } | grep -v ^source | awk '{ print $4 }' | sort -u | tr '\n' ' ')
grep -v '^$' >"$work/cases" <<END
generate ^ $(all patterns)
generate n-r^ n-rooks
generate x --progress ^ auto always never
generate x -n ^
generate x -o ^ FILES
measure ^ FILES
measure x -m ^ all $(all measures)
measure x --measures star,l2-st^ l2-star
measure x --warp ^ $(all warps)
measure x --prefixes ^ powers
curve ^ power rings quality screen pairs prefixes prefix-ratios
curve power ^ FILES
curve power x --half ^
verify ^ FILES
verify x -e ^ $properties
verify x --expect latin,prog^ progressive
plot x -c ^ points power rings anisotropy pairs prefix-ratios convergence compare filter filter-response
plot x --witness ^ $(all measures)
plot x -o ^ FILES
render ^ $(all scenes) FILES
render ball -p jit^ jittered
render ball --pairing ^ shuffled aligned native
render ball --scope ^ pixel image
render ball --lights ^ all one power uniform auto
render ball --integrator ^ $(all integrators)
render ball --filter ^ $(all filters)
render ball --adaptive ^ $(all adaptive)
render ball --strata ^ FILES
render ball --depth ^
scene ^ check
scene check ^ $(all scenes) FILES
compare ^ FILES
compare a b --max-mean ^
rank ^ $(all scenes) FILES
rank ball --patterns ^ modern thesis later all $(all patterns)
measure x -p ^ all $(all patterns)
render ball -p sobol:sc^ scramble=
generate sobol:^ scramble= numbers= shuffle= $modifiers
generate random:^ $modifiers
generate sobol:scramble=owen,dig^ digital-shift=
render ball -p sobol:scramble=^ none digital-shift lms owen hash-owen
render ball -p lens=sobol:scramble=ow^ owen
render ball -p sobol:scramble=owen,nu^ numbers=
rank ball -p random,sobol:numbers=^ joe-kuo bratley-fox groups
measure x -m star,l2-disk:^ $(koksma list parameters --json | sed -n 's/.*"of":"l2-disk","parameter":"\([^"]*\)".*/\1=/p' | tr '\n' ' ')
measure pattern:n-r^ n-rooks
rank ball --patterns later,n-r^ n-rooks
rank ball --spp ^
rank ball --with ^ mitsuba FILES
study ^ run new export report audit
study run ^ shirley1991 mitchell1992 open-questions literature-scenes FILES
study export ^ FILES
study export x --format ^ csv json sha256
study export x --format=js^ json
reproduce ^ shirley1991 mitchell1992 open-questions literature-scenes FILES
reproduce shirley1991 --table ^ all none
reproduce shirley1991 -o ^ FILES
list ^ patterns modifiers measures integrands estimators intervals claims properties warps curves scenes materials lights shapes formats integrators pipelines filters uses metrics adaptive methods records plans questions sections parameters
list patterns ^
completion ^ bash zsh fish words
manual scen^ scene
help scen^ scene
help -^ -h --help
version ^
END
sort_words() { awk '{ at = index($0, "^"); n = split(substr($0, at + 1), w, " "); printf "%s", substr($0, 1, at)
  while (n > 0) { m = 1; for (i = 2; i <= n; i++) if (w[i] < w[m]) m = i; printf " %s", w[m]; w[m] = w[n--] }; print "" }'; }
sort_words <"$work/cases" >"$work/wanted"
sed 's/^\([^^]*^\).*/\1/' "$work/cases" >"$work/lines"
for shell in bash zsh fish; do
  koksma completion $shell >"$work/script" || complain "no script for $shell"
  ! command -v $shell >/dev/null || $shell -n "$work/script" || complain "$shell can't read its script"
done
koksma completion bash >"$work/script"
(cd "$work/empty" && bash --norc "$work/bash.driver" "$work/script" <"$work/lines") 2>&1 | sort_words | sed -E ':a; s/(\^.*) [^ ]*[:,=]([^ :,=]+=?)( |$)/\1 \2\3/; ta' >"$work/offers"
diff "$work/wanted" "$work/offers" >"$work/difference" || complain "bash offers other words (>) than wanted (<): $(cat "$work/difference")"
# The words of choices are the program's own.
for option in pairing scope lights; do
  said=$(koksma render ball --$option x -o x.pfm 2>&1 | sed 's/.* it takes //; s/,//g; s/ or / /')
  grep -qxF "render ball --$option ^ $said" "$work/cases" || complain "--$option takes $said"
done
for command in "" $(koksma --help | sed -n 's/^  \([a-z]*\)   *[a-z].*/\1/p'); do
  koksma manual $command >"$work/page" || complain "no page for '$command'"
  if command -v man >/dev/null; then
    man --warnings -E UTF-8 -l -Tutf8 -Z "$work/page" 2>&1 >/dev/null | grep . && complain "man can't read the page of '$command'"
  fi
  for option in $([ -z "$command" ] || koksma $command --help | grep -oE '^ +(-., +)?--[a-z-]+' | grep -oE '[a-z]+[a-z-]*$'); do
    sed 's/\\-/-/g' "$work/page" | grep -qe "--$option" || complain "the page of $command lacks --$option"
  done
done
# A wrong command line gets one line that names all that completion takes.
said=$(koksma completion bsh 2>&1)
[ "$? $said" = "2 koksma completion: did you mean 'bash'? it takes one of bash, zsh, fish, or words -- WORD.." ] || complain "completion bsh: $said"
[ $failed -eq 0 ]
