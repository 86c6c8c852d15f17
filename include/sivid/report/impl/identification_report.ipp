// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_IDENTIFICATION_REPORT_IPP
#define SIVID_REPORT_IMPL_IDENTIFICATION_REPORT_IPP

#include <sivid/report/identification_report.hpp>

namespace sivid::report {

namespace detail {

SIVID_DECL range shown_share(interval const& volume) {
    range const r = share_of_whole(volume);
    double const more = 5e-4 * r.hi;
    return r.lo == r.hi || r.hi - r.lo > more
               ? r
               : range{std::max(0.0, r.lo - more), std::min(1.0, r.hi + more)};
}

} // namespace detail

SIVID_DECL comparison_row comparison_of(std::string name, identification const& found, bool chosen,
                                        std::string note) {
    return {std::move(name),
            found.seconds,
            found.boxes,
            found.integrations,
            detail::shown_share(found.paving.inner_volume()),
            detail::shown_share(found.paving.outer_volume()),
            std::move(note),
            chosen};
}

} // namespace sivid::report

#include <sivid/report/fill/detail/report_filler.hpp>

#endif
