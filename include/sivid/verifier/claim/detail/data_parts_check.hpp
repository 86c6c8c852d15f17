// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_DATA_PARTS_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_DATA_PARTS_CHECK_HPP

#include <sivid/diagnosis/gap/detail/confined_gap.hpp> // first: its definitions include the next

#include <sivid/diagnosis/gap/detail/coarse_steps.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/verifier/claim/detail/finding_of_all.hpp>
#include <sivid/verifier/claim/detail/inflation_proof.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid::io_detail {

/// The inflation of each scenario and channel alone.
/// @param most  what that of all data is proved to be at most: then that of a part is, too
[[nodiscard]] inline check_finding check_parts(identification_problem const& base,
                                               diagnosis const& d, double most,
                                               inflation_proof const& proof,
                                               work_limit const& limit) {
    using outcome = check_finding::outcome;
    finding_of_all all;
    auto const& s = d.scenario_inflation;
    auto const& c = d.channel_inflation;
    std::size_t left = s.size() + c.size();
    auto const part = [&](named_estimate const& stated, auto const& names, auto const& belongs) {
        auto const k = static_cast<std::size_t>(
            std::ranges::find_if(names, [&](auto const& n) { return n.name == stated.name; }) -
            names.begin());
        double const share = 0.5 / static_cast<double>(left--);
        auto const words = "the inflation of " + stated.name + " alone is not proved again";
        bool const nothing =
            !stated.hull || (stated.hull->lower() <= 0 && std::isinf(stated.hull->upper()));
        auto const own = restricted_to(
            base, [&](std::size_t e, measurement const& m) { return belongs(k, e, m); });
        if (k >= names.size() || own.experiments.empty()) {
            all.note(outcome::refuted, "no such part of the data: " + stated.name);
            return;
        }
        if (nothing) return;
        auto const alone = proof.bounds(own, share * limit.seconds());
        auto const found = alone.lower() <= most && most < alone.upper()
                               ? interval_traits<interval>::bounds(alone.lower(), most)
                               : alone;
        auto says = compared(found, *stated.hull);
        if (says == outcome::undecided && found.upper() <= stated.hull->upper())
            says = proof.at_least(own, stated.hull->lower(), share);
        all.note(says, words);
    };
    for (auto const& e : s)
        part(e, base.experiments,
             [](std::size_t k, std::size_t at, measurement const&) { return at == k; });
    for (auto const& e : c)
        part(e, base.model.about.channels,
             [](std::size_t k, std::size_t, measurement const& m) { return m.channel == k; });
    return all.finding("parts of the data", "scenarios and channels alone");
}

/// A part of the data that alone stands against the model.
/// @param whole  a factor for all bounds that is proved not to be enough: then it is not for some
[[nodiscard]] inline check_finding check_confined(identification_problem const& base,
                                                  confined_gap const& c, double whole,
                                                  inflation_proof const& proof) {
    using outcome = check_finding::outcome;
    auto const what = "confined " + (c.channel.empty() ? joined(c.scenarios, ", ") : c.channel);
    data_part part;
    auto const& channels = base.model.about.channels;
    for (std::size_t y = 0; y < channels.size(); ++y)
        if (channels[y].name == c.channel) part.channel = y;
    for (auto const& name : c.scenarios) {
        auto const& list = base.experiments;
        auto const e = std::ranges::find(list, name, &experiment::name);
        if (e == list.end()) return {what, outcome::refuted, "no scenario " + name};
        part.experiments.push_back(static_cast<std::size_t>(e - list.begin()));
    }
    if (!c.channel.empty() && !part.channel)
        return {what, outcome::refuted, "no channel " + c.channel};
    finding_of_all all;
    auto const times = bound_growth::of(base, part);
    auto const grown = times(base, c.factor.upper() - 1);
    std::vector<std::string> needed;
    all.note(proof.at_most(grown, c.witness, 1, &needed),
             "the witness does not explain the data with bounds so wide");
    for (auto const& a : needed)
        if (std::ranges::find(c.assumptions, a) == c.assumptions.end())
            all.note(outcome::refuted, "'" + a + "' is not assumed");
    if (c.factor.lower() > 0 && below(whole, c.factor.lower()))
        all.note(proof.none_explains(times(base, c.factor.lower() - 1), 0.2),
                 "the lower end of the factor is not proved again");
    if (c.steps) {
        auto const again = part.channel ? coarse_steps(base, part, grown) : std::nullopt;
        bool const same = again && again->size == c.steps->size && again->unit == c.steps->unit &&
                          again->cut_off == c.steps->cut_off;
        all.note(same ? outcome::verified : outcome::undecided,
                 "the steps of its readings are others");
    }
    if (c.grows) all.note(outcome::undecided, "bounds that grow with the output: not proved again");
    return all.finding(what, "its factor, from both sides");
}

} // namespace sivid::io_detail

#endif
