// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_FINDING_OF_ALL_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_FINDING_OF_ALL_HPP

#include <sivid/number/interval.hpp>
#include <sivid/verifier/claim/check_finding.hpp>
#include <sivid/verifier/claim/detail/stated_range.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace sivid::io_detail {

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

/// By more than what printing and reading cost.
[[nodiscard]] inline bool below(double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return a < b;
    return a < b - cost_of_rounding(b, 8);
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
