// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_STATED_RANGE_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_STATED_RANGE_HPP

#include <sivid/number/interval.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/check_finding.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace sivid {

namespace io_detail {

/// A side in the arithmetic of I.
template <class I>
[[nodiscard]] I in(interval const& side) {
    return interval_traits<I>::bounds(side.lower(), side.upper());
}
/// The doubles around it.
template <class I>
[[nodiscard]] interval in_doubles(I const& x) {
    using traits = interval_traits<I>;
    return interval_traits<interval>::bounds(traits::lower(x), traits::upper(x));
}

/// What so many roundings may cost an end: floats of its own, whatever the other end is.
inline double cost_of_rounding(double end, int roundings) {
    return roundings * (0x1p-52 * std::abs(end) + std::numeric_limits<double>::denorm_min());
}

/// Whether a range is stated that contains what follows from the rest, and no more than that.
///   What is missing at an end must be rounding of that end. To state too much excludes nothing:
///   there the larger end is the measure. No bound is stated where there is none, and only there.
/// @param roundings  between what was computed and what follows, at most
inline bool states(interval const& stated, interval const& follows, int roundings = 4) {
    if (is_empty(stated) || is_empty(follows)) return is_empty(stated) && is_empty(follows);
    auto const finite = [](double x) { return std::isfinite(x) ? std::abs(x) : 0.0; };
    double const scale = std::max(finite(follows.lower()), finite(follows.upper()));
    auto const end = [&](double said, double true_end, double outward) {
        if (!std::isfinite(said) || !std::isfinite(true_end)) return said == true_end;
        double const beyond = outward * (said - true_end);
        return beyond >= -cost_of_rounding(true_end, roundings) && beyond <= 1e-14 * scale;
    };
    return end(stated.lower(), follows.lower(), -1) && end(stated.upper(), follows.upper(), 1);
}

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

/// What share of a prior boxes may have that are printed and read as this one: their ends lie
/// within floats of its own, of which 15 digits leave eight.
inline interval share_of(box const& x, box const& prior) {
    using traits = interval_traits<interval>;
    if (is_empty(intersect(x, prior))) return interval{0.0};
    auto smallest = x, largest = x;
    for (std::size_t j = 0; j < x.size(); ++j) {
        if (is_one_number(prior[j])) continue;
        double const low = cost_of_rounding(x[j].lower(), 8);
        double const high = cost_of_rounding(x[j].upper(), 8);
        largest[j] = traits::bounds(x[j].lower() - low, x[j].upper() + high);
        smallest[j] = x[j].lower() + low <= x[j].upper() - high
                          ? traits::bounds(x[j].lower() + low, x[j].upper() - high)
                          : traits::empty();
    }
    auto const share = [&prior](box const& y) {
        return relative_volume(intersect(y, prior), prior);
    };
    return traits::bounds(std::max(0.0, share(smallest).lower()), share(largest).upper());
}

/// Takes a part of a box whose sides are large against a prior's, anywhere in it.
/// @param share  a number of [0, 1), by chance
template <class Share>
void shrink_to_share(box& part, box const& prior, Share const& share) {
    for (std::size_t j = 0; j < part.size(); ++j) {
        double const most = width(prior[j]) / 16, w = width(part[j]);
        if (!(w > most)) continue;
        double const low = part[j].lower() + share() * (w - most);
        part[j] = intersect(part[j], interval_traits<interval>::bounds(low, low + most));
    }
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

} // namespace io_detail

} // namespace sivid

#endif
