// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_FEWEST_OUTLIERS_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_FEWEST_OUTLIERS_CHECK_HPP

#include <sivid/approximate/fit/detail/counterexample.hpp>
#include <sivid/verifier/claim/detail/identification_consistency.hpp>
#include <sivid/verifier/claim/detail/point_judgement.hpp>
#include <sivid/verifier/proof/detail/certificate.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// Regions to be refuted: the whole prior, or parts of the boxes, where that is hardest, and of the
/// prior in turn.
inline std::vector<box_claim> regions_to_refute(identification_problem const& problem,
                                                stored_identification const& stored,
                                                std::size_t sample, std::uint64_t seed) {
    if (sample == 0) return {{problem.prior, box_claim::kind::outside}};
    std::vector<box_claim> claims;
    std::mt19937_64 random(seed);
    auto const share = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (std::size_t k = 0; k < sample; ++k) {
        auto part = problem.prior;
        if (k % 2 == 0 && !stored.rows.empty()) {
            part = intersect(stored.rows[random() % stored.rows.size()].set, problem.prior);
        }
        for (std::size_t j = 0; j < part.size(); ++j) {
            double const most = width(problem.prior[j]) / 16, w = width(part[j]);
            if (!(w > most)) continue;
            double const low = part[j].lower() + share() * (w - most);
            part[j] = intersect(part[j], interval_traits<interval>::bounds(low, low + most));
        }
        if (!is_empty(part)) claims.push_back({std::move(part), box_claim::kind::outside});
    }
    return claims;
}

/// All ways to hand out what is left beyond `now`, from scenario e on.
/// @returns false where there are more than `most`
inline bool hand_out(std::vector<std::size_t>& now, std::size_t e, std::size_t left,
                     std::size_t most, std::vector<std::vector<std::size_t>>& all) {
    auto const own = now[e];
    bool few = true;
    for (std::size_t k = e + 1 == now.size() ? left : 0; k <= left && few; ++k) {
        now[e] = own + k;
        if (e + 1 < now.size()) {
            few = hand_out(now, e + 1, left - k, most, all);
        } else {
            all.push_back(now);
            few = all.size() <= most;
        }
    }
    now[e] = own;
    return few;
}

} // namespace io_detail

/// Whether so many outliers are needed as a result says.
///   That they suffice is the verdict with these budgets, and for a scenario by itself a fit that
///   is proved to explain it where it is to need fewer than its budget. One less than a scenario
///   needs by itself must exclude the prior; so must one less in all, however these are handed out
///   to the scenarios: one may make up for another. Fits look for fewer first.
/// @param sample  so many regions for each claim; 0: the whole prior
/// @cost  validated runs until each region is refuted, or the time is up
template <class I>
[[nodiscard]] check_finding
check_fewest(identification_problem const& problem, stored_identification const& stored,
             certificate_options how, double seconds, std::size_t sample, std::uint64_t seed) {
    using outcome = check_finding::outcome;
    std::string const what = "outliers needed";
    if (!stored.fewest) return {what, outcome::nothing, ""};
    std::size_t budgets = 0;
    for (auto const& e : problem.experiments) budgets += e.outliers;
    if (stored.fewest->most != budgets) {
        return {what, outcome::refuted, "not as many as the scenarios' budgets"};
    }
    if (stored.verdict != verdict::consistent) {
        return {what, outcome::refuted, "the verdict does not say that they suffice"};
    }
    std::vector<identification_problem> impossible, possible;
    std::vector<std::size_t> least; // by scenario
    std::size_t alone = 0;
    for (auto const& e : problem.experiments) {
        auto const own = stored.fewest_alone.find(e.name);
        if (own == stored.fewest_alone.end() || own->second.most > e.outliers ||
            e.outliers > e.measurements.size()) {
            return {what, outcome::refuted, "no number, or too large a one, for " + e.name};
        }
        auto single = problem;
        single.experiments = {e};
        if (own->second.most < e.outliers) {
            single.experiments[0].outliers = own->second.most;
            possible.push_back(single);
        }
        alone += least.emplace_back(own->second.least);
        if (own->second.least == 0) continue;
        single.experiments[0].outliers = own->second.least - 1;
        impossible.push_back(std::move(single));
    }
    if (stored.fewest_alone.size() != problem.experiments.size()) {
        return {what, outcome::refuted, "of a scenario that the data set lacks"};
    }
    std::vector<std::vector<std::size_t>> fewer; // by what each needs alone where there are none
    bool const few = stored.fewest->least <= alone ||
                     io_detail::hand_out(least, 0, stored.fewest->least - 1 - alone, 32, fewer);
    if (!few) fewer.clear();
    for (auto const& counts : fewer) {
        auto& p = impossible.emplace_back(problem);
        for (std::size_t e = 0; e < counts.size(); ++e) {
            auto& own = p.experiments[e];
            own.outliers = std::min(counts[e], own.measurements.size());
        }
    }
    auto const found_by_fit = [&](identification_problem const& p) {
        counterexample_options fits;
        fits.seconds = 0.3 * seconds / static_cast<double>(impossible.size() + possible.size());
        fits.keep_going = how.keep_going;
        fits.confirms = [&](approximate_fit const& f) {
            return io_detail::judge_point<I>(p, f, true) == run_finding::explained;
        };
        return find_explaining_point(p, {p.prior}, fits);
    };
    if (std::any_of(impossible.begin(), impossible.end(), found_by_fit)) {
        return {what, outcome::refuted, "fewer suffice: a fit found, and validated runs prove"};
    }
    std::string unshown;
    for (auto const& p : possible) {
        auto const& own = p.experiments[0];
        if (found_by_fit(p)) continue;
        unshown += "; not shown that " + std::to_string(own.outliers) + " suffice for " + own.name;
    }
    std::size_t proved = 0, all = 0;
    for (auto const& p : impossible) {
        auto claims = io_detail::regions_to_refute(p, stored, sample, seed);
        how.seconds = seconds / static_cast<double>(impossible.size());
        claim_checker<I>(p, {}, how)(claims);
        for (auto const& c : claims) {
            ++all;
            proved += c.found == box_claim::status::proved ? 1 : 0;
            if (c.found == box_claim::status::refuted) {
                return {what, outcome::refuted, "fewer suffice"};
            }
        }
    }
    std::string detail =
        std::to_string(proved) + " of " + std::to_string(all) + " regions refuted with one less";
    if (!few) detail += "; the total is not checked from below: too many ways to share it";
    return {what,
            proved < all || !few || !unshown.empty() ? outcome::undecided
            : sample == 0 || all == 0                ? outcome::verified
                                                     : outcome::sampled,
            detail + unshown};
}

} // namespace sivid

#endif // SIVID_VERIFIER_CLAIM_DETAIL_FEWEST_OUTLIERS_CHECK_HPP
