// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_STATED_RANGE_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_STATED_RANGE_HPP

#include <sivid/number/interval.hpp>
#include <sivid/space/box.hpp>
#include <sivid/verifier/check_finding.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace sivid::io_detail {

/// Whether a box has nothing in common with a prior, or leaves it by more than rounding.
inline bool leaves(box const& x, box const& prior) {
    for (std::size_t j = 0; j < x.size(); ++j) {
        double const room = 4e-15 * mag(prior[j]);
        if (is_empty(intersect(x[j], prior[j])) || x[j].lower() < prior[j].lower() - room ||
            x[j].upper() > prior[j].upper() + room)
            return true;
    }
    return false;
}

/// The worst of what became of several statements, and why.
class finding_of_all {
    using outcome = check_finding::outcome;

public:
    void note(outcome o, std::string const& why) {
        if (o == outcome::nothing) return;
        ++count_;
        bool const worse = rank(o) > rank(worst_);
        if (worse) why_ = why;
        if (worse) worst_ = o;
    }
    [[nodiscard]] check_finding finding(std::string what, std::string const& good) const {
        if (count_ == 0) return {std::move(what), outcome::nothing, ""};
        return {std::move(what), worst_, worst_ == outcome::verified ? good : why_};
    }

private:
    [[nodiscard]] static int rank(outcome o) {
        return o == outcome::refuted ? 2 : o == outcome::undecided ? 1 : 0;
    }
    outcome worst_ = outcome::verified;
    std::string why_;
    std::size_t count_ = 0;
};

/// By more than what printing and reading cost: floats of its own, whatever the other end is.
[[nodiscard]] inline bool below(double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return a < b;
    return a < b - 8 * (0x1p-52 * std::abs(b) + std::numeric_limits<double>::denorm_min());
}
/// Whether what was proved lies in what is stated, but for what printing and reading cost.
[[nodiscard]] inline bool within_stated(interval const& proved, interval const& stated) {
    if (is_empty(proved)) return true;
    return !is_empty(stated) && !below(proved.lower(), stated.lower()) &&
           !below(stated.upper(), proved.upper());
}
/// Refuted where no number lies in both.
[[nodiscard]] inline check_finding::outcome compared(interval const& proved,
                                                     interval const& stated) {
    if (within_stated(proved, stated)) return check_finding::outcome::verified;
    bool const apart = is_empty(stated) || below(stated.upper(), proved.lower()) ||
                       below(proved.upper(), stated.lower());
    return apart ? check_finding::outcome::refuted : check_finding::outcome::undecided;
}

} // namespace sivid::io_detail

#endif
