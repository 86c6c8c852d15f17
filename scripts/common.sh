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

# in_bare ROOT COMMAND...: in a bare system, with nothing of the environment here.
in_bare() {
    local root=$1
    shift
    chroot "$root" /usr/bin/env -i PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C \
        DEBIAN_FRONTEND=noninteractive "$@"
}

# bare_system DIR SUITE [LOCATION [SCRIPT]]: DIR/bare.tar, a Debian that has nothing but apt; made once. Leaves the script
# with 77 where that cannot be done: no root, no debootstrap, no mirror.
bare_system() {
    local dir=$1 suite=$2
    if [ "$(id -u)" != 0 ] || ! command -v debootstrap >/dev/null; then
        say "test skipped: a bare Debian needs root and debootstrap (apt-get install debootstrap)"
        exit 77
    fi
    [ ! -s "$dir/bare.tar" ] || return 0
    shift 2
    rm -rf --one-file-system "$dir/bare"
    if ! debootstrap --variant=minbase "$suite" "$dir/bare" "$@" >"$dir/debootstrap.log" 2>&1; then
        say "test skipped: debootstrap made no bare $suite ($dir/debootstrap.log)"
        exit 77
    fi
    tar -cf "$dir/bare.tar.part" -C "$dir/bare" . && mv "$dir/bare.tar.part" "$dir/bare.tar"
    rm -rf --one-file-system "$dir/bare"
}

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

# need_check_packages: what all tests need.
need_check_packages() {
    need_packages g++ clang cmake make ninja-build libboost-dev libeigen3-dev nlohmann-json3-dev libcli11-dev catch2 \
        libmpfr-dev libmpfi-dev libgmp-dev libbenchmark-dev libtbb-dev libboost-mpi-dev openmpi-bin libopenmpi-dev \
        pkg-config dpkg-dev file debootstrap
}

# configure_check [ON]: the build tree of scripts/check, or (ON) of scripts/check-long; its name is then in $build.
# -O1 with assertions: a third of the compile time of -O3, and Eigen checks its sizes. The numbers are tested at
# every level by the long tests. What only calls the library, which is compiled at -O1, is itself compiled at -O0: by
# clang in half of the time that g++ takes. The check is therefore clang's, with g++ to read everything and for those
# who use the headers; check-long is that of g++. CXX chooses another compiler for either. The parts of the library in
# which tests spend their time are compiled at -O2: that takes seconds, and saves minutes.
configure_check() {
    local long=${1:-OFF} name=check compiler=() batch=24
    [ "$long" = OFF ] || name=long
    # Batches of 48 take clang three quarters of the time of 24, and little more memory; g++ would need far more.
    [ "$long" = ON ] || [ -n "${CXX:-}" ] || { compiler=(-DCMAKE_CXX_COMPILER=clang++); batch=48; }
    build=${BUILD_DIR:-build/$name}
    # A cache of another compiler would be thrown away by CMake, with all that is set below.
    if [ ${#compiler[@]} -gt 0 ] && [ -e "$build/CMakeCache.txt" ] &&
        ! grep -q '^CMAKE_CXX_COMPILER:.*clang++' "$build/CMakeCache.txt"; then
        rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles"
    fi
    [ -e "$build/CMakeCache.txt" ] || export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja}
    cmake -S . -B "$build" "${compiler[@]}" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
        -DSIVID_WERROR=ON "-DSIVID_LONG_TESTS=$long" "-DSIVID_BUILD_BENCHMARKS=$long" "-DSIVID_BATCH_SIZE=$batch" \
        "-DSIVID_UNOPTIMISED_PARTS=diagnosis;report" \
        "-DSIVID_OPTIMISED_PARTS=paving_lanes;flow_lanes;flow;tube;number" \
        "-DSIVID_UNOPTIMISED=examples;approximate;architecture;cluster;decision;diagnosis;fleet;hovercraft;import;importing;io;measurement;model;own_robot;parallel;paving;ranks;regression;report;servo_axis;space;tanks;umbrella;verifier;withheld" >/dev/null
}

# same_answer FILE FILE: two runs of tests/machines/identify_h3.cpp found the same verdict, hulls equal to 1e-5 (machines
# contract plain arithmetic in their own way, so searches may part), and the true constants
# (examples/hovercraft/data/h3/truth.json) in them.
same_answer() {
    awk 'BEGIN { split("0.22 0.04 0.30", truth) }
        function off(a, b) { return (a > b ? a - b : b - a) > 1e-5 * a }
        FNR == 1 { if (NR == 1) verdict = $1; else if ($1 != verdict) bad = 1; next }
        NR == FNR { low[FNR] = $3; high[FNR] = $4; next }
        { ++hulls; if (off(low[FNR], $3) || off(high[FNR], $4)) bad = 1
          if (!($3 <= truth[FNR - 1] && truth[FNR - 1] <= $4)) bad = 1 }
        END { exit bad || hulls != 3 }' "$1" "$2"
}

# Without a home folder ccache has no place of its own.
[ -n "${HOME:-}" ] || export CCACHE_DISABLE=1
