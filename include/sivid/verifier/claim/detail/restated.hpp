// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_RESTATED_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_RESTATED_HPP

#include <sivid/io/identification_json.hpp>
#include <sivid/io/result/detail/stored_values.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/detail/drawing.hpp>
#include <sivid/verifier/check_finding.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What follows from the boxes of a stored identification is computed once more by the functions
/// by which `identify` and its writers computed it, and compared as text.
namespace sivid::io_detail {

/// An identification as its boxes and whether there is a witness tell it.
struct restated {
    std::optional<reduction> map; ///< to the products in which it was searched
    identification found;
    std::string fault{}; ///< why there is none; else empty
    bool sums = false;   ///< it was searched in sums: their ranges are not known from the boxes
};

[[nodiscard]] inline subpaving paving_of(box const& prior, std::vector<paved_box> const& rows) {
    subpaving result(prior);
    for (auto const& row : rows) result.add(row.set, row.verdict);
    return result;
}

/// @given  `require_same_problem`
[[nodiscard]] inline restated restate(identification_problem const& problem,
                                      stored_identification const& stored) {
    restated result{coordinates_of(problem), identification(problem.prior)};
    auto& [map, found, fault, sums] = result;
    sums = map && map->has_sums();
    if (!stored.products) map.reset();
    if (stored.products && (!map || sums || map->side_names() != stored.products->sides)) {
        fault = "the equations see the parameters through other products";
        return result;
    }
    found.paving = paving_of(problem.prior, stored.rows);
    auto left = found.hull = found.paving.outer_hull();
    if (map) {
        auto const reduced = paving_of(map->problem().prior, stored.products->rows);
        auto const [inner, outer] = paving_detail::preimage_volumes(*map, reduced, problem.prior);
        found.paving.set_volumes(inner, outer);
        found.volumes = volume_source::preimage;
        found.products.emplace(product_paving{*map, reduced});
        left = reduced.outer_hull();
        if (found.paving.has_outer())
            found.hull = intersect(found.hull, map->backward(problem.prior, left));
    }
    auto const n = problem.experiments.size();
    if (stored.witness) // whose numbers are for others to prove
        found.witness =
            verified_witness{std::vector<double>(problem.prior.size()),
                             std::vector(n, std::vector<double>(problem.model.about.states.size())),
                             std::vector(n, std::vector<bool>{})};
    found.verdict = stored.witness ? verdict::consistent : proved_verdict(found.paving);
    found.assumptions = {input_assumption(problem.experiments)};
    if (found.paving.has_outer())
        found.combinations = paving_detail::combinations_left(
            dependence_of(problem), map ? &*map : nullptr, left, found.paving);
    return result;
}

/// The members of result.json that it leads to.
[[nodiscard]] inline std::map<std::string, std::string>
members_of(identification_problem const& problem, identification const& found,
           identification_json_options const& options) {
    return what_follows(parse_json("result.json", identification_json(problem, found, options)));
}

/// Compares members of result.json with what follows.
/// @param names  of the members; with `what` it is said where one of them is not stated
[[nodiscard]] inline check_finding compared(std::string what, std::vector<std::string> const& names,
                                            std::map<std::string, std::string> const& stated,
                                            std::map<std::string, std::string> const& follows) {
    using outcome = check_finding::outcome;
    auto const in = [](std::string const& place, std::string const& name) {
        return place == "/" + name || place.starts_with("/" + name + "/");
    };
    std::size_t same = 0;
    for (auto const& name : names) {
        bool const missing = !stated.contains("/" + name);
        if (missing && follows.contains("/" + name))
            return {std::move(what), outcome::undecided, "the result does not state " + name};
        auto const differs = [&](auto const& from, auto const& other) -> std::string {
            for (auto const& [place, text] : from) {
                if (!in(place, name)) continue;
                auto const again = other.find(place);
                if (again == other.end() || again->second != text) return place;
                ++same;
            }
            return {};
        };
        auto place = differs(stated, follows);
        if (place.empty()) place = differs(follows, stated);
        if (place.empty()) continue;
        auto const text = [&place](auto const& all) {
            auto const found = all.find(place);
            return found == all.end() ? std::string("nothing") : found->second;
        };
        return {std::move(what), outcome::refuted,
                "result.json" + place + " is " + text(stated) + ", from the boxes follows " +
                    text(follows)};
    }
    if (same == 0) return {std::move(what), outcome::nothing, ""};
    return {std::move(what), outcome::verified, "as computed once more"};
}

/// The groups of members that are compared, and what a finding calls them.
[[nodiscard]] inline std::map<std::string, std::vector<std::string>> const& stated_groups() {
    static std::map<std::string, std::vector<std::string>> const all{
        {"assumptions", {"assumptions"}},
        {"combinations", {"combinations"}},
        {"files", {"files"}},
        {"hull", {"parameters"}},
        {"problem", {"problem", "time_unit"}},
        {"products", {"products"}},
        {"verdict", {"verdict", "verdict_rests_on"}},
        {"volumes", {"volume", "rows"}}};
    return all;
}

/// All of them.
[[nodiscard]] inline std::vector<check_finding>
compared_groups(stored_identification const& stored, restated const& again,
                std::map<std::string, std::string> const& follows) {
    std::vector<check_finding> result;
    for (auto const& [what, names] : stated_groups()) {
        auto found = compared(what, names, stored.stated, follows);
        if (what == "combinations" && again.sums)
            found = {what, check_finding::outcome::undecided,
                     "ranges of sums are not searched anew"};
        result.push_back(std::move(found));
    }
    return result;
}

} // namespace sivid::io_detail

#endif
