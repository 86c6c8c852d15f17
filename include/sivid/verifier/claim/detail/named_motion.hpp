// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_NAMED_MOTION_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_NAMED_MOTION_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>
#include <sivid/verifier/claim/detail/stated_range.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::io_detail {

using named_ranges = std::map<std::string, interval>;

/// The parameters and starts that a file names, as boxes of a problem.
struct named_motion {
    box parameters;
    std::vector<box> starts; ///< by experiment
};

/// The box of ranges by names; nothing where one is missing or too many are there.
inline std::optional<box> box_by_names(named_ranges const& ranges,
                                       std::vector<std::string> const& names) {
    if (ranges.size() != names.size()) return std::nullopt;
    std::vector<interval> result;
    for (auto const& name : names) {
        auto const found = ranges.find(name);
        if (found == ranges.end()) return std::nullopt;
        result.push_back(found->second);
    }
    return box(std::move(result));
}

/// @param fault  set where these are no parameters of the prior, or not one allowed start for each
///   experiment: nothing is returned then
inline std::optional<named_motion>
motion_by_names(identification_problem const& problem, named_ranges const& parameters,
                std::map<std::string, named_ranges> const& initial, std::string& fault) {
    auto const own = box_by_names(parameters, problem.choice.unknown);
    if (!own || leaves(*own, problem.prior)) fault = "its parameters are not those of the prior";
    if (initial.size() != problem.experiments.size()) fault = "its starts are of other scenarios";
    std::vector<std::string> states;
    for (auto const& s : problem.model.about.states) states.push_back(s.name);
    named_motion result;
    for (auto const& e : problem.experiments) {
        auto const found = initial.find(e.name);
        auto const start =
            found == initial.end() ? std::nullopt : box_by_names(found->second, states);
        if (!start || leaves(*start, e.initial))
            fault = "its start in " + e.name + " is not allowed";
        if (start) result.starts.push_back(*start);
    }
    if (!fault.empty()) return std::nullopt;
    result.parameters = *own;
    return result;
}

/// The witness of a result, which has one; its sides are points.
inline std::optional<named_motion> witness_motion(identification_problem const& problem,
                                                  stored_identification const& stored,
                                                  std::string& fault) {
    auto const& w = *stored.witness;
    std::map<std::string, named_ranges> initial;
    for (auto const& [scenario, values] : w.initial)
        initial[scenario] = {values.begin(), values.end()};
    return motion_by_names(problem, {w.parameters.begin(), w.parameters.end()}, initial, fault);
}

/// The point that a witness names, if it is one of the problem: parameters of the prior, allowed
/// starts. States that effects added start where the parameters say.
inline std::optional<approximate_fit> point_of(identification_problem p, named_witness const& w) {
    for (auto& e : p.experiments)
        for (auto const& added : p.model.added_states)
            e.initial[added.state] = interval_traits<interval>::entire();
    auto const ranges = [](std::vector<named_estimate> const& all) {
        named_ranges result;
        for (auto const& x : all) result[x.name] = interval(x.value);
        return result;
    };
    std::map<std::string, named_ranges> initial;
    for (auto const& start : w.starts) initial[start.scenario] = ranges(start.states);
    std::string fault;
    auto const found = motion_by_names(p, ranges(w.parameters), initial, fault);
    if (!found) return std::nullopt;
    approximate_fit result;
    result.parameters = mid(found->parameters);
    for (auto const& start : found->starts) result.starts.push_back(mid(start));
    return result;
}

} // namespace sivid::io_detail

#endif
