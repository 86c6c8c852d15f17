// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFICATION_CONSISTENCY_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFICATION_CONSISTENCY_HPP

#include <sivid/io/result/detail/product_formula.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/excluded_between.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/claim/check_finding.hpp>
#include <sivid/verifier/claim/detail/stated_range.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

inline double apart(interval const& a, interval const& b) {
    return std::max({0.0, a.lower() - b.upper(), b.lower() - a.upper()});
}
inline bool any_is(std::vector<paved_box> const& rows, box_verdict what) {
    return std::any_of(rows.begin(), rows.end(),
                       [what](auto const& row) { return row.verdict == what; });
}
inline bool any_inside(std::vector<paved_box> const& rows) {
    return any_is(rows, box_verdict::inside);
}
/// The volumes of the inside boxes and of all, summed.
template <class Volume>
std::pair<interval, interval> volumes_of(std::vector<paved_box> const& rows, Volume const& volume) {
    interval inner{0.0}, outer{0.0};
    for (auto const& row : rows) {
        auto const v = volume(row.set);
        outer = interval_traits<interval>::add(outer, v);
        if (row.verdict == box_verdict::inside) inner = interval_traits<interval>::add(inner, v);
    }
    return {inner, outer};
}
inline bool any_leaves(std::vector<paved_box> const& rows, box const& prior) {
    return std::any_of(rows.begin(), rows.end(),
                       [&prior](auto const& row) { return leaves(row.set, prior); });
}
inline box hull_of(std::vector<paved_box> const& rows) {
    auto all = rows[0].set;
    for (auto const& row : rows) all = hull(all, row.set);
    return all;
}
/// Whether there are other numbers of rows than stated.
inline std::string miscounted(stored_identification const& stored) {
    std::map<std::string, std::size_t> counted;
    for (auto const& row : stored.rows) ++counted[std::string{to_string(row.verdict)}];
    for (auto const& [kind, n] : stored.stated_rows) {
        if (counted[kind] != n) return "the number of " + kind + " boxes is not the one stated";
    }
    return {};
}
inline check_finding agreement(std::string what, std::string const& fault,
                               std::string const& detail) {
    using outcome = check_finding::outcome;
    return {std::move(what), fault.empty() ? outcome::verified : outcome::refuted,
            fault.empty() ? detail : fault};
}

/// Whether a width is what rounding to decimals leaves: a few floats, and next to nothing of the
/// whole. A whole that is a few floats wide itself has no slivers.
inline bool is_sliver(double size, double magnitude, interval const& whole) {
    return size <= 0x1p-50 * magnitude && size <= 1e-6 * (whole.upper() - whole.lower());
}
/// Drops boxes that are slivers of the whole in a side, as long as all of them together are next to
/// nothing of it.
inline void drop_slivers(std::vector<box>& boxes, box const& whole) {
    auto const thin = [&](box const& x) {
        for (std::size_t j = 0; j < x.size(); ++j) {
            double const w = x[j].upper() - x[j].lower();
            if (width(whole[j]) > 0 && is_sliver(w, mag(x[j]), whole[j])) return true;
        }
        return false;
    };
    double volume = 0;
    for (auto const& x : boxes) {
        if (thin(x)) volume += relative_volume(x, whole).upper();
    }
    if (volume <= 1e-6) std::erase_if(boxes, thin);
}

/// Of what the time did not suffice for.
inline check_finding late(std::string what) {
    return {std::move(what), check_finding::outcome::undecided, "not within the budget"};
}

} // namespace io_detail

/// What is wrong with the shares that are said to be excluded between the ends of the hull: none
/// may be more than the boxes leave, nor less, but for what printing the ends of boxes costs.
[[nodiscard]] inline std::string between_fault(identification_problem const& problem,
                                               stored_identification const& stored) {
    for (std::size_t j = 0; j < stored.parameters.size(); ++j) {
        auto const& p = stored.parameters[j];
        auto const& prior = problem.prior[j];
        if (!p.excluded_between) continue;
        double const left = excluded_between(stored.rows, prior, p.range, j);
        auto const ends = 2 * static_cast<double>(stored.rows.size() + 1);
        double const printed =
            width(prior) > 0 ? ends * io_detail::cost_of_rounding(mag(prior), 8) / width(prior) : 0;
        if (!(std::abs(*p.excluded_between - left) <= printed))
            return "the boxes do not exclude that share of " + p.name + " between the ends";
    }
    return {};
}

/// The hull of the rows is the one stated, every row lies in the prior, and so much is excluded
/// between its ends as is stated.
[[nodiscard]] inline check_finding check_hull(identification_problem const& problem,
                                              stored_identification const& stored) {
    std::string fault;
    for (std::size_t j = 0; j < stored.parameters.size(); ++j) {
        auto range = interval_traits<interval>::empty();
        for (auto const& row : stored.rows) range = hull(range, row.set[j]);
        if (!io_detail::states(stored.parameters[j].range, range)) {
            fault = "the hull of " + stored.parameters[j].name + " is not that of the boxes";
        }
    }
    if (io_detail::any_leaves(stored.rows, problem.prior)) fault = "a box leaves the prior";
    if (fault.empty()) fault = between_fault(problem, stored);
    return io_detail::agreement("hull", fault, "that of all boxes, within the prior");
}

/// The stated numbers are those of the rows, and so are the volumes, as far as decimals tell.
[[nodiscard]] inline check_finding check_volumes(identification_problem const& problem,
                                                 stored_identification const& stored) {
    auto const [inner, outer] = io_detail::volumes_of(
        stored.rows, [&](box const& x) { return io_detail::share_of(x, problem.prior); });
    auto fault = io_detail::miscounted(stored);
    if (is_empty(intersect(inner, stored.inner))) {
        fault = "the inner volume is not that of the inside boxes";
    }
    if (is_empty(intersect(outer, stored.outer))) {
        fault = "the outer volume is not that of the boxes";
    }
    double const allowed = 1e-9 * outer.upper() + 1e-14; // to say less excludes nothing
    if (width(stored.inner) > width(inner) + allowed ||
        width(stored.outer) > width(outer) + allowed) {
        fault = "the volumes are stated less sharply than the boxes give them";
    }
    return io_detail::agreement("volumes", fault,
                                std::to_string(stored.rows.size()) + " boxes summed");
}

/// There are as many rows as stated, and all lie in the prior.
[[nodiscard]] inline check_finding check_rows(identification_problem const& problem,
                                              stored_identification const& stored) {
    auto fault = io_detail::miscounted(stored);
    if (io_detail::any_leaves(stored.rows, problem.prior)) fault = "a box leaves the prior";
    return io_detail::agreement("boxes", fault, "as many as stated, within the prior");
}

/// The verdict follows from witness and boxes; of products, from a volume that is said to be
/// proved inside (`check_verdict_of_products`).
[[nodiscard]] inline check_finding check_verdict(stored_identification const& stored) {
    bool const inside = io_detail::any_inside(stored.rows);
    bool const volume = stored.products && !is_empty(stored.inner) && stored.inner.lower() > 0;
    auto const follows = stored.witness || inside || volume ? verdict::consistent
                         : stored.rows.empty()              ? verdict::inconsistent
                                                            : verdict::undecided;
    auto const words = std::string{to_string(stored.verdict)};
    std::string fault;
    if (follows != stored.verdict) fault = "'" + words + "' does not follow from the rest";
    if (volume && !io_detail::any_inside(stored.products->rows)) {
        fault = "a volume is said to be proved inside, but no product is";
    }
    auto const grounds =
        grounds_for(stored.witness.has_value(), inside || volume, !stored.rows.empty());
    if (fault.empty() && !stored.grounds.empty() && stored.grounds != to_string(grounds)) {
        fault = "it is said to rest on " + stored.grounds + ", what is there is " +
                std::string{to_string(grounds)};
    }
    auto found = io_detail::agreement("verdict", fault, words + ", given the rest");
    if (fault.empty() && stored.grounds.empty()) {
        return {found.what, check_finding::outcome::undecided, "what it rests on is not stated"};
    }
    return found;
}

/// The tables are those that the result was written with.
[[nodiscard]] inline check_finding check_files(stored_identification const& stored) {
    if (stored.stated_files.empty()) {
        return {"files", check_finding::outcome::undecided,
                "the result does not state their SHA-256"};
    }
    std::string fault;
    for (auto const& [name, digest] : stored.files) {
        auto const stated = stored.stated_files.find(name);
        if (stated == stored.stated_files.end()) {
            fault = "the result does not know " + name;
        } else if (stated->second != digest) {
            fault = name + " is not the one that the result was written with";
        }
    }
    if (stored.stated_files.size() > stored.files.size()) fault = "a table is missing";
    return io_detail::agreement("files", fault, "the tables of this result, by SHA-256");
}

/// The assumptions are those of the problem.
/// @param further  of the program that wrote the result
[[nodiscard]] inline check_finding check_assumptions(identification_problem const& problem,
                                                     stored_identification const& stored,
                                                     std::vector<std::string> const& further) {
    std::vector<std::string> own{input_assumption(problem.experiments)};
    own.insert(own.end(), further.begin(), further.end());
    std::string fault;
    for (auto const& a : own) {
        if (std::find(stored.assumptions.begin(), stored.assumptions.end(), a) ==
            stored.assumptions.end()) {
            fault = "'" + a + "' is missing";
        }
    }
    if (fault.empty() && stored.assumptions != own) fault = "others than those of the problem";
    return io_detail::agreement("assumptions", fault, "those of the problem");
}

/// The problem is the one that was identified: the model and its effects, the prior, the data, the
/// budgets of outliers. Results of earlier versions do not say.
[[nodiscard]] inline check_finding check_problem(identification_problem const& problem,
                                                 stored_identification const& stored) {
    if (stored.problem.empty()) {
        return {"problem", check_finding::outcome::undecided, "the result does not say which"};
    }
    bool const other = stored.problem != problem_digest(problem);
    return io_detail::agreement("problem", other ? "another one was identified" : "",
                                "the one that was identified, by SHA-256");
}

/// Whether the reason to stop follows from what was left and from what the search was to end at.
/// That a search was told to stop, or would not have shrunk its hull, does not: these count as not
/// checked.
/// @param prior  of the paving that was searched
[[nodiscard]] inline check_finding check_stop(stored_identification const& stored,
                                              box const& prior) {
    auto const& rows = stored.products ? stored.products->rows : stored.rows;
    bool const pending = io_detail::any_is(rows, box_verdict::pending);
    bool const undecided = io_detail::any_is(rows, box_verdict::undecided);
    auto const [inner, outer] = io_detail::volumes_of(
        rows, [&](box const& x) { return relative_volume(intersect(x, prior), prior); });
    auto const r = stored.reason;
    bool holds = (r == stop_reason::decided) == !(pending || undecided);
    // Boxes wait unless the search came to its end.
    if (stored.effort && r != stop_reason::decided)
        holds = holds && pending == (r != stop_reason::accuracy_reached);
    // Where measurements came one by one there is no budget of memory.
    holds = holds && (stored.effort || stored.grounds.empty() || r != stop_reason::memory_budget);
    if (stored.effort && pending) { // otherwise no budget was looked at in the end
        auto const& e = *stored.effort;
        bool const time = e.seconds > e.most_seconds, boxes = e.boxes >= e.most_boxes;
        bool const nearly =
            e.seconds >= 0.98 * e.most_seconds - 0.1; // an integration was cut short
        bool const enough = !e.sufficient_ratio ||
                            (*e.sufficient_ratio < 1 && inner.upper() > 0 &&
                             inner.upper() >= (1 - 1e-6) * *e.sufficient_ratio * outer.lower());
        holds =
            holds && (!time || r == stop_reason::time_budget) &&
            (r != stop_reason::time_budget || nearly) &&
            (r == stop_reason::box_budget) == (boxes && !time && r != stop_reason::time_budget) &&
            (r != stop_reason::memory_budget || e.most_bytes.has_value()) &&
            (r != stop_reason::inside_share || enough) &&
            (r != stop_reason::hulls_rest || !e.hull_gain || *e.hull_gain > 0);
    }
    auto const words = std::string{to_string(r)};
    auto found = io_detail::agreement(
        "reason to stop", holds ? "" : "'" + words + "' does not follow from boxes and budgets",
        words + ", given boxes and budgets");
    if (!holds) return found;
    bool const stated = stored.effort &&
                        (stored.effort->sufficient_ratio || r != stop_reason::inside_share) &&
                        (stored.effort->hull_gain || r != stop_reason::hulls_rest);
    if (!stated && (stored.effort || stored.grounds.empty())) {
        return {found.what, check_finding::outcome::undecided,
                "what the search was to end at is not stated"};
    }
    if (r == stop_reason::cancelled || r == stop_reason::hulls_rest)
        return {found.what, check_finding::outcome::nothing, "'" + words + "' leaves no trace"};
    return found;
}

/// The ranges of the combinations are those over the boxes, evaluated in I.
template <class I>
[[nodiscard]] check_finding check_combinations(identification_problem const& problem,
                                               stored_identification const& stored) {
    using traits = interval_traits<I>;
    if (stored.combinations.empty()) return {"combinations", check_finding::outcome::nothing, ""};
    std::string fault;
    bool sums = false; // a search in sums knows more of them than boxes of their terms say
    for (auto const& c : stored.combinations) {
        if (is_sum_of(c.name, problem.choice.unknown)) {
            sums = true;
            continue;
        }
        auto const formula = product_formula::parse(c.name, problem.choice.unknown);
        if (!formula) {
            fault = "the formula " + c.name + " is no product of the parameters";
            continue;
        }
        auto low = HUGE_VAL, high = -HUGE_VAL;
        for (auto const& row : stored.rows) {
            auto const value = formula->over(io_detail::in<I>(row.set));
            low = std::min(low, value ? traits::lower(*value) : -HUGE_VAL);
            high = std::max(high, value ? traits::upper(*value) : HUGE_VAL);
        }
        auto const range = low <= high ? interval_traits<interval>::bounds(low, high)
                                       : interval_traits<interval>::empty();
        if (!io_detail::states(c.range, range, 4 + 4 * formula->degree())) {
            fault = "the range of " + c.name + " is not that over the boxes";
        }
    }
    if (sums && fault.empty()) {
        return {"combinations", check_finding::outcome::undecided,
                "ranges of sums are not searched anew"};
    }
    return io_detail::agreement("combinations", fault,
                                std::to_string(stored.combinations.size()) + " evaluated anew");
}

/// The rows share no volume, and rows and gaps are all of the prior.
[[nodiscard]] inline check_finding check_cover(std::string what,
                                               identification_problem const& problem,
                                               std::vector<paved_box> const& rows,
                                               box_cover const& found) {
    using traits = interval_traits<interval>;
    std::string fault;
    if (!found.complete) return io_detail::late(std::move(what));
    if (!found.overlaps.empty()) {
        fault = std::to_string(found.overlaps.size()) + " pairs of boxes overlap";
    }
    interval sum{0.0};
    for (auto const& row : rows) {
        sum = traits::add(sum, relative_volume(intersect(row.set, problem.prior), problem.prior));
    }
    for (auto const& gap : found.gaps) {
        sum = traits::add(sum, relative_volume(gap, problem.prior));
    }
    if (io_detail::apart(sum, interval(1.0)) > 1e-9) fault = "boxes and rest are not the prior";
    return io_detail::agreement(std::move(what), fault,
                                "boxes disjoint; with " + std::to_string(found.gaps.size()) +
                                    " excluded boxes between them all of the prior");
}

} // namespace sivid

#endif // SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFICATION_CONSISTENCY_HPP
