// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_POSED_PROBLEM_HPP
#define SIVID_APP_DETAIL_POSED_PROBLEM_HPP

#include <sivid/app/detail/joined_effects.hpp>
#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/names.hpp>
#include <sivid/app/robot.hpp>
#include <sivid/io/allowed_disturbances.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/structure/rounded_sign.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid::app {

/// A problem, and effects to be joined to it over whose ranges no run goes: those that remember (a
/// delay, a play, a rate limit), or begin where their parameters say.
struct remembering_problem {
    identification_problem base;
    std::vector<effect> effects;
};

/// The way from one folder to another, if there is one that may stand in a file.
inline std::string seen_from(std::filesystem::path const& here,
                             std::filesystem::path const& there) {
    std::error_code fault;
    auto const way = std::filesystem::relative(there, here, fault);
    auto const text = fault ? std::string{} : way.generic_string();
    return unprintable_in(text).empty() ? text : std::string{};
}

/// Of which data and problem a result is, for its check.
template <class Command>
json_writer& write_source(json_writer& json, Command const& c,
                          identification_problem const& problem) {
    json.key("source").object("folder", seen_from(c.out, c.dataset), "sha256",
                              dataset_digest(c.dataset));
    return json.members("problem", problem_digest(problem), "effects", c.effects, "most_seconds",
                        c.budget);
}

/// The data set of a folder. @throws input_error
inline dataset read_data(robot const& r, std::filesystem::path const& folder) {
    return read_dataset(folder, names_of(r.model.about));
}

/// Where the data of a result are: as told, or as it says itself. @throws bad_request
inline std::filesystem::path data_of_result(std::filesystem::path const& result,
                                            std::filesystem::path const& told,
                                            std::string const& stated) {
    if (!told.empty()) return told;
    if (stated.empty())
        throw bad_request("the result does not say where its data set is: give --dataset");
    return result / stated;
}

/// The robot's effects of these names, as the data set has them.
/// @throws bad_request  for a name that there is not
inline std::vector<effect> effects_of(robot const& r, dataset const& data,
                                      std::vector<std::string> const& names) {
    return known_effects(chosen_effects(r.effects, data), names, r.model.about);
}

/// What a data set's result with effects and disturbances rests on besides what is proved.
inline std::vector<std::string> assumptions_of(robot const& r, dataset const& data,
                                               std::vector<std::string> const& effects,
                                               allowed_disturbances const& disturbances,
                                               identification_problem const& posed) {
    auto result = data.assumptions;
    for (auto& words : creeping_words(posed)) result.push_back(std::move(words));
    for (auto& words : wrap_assumptions(effects_of(r, data, effects)))
        result.push_back(std::move(words));
    for (auto& words : assumptions_of(disturbances, posed.model))
        result.push_back(std::move(words));
    return result;
}

/// Takes out of the model's own bounds what has this name. @returns  whether there was one
inline bool take_out(robot const& r, allowed_disturbances::bounds& all, std::string const& name) {
    auto const named = [&r](std::string const& known) { // a state has two names
        for (auto const& s : r.model.about.states)
            if (s.equation_name() == known) return s.name;
        return known;
    };
    return std::erase_if(all, [&](auto const& b) { return named(b.first) == named(name); }) > 0;
}

/// Those of the model but where "--disturbance v=0.8", "--error y=0.1" take their place, 0 of what
/// the model disturbs leaving it out.
/// @throws bad_request
[[nodiscard]] inline allowed_disturbances
disturbances_from(robot const& r, std::vector<std::string> const& equations,
                  std::vector<std::string> const& channels) {
    auto const read = [&](allowed_disturbances::bounds all, std::vector<std::string> const& list,
                          std::string const& option) {
        allowed_disturbances::bounds told;
        for (auto const& text : list) {
            auto const [name, value] = detail::assignment(text, option);
            auto const most = decimal_of(value, option + " " + name);
            bool const stated = take_out(r, all, name);
            if (!stated || !most.is_zero()) told.emplace_back(name, most);
        }
        all.insert(all.end(), told.begin(), told.end());
        return all;
    };
    return {read(r.disturbances.equations, equations, "--disturbance"),
            read(r.disturbances.channels, channels, "--error")};
}

/// The problem in which disturbances act, if there are any.
/// @throws bad_request  for what cannot be disturbed
[[nodiscard]] inline identification_problem disturbed(identification_problem problem,
                                                      allowed_disturbances const& disturbances) {
    if (disturbances.empty()) return problem;
    try {
        return with_disturbance(std::move(problem), disturbances);
    } catch (std::invalid_argument const& e) {
        throw bad_request(e.what());
    }
}

/// The identification problem of a data set, effects of the catalogue joined to its model.
/// @param remembering  receives what it was made of where it has such effects; null: they are
///                     refused
/// @throws bad_request  for an effect that is unknown, given twice, or whose parameters cannot be
///                      identified with proof
[[nodiscard]] inline identification_problem
posed_undisturbed(robot const& r, dataset const& data, std::vector<std::string> const& effects,
                  std::optional<outlier_rule> const& outliers = std::nullopt,
                  std::optional<remembering_problem>* remembering = nullptr) {
    auto problem = problem_from_dataset(data, r.model, outliers);
    if (effects.empty()) return problem;
    auto base = problem;
    auto const named = effects_of(r, data, effects);
    try {
        for (auto const& e : named) {
            for (auto const& scenario : e.only_in)
                (void)index_of(problem.experiments, scenario, "scenario to fit");
        }
        problem = affected(problem, named);
    } catch (std::invalid_argument const& e) {
        throw bad_request(e.what());
    }
    bool const remembers = problem.model.has_memory();
    bool const partial =
        std::any_of(named.begin(), named.end(), [](auto const& e) { return !e.only_in.empty(); });
    if (remembering != nullptr && !partial && (remembers || starts_follow_parameters(problem))) {
        *remembering = remembering_problem{std::move(base), named};
        return problem;
    }
    if (remembers)
        throw bad_request("an effect that delays, a backlash or a rate limit cannot be joined "
                          "here yet; `identify` bounds those that act everywhere, `diagnose` "
                          "all, and both verify them at points");
    if (starts_follow_parameters(problem))
        throw bad_request("these effects together begin where their parameters say, which an "
                          "identification cannot follow yet; `diagnose` tries them at points");
    return problem;
}

/// The same with disturbances: what any command finds holds for all of them.
/// @throws bad_request  also for disturbances beside effects that are followed slice by slice
[[nodiscard]] inline identification_problem
posed(robot const& r, dataset const& data, std::vector<std::string> const& effects,
      allowed_disturbances const& disturbances,
      std::optional<outlier_rule> const& outliers = std::nullopt,
      std::optional<remembering_problem>* remembering = nullptr) {
    return disturbed(
        posed_undisturbed(r, data, effects, outliers, disturbances.empty() ? remembering : nullptr),
        disturbances);
}

/// What was identified, for people: the data set, and what was joined to the model.
[[nodiscard]] inline std::string title_of(dataset const& data,
                                          std::vector<std::string> const& effects,
                                          allowed_disturbances const& disturbances,
                                          recorded_model const& model) {
    std::string title = data.id;
    for (std::size_t k = 0; k < effects.size(); ++k)
        title += (k == 0 ? " with " : k + 1 == effects.size() ? " and " : ", ") + effects[k];
    if (!disturbances.empty()) title += " for all disturbances of " + in_words(disturbances, model);
    return title;
}

} // namespace sivid::app

#endif
