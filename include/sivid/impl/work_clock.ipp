// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_WORK_CLOCK_IPP
#define SIVID_IMPL_WORK_CLOCK_IPP

#include <sivid/work_clock.hpp>

namespace sivid {

namespace number_detail {
/// One for a program and the library that it is linked to: who asks for it is compiled with it.
[[nodiscard]] inline double& counted_work() {
    static thread_local constinit double seconds = 0;
    return seconds;
}
} // namespace number_detail

SIVID_DECL double work_clock::now() { return number_detail::counted_work(); }
SIVID_DECL void work_clock::advance(double seconds) { number_detail::counted_work() += seconds; }
SIVID_DECL void work_clock::set(double seconds) { number_detail::counted_work() = seconds; }

} // namespace sivid

#endif
