# SPDX-License-Identifier: MIT
# Sourced by tests that need a Debian with nothing but apt.

# in_bare ROOT COMMAND...: in a bare system, with nothing of the environment here.
in_bare() {
    local root=$1
    shift
    chroot "$root" /usr/bin/env -i PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C \
        DEBIAN_FRONTEND=noninteractive "$@"
}

# bare_system DIR SUITE [LOCATION [SCRIPT]]: DIR/bare.tar, a Debian that has nothing but apt; made once, whoever asks at the
# same time. Leaves the script with 77 where that cannot be done: no root, no debootstrap, no mirror.
bare_system() {
    local dir=$1 suite=$2
    if [ "$(id -u)" != 0 ] || ! command -v debootstrap >/dev/null; then
        say "test skipped: a bare Debian needs root and debootstrap (apt-get install debootstrap)"
        exit 77
    fi
    exec 9>"$dir/bare.lock"
    flock 9
    [ ! -s "$dir/bare.tar" ] || { exec 9>&-; return 0; }
    shift 2
    rm -rf --one-file-system "$dir/bare"
    if ! debootstrap --variant=minbase "$suite" "$dir/bare" "$@" >"$dir/debootstrap.log" 2>&1; then
        say "test skipped: debootstrap made no bare $suite ($dir/debootstrap.log)"
        exit 77
    fi
    tar -cf "$dir/bare.tar.part" -C "$dir/bare" . && mv "$dir/bare.tar.part" "$dir/bare.tar"
    rm -rf --one-file-system "$dir/bare"
    exec 9>&-
}
