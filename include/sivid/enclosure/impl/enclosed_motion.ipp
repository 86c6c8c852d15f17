// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_IMPL_ENCLOSED_MOTION_IPP
#define SIVID_ENCLOSURE_IMPL_ENCLOSED_MOTION_IPP

#include <sivid/enclosure/enclosed_motion.hpp>

#include <sivid/compiled.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace sivid {

SIVID_DECL enclosed_motion::enclosed_motion(std::shared_ptr<flow const> f, box const& initial,
                                            box const& parameters, double from, double to,
                                            enclosure_options const& options)
    : tube_(std::make_shared<tube<interval> const>(
          integrate<interval>(std::move(f), initial, parameters, from, to, options))),
      end_(tube_->end_time()),
      failure_(tube_->failure()) {
    carried_.first_order = end_;
    for (auto const& step : tube_->steps()) spans_.push_back({step.from, step.to, step.swept});
}
SIVID_DECL box enclosed_motion::at(double t) const {
    return between_ ? between_->at(t) : tube_->at(t);
}
SIVID_DECL box enclosed_motion::observe_at(double t) const {
    return between_ ? between_->observe_at(t) : tube_->observe_at(t);
}
SIVID_DECL box enclosed_motion::over(double from, double to) const {
    if (!(from <= to))
        throw std::invalid_argument("enclosed_motion: a span must not end before it begins: from " +
                                    nearest_text(from) + " to " + nearest_text(to));
    if (tube_) return tube_->over(from, to);
    if (from == to) return at(from);
    if (auto const whole = between_->over_spans(from, to)) return *whole;
    auto result = hull(at(from), at(to));
    for (auto const& span : spans_) {
        if (span.to <= from || span.from >= to) continue;
        bool const whole = span.from >= from && span.to <= to;
        result =
            hull(result, whole ? span.states
                               : between_->over(std::max(from, span.from), std::min(to, span.to)));
    }
    return result;
}
SIVID_DECL tube<interval> const& enclosed_motion::steps() const {
    if (!tube_) throw std::logic_error("enclosed_motion: its sets are not of first order");
    return *tube_;
}

} // namespace sivid

#endif
