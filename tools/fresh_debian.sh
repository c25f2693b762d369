#!/usr/bin/env bash
# Runs a command on a fresh Debian, in a folder of its own, with a clean clone of what is committed here in
# /root/terrane. Nothing but Debian's essential packages and apt is there.
#
#   tools/fresh_debian.sh RELEASE ROOT COMMAND…
#
#   RELEASE: bookworm (12) or trixie (13)
#   ROOT:    the folder of the system, created if missing and kept
#
#   tools/fresh_debian.sh bookworm /tmp/fresh ./run test
#   tools/fresh_debian.sh trixie /tmp/fresh13 tools/packages.sh
#
# Needs root, and: apt install mmdebstrap git. apt and npm use this machine's sources and certificates. Exit code: the
# command's; 2 for wrong arguments or a ROOT of another release.
set -euo pipefail

readonly PROJECT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[[ $# -ge 3 && $1 =~ ^(bookworm|trixie)$ ]] || { sed -n '2,/^set/s/^# \?//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
readonly RELEASE=$1 ROOT=$2
shift 2

codename() { sed -n 's/^VERSION_CODENAME=//p' "$1/etc/os-release"; }

# This machine's sources, of the other release.
make_root() {
    local file sources
    sources=$(mktemp -d)
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.sources /etc/apt/sources.list.d/*.list; do
        [[ ! -f $file ]] || sed "s/\b$(codename /)\b/$RELEASE/g" "$file" >"$sources/${file##*/}"
    done
    mmdebstrap --quiet --variant=apt "$RELEASE" "$ROOT" "$sources"/*
    rm -r "$sources"
    [[ ! -f /etc/npmrc ]] || cp /etc/npmrc "$ROOT/etc/"
    [[ ! -f ~/.npmrc ]] || cp ~/.npmrc "$ROOT/root/"
    git clone --quiet --no-hardlinks "$PROJECT" "$ROOT/root/terrane"
}

[[ -d $ROOT ]] || make_root
[[ $(codename "$ROOT") == "$RELEASE" ]] || { echo "fresh_debian: $ROOT is not a Debian $RELEASE" >&2; exit 2; }
cp /etc/resolv.conf "$ROOT/etc/"
[[ ! -f /etc/ssl/certs/ca-certificates.crt ]] || cp /etc/ssl/certs/ca-certificates.crt "$ROOT/etc/trusted-here.crt"
# Mounts and processes end with the command.
exec env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM="${TERM:-dumb}" \
    npm_config_cafile=/etc/trusted-here.crt \
    unshare --mount --pid --fork --kill-child bash -c '
    root=$1
    shift
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --rbind /sys "$root/sys"
    mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
    cd "$root/root/terrane"
    exec chroot "$root" bash -c "cd /root/terrane && exec \"\$@\"" bash "$@"' bash "$ROOT" "$@"
