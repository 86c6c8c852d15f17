# SPDX-License-Identifier: MIT
# Sourced by the other scripts: packages and number of jobs.

say() { printf '%s\n' "$*"; }
die() { printf 'error: %s\n' "$*" >&2; exit 1; }

# have_package NAME: true when dpkg lists it as installed.
have_package() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# need_packages NAME...: installs what is missing; touches neither apt nor the network otherwise.
need_packages() {
    if ! command -v dpkg-query >/dev/null 2>&1; then
        say "not a Debian system: expecting the equivalents of: $*"
        return 0
    fi
    local missing=() name
    for name in "$@"; do
        have_package "$name" || missing+=("$name")
    done
    [ ${#missing[@]} -gt 0 ] || return 0

    local root=()
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null 2>&1 ||
            die "these packages are missing and there is neither root nor sudo to install them: ${missing[*]}"
        root=(sudo)
    fi
    local apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300)
    say "installing: ${missing[*]}"
    # The lists of a machine may be old or absent: refresh them when the first attempt fails.
    "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null 2>&1 && return 0
    "${apt[@]}" update >/dev/null ||
        die "apt-get update failed (no network?); to install by hand: apt-get install ${missing[*]}"
    "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null ||
        die "apt-get could not install: ${missing[*]}"
}

# need_program COMMAND PACKAGE: the package, unless the command is there by other means.
need_program() { command -v "$1" >/dev/null 2>&1 || need_packages "$2"; }

# job_count: one job for each core, fewer where memory is short (1.5 GB for each compiler).
job_count() {
    local cores memory_kb by_memory
    cores=$(nproc 2>/dev/null || echo 1)
    memory_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo 2>/dev/null || true)
    by_memory=$(( ${memory_kb:-0} / 1500000 ))
    [ "$by_memory" -ge 1 ] || by_memory=1
    [ -n "${memory_kb:-}" ] || by_memory=$cores
    echo $(( cores < by_memory ? cores : by_memory ))
}

# Without a home folder ccache has no place of its own.
[ -n "${HOME:-}" ] || export CCACHE_DISABLE=1
