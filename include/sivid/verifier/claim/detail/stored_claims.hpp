// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_STORED_CLAIMS_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_STORED_CLAIMS_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/io/result/detail/product_formula.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/result/same_problem.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/homogeneity.hpp>
#include <sivid/paving/excluded_between.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/detail/preimage_volume.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/space/box_lanes.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/verifier/claim/detail/stated_range.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The problem in products of parameters that a stored result speaks of, rebuilt from the formulas
/// alone: each product takes the place of one of its factors, its pivot, and the other factors are
/// set to 1.
struct stored_products {
    identification_problem problem;
    std::vector<product_formula> sides;
    std::vector<std::size_t> pivots; ///< of each side: a factor of power one in no other side
    std::string malformed;           ///< why there is no such problem; else empty
    std::string unproved;            ///< why it may have other trajectories; else empty
};

namespace io_detail {

inline std::optional<std::size_t> pivot_of(std::vector<product_formula> const& sides,
                                           std::size_t k) {
    auto const& own = sides[k].exponents();
    for (std::size_t j = 0; j < own.size(); ++j) {
        bool alone = own[j] == 1;
        for (std::size_t other = 0; other < sides.size() && alone; ++other) {
            alone = other == k || sides[other].exponents()[j] == 0;
        }
        if (alone) return j;
    }
    return std::nullopt;
}

} // namespace io_detail

/// @tparam I  in which the ranges of the products over the prior are computed
/// @guarantee  where both texts are empty: parameters of the prior, none of whose replaced factors
/// is 0, have the trajectories of their products in `problem`, and its prior contains the products.
/// Shown by dimensional analysis: scaling a replaced factor against the pivots leaves all equations
/// as they are.
template <class I>
[[nodiscard]] stored_products rebuild_products(identification_problem const& original,
                                               std::vector<std::string> const& formulas) {
    using traits = interval_traits<I>;
    stored_products result;
    auto const& names = original.choice.unknown;
    for (auto const& text : formulas) {
        auto const side = product_formula::parse(text, names);
        if (!side) {
            result.malformed = "the side " + text + " is no product of the parameters";
            return result;
        }
        result.sides.push_back(*side);
    }
    result.problem = original;
    auto& choice = result.problem.choice;
    choice.unknown.clear();
    std::vector<bool> is_pivot(names.size(), false);
    result.problem.prior = box(result.sides.size());
    auto const prior = box_in<I>(original.prior);
    for (std::size_t k = 0; k < result.sides.size(); ++k) {
        auto const pivot = io_detail::pivot_of(result.sides, k);
        auto const range = result.sides[k].over(prior);
        if (!pivot || !range || !std::isfinite(traits::mag(*range))) {
            result.malformed = "the side " + formulas[k] + " cannot replace a parameter";
            return result;
        }
        result.pivots.push_back(*pivot);
        is_pivot[*pivot] = true;
        choice.unknown.push_back(names[*pivot]);
        result.problem.prior[k] = io_detail::in_doubles(*range);
    }
    std::vector<bound_model> models;
    for (auto const& e : original.experiments) {
        models.push_back(bind(original.model, original.choice, e.inputs));
    }
    for (std::size_t j = 0; j < names.size(); ++j) {
        if (is_pivot[j]) continue;
        choice.fixed[names[j]] = interval(1.0);
        std::vector<int> weights(names.size(), 0);
        weights[j] = 1;
        bool used = false;
        for (std::size_t k = 0; k < result.sides.size(); ++k) {
            weights[result.pivots[k]] = -result.sides[k].exponents()[j];
            used = used || result.sides[k].exponents()[j] != 0;
        }
        if (used && contains(original.prior[j], 0.0)) {
            result.unproved = names[j] + " may be 0";
        }
        if (!std::all_of(models.begin(), models.end(),
                         [&](auto const& m) { return is_scale_invariant(m, weights); })) {
            result.unproved = names[j] + " may act otherwise than through the products";
        }
    }
    return result;
}

/// Whether a parameter is a factor of several sides: parameters reach only some points of the box
/// of their ranges then.
[[nodiscard]] inline bool share_a_factor(stored_products const& products) {
    std::vector<bool> used;
    for (auto const& side : products.sides) {
        auto const& exponents = side.exponents();
        used.resize(exponents.size(), false);
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            if (exponents[j] == 0) continue;
            if (used[j]) return true;
            used[j] = true;
        }
    }
    return false;
}

namespace io_detail {

/// The products over a box of parameters, outward; unbounded where one is not defined.
template <class I = interval>
[[nodiscard]] box image_of(stored_products const& rebuilt, box const& x) {
    auto const p = box_in<I>(x);
    box image(rebuilt.sides.size());
    for (std::size_t k = 0; k < image.size(); ++k) {
        auto const value = rebuilt.sides[k].over(p);
        image[k] = value ? in_doubles(*value) : interval_traits<interval>::entire();
    }
    return image;
}

/// Whether parameters of a prior reach a box of products.
enum class reach { all, some, none };

/// @guarantee  all: with some of the factors as they are, the pivots reach each of its points;
///             none: no parameter has its products there
[[nodiscard]] inline reach reach_of(stored_products const& products, box near, box const& r) {
    using traits = interval_traits<interval>;
    auto const prior = near;
    for (std::size_t k = 0; k < r.size(); ++k) {
        auto const& exponents = products.sides[k].exponents();
        for (std::size_t j = 0; j < near.size(); ++j) {
            if (std::abs(exponents[j]) != 1) continue;
            auto const others = products.sides[k].without(j).over(near);
            if (!others) continue;
            bool undefined = false;
            auto const allowed = exponents[j] == 1 ? traits::div(r[k], *others, undefined)
                                                   : traits::div(*others, r[k], undefined);
            if (undefined) continue; // 0 among the divisors excludes nothing
            near[j] = traits::intersect(near[j], allowed);
            if (is_empty(near[j])) return reach::none;
        }
    }
    auto const factors = point_box(mid(near));
    for (std::size_t k = 0; k < r.size(); ++k) {
        auto const pivot = products.pivots[k];
        auto const others = products.sides[k].without(pivot).over(factors);
        bool undefined = !others;
        if (undefined || !subset(traits::div(r[k], *others, undefined), prior[pivot]) || undefined)
            return reach::some;
    }
    return reach::all;
}

} // namespace io_detail

/// Boxes within boxes of products, of which parameters of a prior reach every point: as many as
/// halving finds.
/// @given  nothing in `products` is malformed
/// @param tested  boxes, at most so many more than there are
[[nodiscard]] inline std::vector<box> reached_within(stored_products const& products,
                                                     box const& prior, std::vector<box> boxes,
                                                     std::size_t tested) {
    std::vector<box> result;
    tested += boxes.size();
    for (std::size_t at = 0; at < boxes.size(); ++at) {
        auto const r = boxes[at]; // a copy: there will be more
        auto const found = io_detail::reach_of(products, prior, r);
        if (found == io_detail::reach::all) result.push_back(r);
        if (found != io_detail::reach::some || boxes.size() + 2 > tested) continue;
        std::size_t widest = 0;
        double most = 0;
        for (std::size_t k = 0; k < r.size(); ++k) {
            double const share = width(r[k]) / width(products.problem.prior[k]);
            if (share > most) widest = k, most = share;
        }
        double const middle = mid(r[widest]);
        if (!(r[widest].lower() < middle && middle < r[widest].upper())) continue;
        auto const [low, high] = bisect(r, widest, middle);
        boxes.push_back(low);
        boxes.push_back(high);
    }
    return result;
}

namespace io_detail {

inline bool any_is(std::vector<paved_box> const& rows, box_verdict what) {
    return std::any_of(rows.begin(), rows.end(),
                       [what](auto const& row) { return row.verdict == what; });
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
inline std::string miscounted(std::vector<paved_box> const& rows,
                              std::map<std::string, std::size_t> const& stated) {
    std::map<std::string, std::size_t> counted;
    for (auto const& row : rows) ++counted[std::string{to_string(row.verdict)}];
    for (auto const& [kind, n] : stated) {
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
    auto fault = io_detail::miscounted(stored.rows, stored.stated_rows);
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
    auto fault = io_detail::miscounted(stored.rows, stored.stated_rows);
    if (io_detail::any_leaves(stored.rows, problem.prior)) fault = "a box leaves the prior";
    return io_detail::agreement("boxes", fault, "as many as stated, within the prior");
}

/// The verdict follows from witness and boxes; of products, from a volume that is said to be
/// proved inside (`check_verdict_of_products`).
[[nodiscard]] inline check_finding check_verdict(stored_identification const& stored) {
    bool const inside = io_detail::any_is(stored.rows, box_verdict::inside);
    bool const volume = stored.products && !is_empty(stored.inner) && stored.inner.lower() > 0;
    auto const follows = stored.witness || inside || volume ? verdict::consistent
                         : stored.rows.empty()              ? verdict::inconsistent
                                                            : verdict::undecided;
    auto const words = std::string{to_string(stored.verdict)};
    std::string fault;
    if (follows != stored.verdict) fault = "'" + words + "' does not follow from the rest";
    if (volume && !io_detail::any_is(stored.products->rows, box_verdict::inside)) {
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
    // The search has decided nothing; the box about the witness came behind it.
    auto const inside = std::ranges::count(rows, box_verdict::inside, &paved_box::verdict);
    holds = holds && (r != stop_reason::too_blurred || (!undecided && inside <= 1));
    // Where measurements came one by one there is no budget of memory.
    holds = holds && (stored.effort || stored.grounds.empty() || r != stop_reason::memory_budget);
    if (stored.effort && pending) { // otherwise no budget was looked at in the end
        auto const& e = *stored.effort;
        bool const time = e.seconds > e.most_seconds, boxes = e.boxes >= e.most_boxes;
        bool const nearly = stored.by_clock || // an integration was cut short
                            e.seconds >= 0.98 * e.most_seconds - 0.1;
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
    if (r == stop_reason::cancelled || r == stop_reason::hulls_rest ||
        r == stop_reason::too_blurred)
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
            auto const value = formula->over(box_in<I>(row.set));
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
    bool const whole = sum.lower() <= 1 + 1e-9 && sum.upper() >= 1 - 1e-9;
    if (!whole) fault = "boxes and rest are not the prior";
    return io_detail::agreement(std::move(what), fault,
                                "boxes disjoint; with " + std::to_string(found.gaps.size()) +
                                    " excluded boxes between them all of the prior");
}

/// The sides are products through which alone the equations see the parameters, and there are as
/// many rows as stated, all within the products' ranges.
[[nodiscard]] inline check_finding
check_products(stored_products const& rebuilt, stored_identification::product_boxes const& stored) {
    using outcome = check_finding::outcome;
    std::string const what = "products";
    if (!rebuilt.malformed.empty()) return {what, outcome::refuted, rebuilt.malformed};
    if (io_detail::any_leaves(stored.rows, rebuilt.problem.prior)) {
        return {what, outcome::refuted, "a box leaves the range of the products"};
    }
    for (auto const* const kind : {"inside", "undecided", "pending"})
        if (stored.stated_rows.count(kind) == 0)
            return {what, outcome::refuted,
                    "the number of " + std::string{kind} + " products is not stated"};
    if (auto const fault = io_detail::miscounted(stored.rows, stored.stated_rows); !fault.empty())
        return {what, outcome::refuted, fault};
    if (!rebuilt.unproved.empty()) return {what, outcome::undecided, rebuilt.unproved};
    return {what, outcome::verified, "the equations see the parameters through them only"};
}

/// The hull follows from the hulls of all boxes and of all products.
/// @tparam I  in which the bounds of products are solved for their factors
template <class I>
[[nodiscard]] check_finding check_hull_of_products(identification_problem const& problem,
                                                   stored_identification const& stored,
                                                   stored_products const& rebuilt) {
    using traits = interval_traits<I>;
    auto const n = problem.prior.size();
    auto const& rows = stored.products->rows;
    std::string fault;
    if (rows.empty() && !stored.rows.empty()) fault = "boxes without products";
    std::vector<interval> range(n, interval_traits<interval>::empty());
    int roundings = 8;
    if (fault.empty() && !stored.rows.empty()) {
        auto const products = io_detail::hull_of(rows), boxes = io_detail::hull_of(stored.rows);
        auto p = box_in<I>(problem.prior);
        for (std::size_t k = 0; k < rebuilt.sides.size(); ++k) {
            auto const& e = rebuilt.sides[k].exponents();
            roundings += 4 * rebuilt.sides[k].degree();
            for (std::size_t j = 0; j < n; ++j) {
                if (e[j] != 1) continue;
                auto const others = rebuilt.sides[k].without(j).over(p);
                typename traits::mask undefined{};
                if (!others) continue;
                auto const allowed = traits::div(io_detail::in<I>(products[k]), *others, undefined);
                if (!undefined) p[j] = traits::intersect(p[j], allowed);
            }
        }
        for (std::size_t j = 0; j < n; ++j) {
            range[j] = intersect(boxes[j], io_detail::in_doubles(p[j]));
        }
    }
    for (std::size_t j = 0; j < n && fault.empty(); ++j) {
        if (!io_detail::states(stored.parameters[j].range, range[j], roundings)) {
            fault = "the hull of " + stored.parameters[j].name +
                    " is not that of the boxes and products";
        }
    }
    if (fault.empty()) fault = between_fault(problem, stored);
    return io_detail::agreement("hull", fault, "that of all boxes and products");
}

/// The ranges of the combinations are those of the products.
[[nodiscard]] inline check_finding
check_combinations_of_products(stored_identification const& stored) {
    auto const& own = *stored.products;
    std::string fault;
    std::size_t products = 0;
    for (auto const& side : own.sides) {
        products += side.find_first_of("*/^") != std::string::npos ? 1 : 0;
    }
    if (stored.combinations.size() != products && !stored.rows.empty()) {
        fault = "not every product is a combination";
    }
    for (auto const& c : stored.combinations) {
        auto const k = static_cast<std::size_t>(
            std::find(own.sides.begin(), own.sides.end(), c.name) - own.sides.begin());
        auto range = interval_traits<interval>::empty();
        for (auto const& row : own.rows) {
            if (k < own.sides.size()) range = hull(range, row.set[k]);
        }
        if (!io_detail::states(c.range, range)) {
            fault = "the range of " + c.name + " is not that of the products";
        }
    }
    return io_detail::agreement("combinations", fault,
                                std::to_string(products) + " read from the products");
}

/// The reduction of a problem to the products that a result speaks of, if it has these.
[[nodiscard]] inline std::optional<reduction>
stated_reduction(identification_problem const& problem, stored_identification const& stored) {
    auto map = reduction::find(problem, dependence_of(problem));
    if (map && map->side_names() != stored.products->sides) map.reset();
    return map;
}

/// The verdict follows, and a volume that it rests on alone is that of products that are inside.
[[nodiscard]] inline check_finding
check_verdict_of_products(identification_problem const& problem,
                          stored_identification const& stored,
                          std::function<bool()> const& keep_going = {}) {
    auto found = check_verdict(stored);
    if (found.found != check_finding::outcome::verified || stored.verdict != verdict::consistent ||
        stored.witness || io_detail::any_is(stored.rows, box_verdict::inside)) {
        return found;
    }
    if (auto const map = stated_reduction(problem, stored)) {
        preimage_volume const share(*map, problem.prior);
        for (auto const& row : stored.products->rows) {
            if (row.verdict == box_verdict::inside &&
                share({row.set}, 256, 2e-3, keep_going).lower() > 0)
                return found;
        }
    }
    return {found.what, check_finding::outcome::undecided,
            "no proof that any parameters have the products that are inside"};
}

/// The volumes are those of the preimages of the products' boxes, as the identification computes
/// them: what is enclosed here must lie within what is stated, but for what the decimals of the
/// boxes cost.
[[nodiscard]] inline check_finding
check_volumes_of_products(identification_problem const& problem,
                          stored_identification const& stored,
                          std::function<bool()> const& keep_going = {}) {
    using outcome = check_finding::outcome;
    std::string const what = "volumes";
    std::vector<box> inside, left;
    for (auto const& row : stored.products->rows) {
        left.push_back(row.set);
        if (row.verdict == box_verdict::inside) inside.push_back(row.set);
    }
    auto const map = stated_reduction(problem, stored);
    if (!map) return {what, outcome::undecided, "other products than the model's"};
    preimage_volume const volume_of(*map, problem.prior);
    bool proved = true;
    for (bool const inner : {true, false}) {
        auto const& stated = inner ? stored.inner : stored.outer;
        std::string const which = inner ? "inner" : "outer";
        auto const volume =
            volume_of(inner ? inside : left, volume_cells(left.size()), 2e-3, keep_going);
        if (keep_going && !keep_going()) return io_detail::late(what);
        // Of each end: what is next to nothing of all that is left may be all that is inside.
        double const below = 1e-9 * volume.lower(), above = 1e-9 * volume.upper();
        double const slack = 0.05 * width(volume) + above;
        if (is_empty(stated) || stated.lower() > volume.upper() + above ||
            stated.upper() < volume.lower() - below ||
            std::abs(volume.lower() - stated.lower()) > slack ||
            std::abs(volume.upper() - stated.upper()) > slack) {
            return {what, outcome::refuted, "the " + which + " volume is not that of the products"};
        }
        proved = proved && stated.lower() <= volume.lower() + below &&
                 volume.upper() <= stated.upper() + above;
    }
    if (!proved) return {what, outcome::undecided, "as found, but stated more sharply"};
    return {what, outcome::verified,
            "of the preimages of " + std::to_string(left.size()) + " boxes of products"};
}

namespace io_detail {

/// Whether one of the rows that are left meets an image of products.
inline bool met_by(std::vector<paved_box> const& rows, box const& image) {
    return std::any_of(rows.begin(), rows.end(), [&](paved_box const& row) {
        return row.verdict != box_verdict::outside && !is_empty(intersect(row.set, image));
    });
}

/// What the boxes of parameters and of products say of each other.
/// @cost  rows of the one times rows of the other, at most
inline std::string drawing_fault(stored_identification const& stored,
                                 stored_products const& rebuilt) {
    for (auto const& row : stored.rows) {
        if (row.verdict != box_verdict::outside &&
            !met_by(stored.products->rows, image_of(rebuilt, row.set)))
            return "a box of parameters has products in no box of products";
    }
    return {};
}

/// What the boxes say of the witness.
/// @param rebuilt  null where there are no products
inline std::string witness_fault(stored_identification const& stored,
                                 stored_products const* rebuilt) {
    if (!stored.witness) return {};
    box at(stored.parameters.size());
    for (std::size_t j = 0; j < at.size(); ++j) {
        auto const own = stored.witness->parameters.find(stored.parameters[j].name);
        if (own == stored.witness->parameters.end()) return "the witness lacks a parameter";
        at[j] = interval(own->second);
    }
    if (!met_by(stored.rows, at)) return "the witness lies in no box";
    if (rebuilt != nullptr && !met_by(stored.products->rows, image_of(*rebuilt, at)))
        return "the witness lies in no box of products";
    return {};
}

/// Refuses a result that is not one of this problem, or contradicts itself. That its claims are
/// true is for a check to say.
/// @throws input_error
inline void require_consistent(identification_problem const& data,
                               stored_identification const& stored,
                               std::filesystem::path const& file) {
    using outcome = check_finding::outcome;
    auto const refuse = [&](std::string const& what) {
        throw input_error{{.file = file.string()}, what, "identify the data anew"};
    };
    auto const contradicts = [&](std::string const& fault) {
        if (!fault.empty()) refuse("the result contradicts itself: " + fault);
    };
    auto const contradicted = [&](check_finding const& found) {
        if (found.found == outcome::refuted) contradicts(found.what + ": " + found.detail);
    };
    require_same_problem(data, stored, file);
    for (auto const& e : data.experiments) {
        if (e.outliers >= e.measurements.size() && !e.measurements.empty())
            refuse("all measurements of " + in_quotes(e.name) +
                   " may violate their bounds: nothing is known from them");
    }
    if (stored.problem.empty())
        refuse("the result does not say which problem was identified: an earlier version wrote it");
    if (stored.problem != problem_digest(data))
        throw input_error{{.file = file.string()},
                          "this is not the problem that was identified: the model, its constants, "
                          "effects, data or "
                          "budgets of outliers differ (SHA-256)",
                          "give the model and the data set that were identified, or identify anew"};
    if (stored.stated_files.empty()) refuse("the result does not state the SHA-256 of its tables");
    contradicted(check_files(stored));
    auto const inputs = input_assumption(data.experiments);
    if (std::find(stored.assumptions.begin(), stored.assumptions.end(), inputs) ==
        stored.assumptions.end())
        contradicts("it does not assume '" + inputs + "'");
    contradicted(check_rows(data, stored));
    contradicted(check_verdict(stored));
    if (stored.products) {
        auto const rebuilt = rebuild_products<interval>(data, stored.products->sides);
        contradicted(check_products(rebuilt, *stored.products));
        contradicted(check_hull_of_products<interval>(data, stored, rebuilt));
        contradicted(check_combinations_of_products(stored));
        contradicts(drawing_fault(stored, rebuilt));
        contradicts(witness_fault(stored, &rebuilt));
    } else {
        contradicts(witness_fault(stored, nullptr));
        contradicted(check_hull(data, stored));
        contradicted(check_volumes(data, stored));
        contradicted(check_combinations<interval>(data, stored));
    }
    if (stored.verdict == verdict::inconsistent)
        throw input_error{{.file = file.string()},
                          "no parameter is left: the model contradicts the data",
                          "ask `diagnose` what the model lacks"};
}

} // namespace io_detail

} // namespace sivid

#endif
