#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# coherence_table.sh PROGRAM: the table of docs/findings/coherence.md, as Markdown. Minutes; works in a folder of its own.
set -eu
koksma=$(readlink -f "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
patterns='random jittered n-rooks multi-jittered sobol:scramble=owen pmj02 zaremba:shift=1 z-sampler mask-offset poisson-disk:d=0.2 half-jittered regular zaremba hammersley r-sequence halton'
scenes='checker checker-45 ball all balls'
for scene in $scenes; do
  "$koksma" render $scene -q -p jittered -n 4096 -s 99 -o $scene.pfm >reference.txt
done
for spp in 4 16; do
  echo "| $spp samples a pixel | $(echo $scenes | sed 's/ / | /g') |"
  echo "|---|---|---|---|---|---|"
  for pattern in $patterns; do
    line="| \`$pattern\`"
    scope=pixel
    case $pattern in z-sampler | mask-offset) scope=image ;; esac # one set of all pixels: that is what they are for
    for scene in $scenes; do
      for seed in 0 1 2 3 4 5 6 7; do
        "$koksma" render $scene -q -p $pattern --scope $scope -n $spp -s $seed -o image.$seed.pfm >render.txt 2>&1 || break
      done
      if [ -e image.7.pfm ]; then
        line="$line | $("$koksma" compare image.?.pfm $scene.pfm --json | tr ',' '\n' | sed 's/[{}"]//g' | awk -F: '
          { v[$1] = $2 }
          END {
            text = sprintf("%.3g [%.3g, %.3g]", v["coherence"], v["coherence_low"], v["coherence_high"])
            printf "%s", v["coherent"] == "true" ? "**" text "**, " sprintf("%.2g", v["noise_high"]) : text
          }')"
        rm -f image.?.pfm
      else
        line="$line | –"
      fi
    done
    echo "$line |"
  done
  echo
done
