// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_THREADS_HPP
#define SIVID_APP_DETAIL_THREADS_HPP

#include <sivid/executor.hpp>

#ifdef SIVID_HAS_TBB
#include <sivid/parallel/tbb_executor.hpp>
#endif

#include <cstddef>
#include <stdexcept>

namespace sivid::app {

/// @param threads  0: as many as the machine has; without oneTBB that is one
/// @throws std::invalid_argument where more are asked for than the program can have
[[nodiscard]] inline executor threads_for(std::size_t threads) {
    if (threads == 1) return {};
#ifdef SIVID_HAS_TBB
    return tbb_executor(threads);
#else
    if (threads == 0) return {};
    throw std::invalid_argument("--threads: this program was built without oneTBB; install it "
                                "(Debian: libtbb-dev), configure and build anew, or leave the "
                                "option out");
#endif
}

} // namespace sivid::app

#endif
