#!/bin/sh
# stranger.sh FOLDER: a stranger's path. FOLDER is or becomes an empty Debian (debootstrap; root is needed); the packages
# of build/deb (make deb) are installed there as README says, what docs/install.md shows is typed there letter by letter, a scene
# is ranked, and the packages are removed again, which must leave no file. Says how many seconds each step took.
set -eu
root=$1
source=$(cd "$(dirname "$0")/../.." && pwd)
[ -d "$root/usr" ] || debootstrap --variant=minbase "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$root" >/dev/null
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
step() {
  what=$1 start=$(date +%s)
  shift
  "$@" >"$root/tmp/log" 2>&1 || { tail -20 "$root/tmp/log"; echo "stranger.sh: $what failed"; exit 1; }
  echo "$(($(date +%s) - start)) s: $what"
}
files() { inside find / -xdev \( -path /proc -o -path /sys -o -path /tmp -o -path /var -o -path /root \) -prune -o -print | grep -v __pycache__ | sort; }

step 'apt update' inside apt-get update
step 'a compiler, pkg-config, CMake' inside apt-get install -y --no-install-recommends gcc libc6-dev pkg-config cmake make
mkdir -p "$root/tmp/deb" && rm -f "$root"/tmp/deb/*.deb && cp "$source"/build/deb/*.deb "$root/tmp/deb"
cp "$source/tests/docs/fences.py" "$source/docs/install.md" "$source/docs/tutorial.md" "$root/tmp"
# What our packages depend on stays when they go.
depends=$(inside sh -c 'apt-get install -s --no-install-recommends /tmp/deb/*.deb' | sed -n 's/^Inst \([^ ]*\).*/\1/p' | grep -v koksma || true)
[ -z "$depends" ] || step 'what the packages depend on' inside apt-get install -y --no-install-recommends $depends
files >"$root/tmp/before"
step 'the packages installed' inside sh -c 'apt-get install -y --no-install-recommends /tmp/deb/*.deb'
step 'koksma rank ball' inside koksma rank ball
tail -1 "$root/tmp/log" | cut -c1-160
step 'docs/install.md: C by pkg-config, C by CMake, Python' inside python3 /tmp/fences.py /usr/bin/koksma /tmp/install.md
step 'the tutorial' inside python3 /tmp/fences.py /usr/bin/koksma /tmp/tutorial.md
step 'man page, completion' inside sh -c 'test -s /usr/share/man/man1/koksma-rank.1.gz && grep -q rank /usr/share/bash-completion/completions/koksma'
step 'the packages removed' inside apt-get purge -y koksma libkoksma0 libkoksma-lab0 libkoksma-dev python3-koksma
files >"$root/tmp/after"
diff "$root/tmp/before" "$root/tmp/after" || { echo 'stranger.sh: files that were left, or taken'; exit 1; }
echo 'nothing is left'
