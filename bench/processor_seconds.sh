# SPDX-License-Identifier: Apache-2.0
# Read by the benchmarks of other programs: processor seconds of a command, user's and system's, with what it says in
# $folder/log. The second line of `times` has the children's.
processor_seconds() {
  sh -c '"$@" >"$0" 2>&1; times' "$folder/log" "$@" | sed -n '2s/[ms]/ /gp' | awk '{ print 60 * $1 + $2 + 60 * $3 + $4 }'
}
smaller() {
  printf '%s\n' "$1" "$2" | sort -g | head -1
}
# Sets jittered and regular to koksma's seconds for the same picture, if they are less than what stands there.
time_koksma() {
  for pattern in jittered regular; do
    seconds=$(processor_seconds build/release/koksma render ball -p "$pattern" -n 64 --size 512x384 --threads 1 \
      -o "$folder/ball.pfm")
    eval "$pattern=\$(smaller \"\$$pattern\" \"$seconds\")"
  done
}
# say PROGRAM ITS-SECONDS
say() {
  awk -v name="$1" -v theirs="$2" -v jittered="$jittered" -v regular="$regular" 'BEGIN {
    samples = 512 * 384 * 64 / 1e6
    printf "%s %.2f   koksma, jittered %.1f (%.0f times), regular %.1f (%.0f times)\n", name, samples / theirs,
           samples / jittered, theirs / jittered, samples / regular, theirs / regular
  }'
}
