// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_IMPL_STRATEGY_IPP
#define SIVID_PAVING_STRATEGY_IMPL_STRATEGY_IPP

#include <sivid/paving/strategy/strategy.hpp>

#include <sivid/paving/detail/program_parts.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Without what hangs on roundings: see `rounded_within`.
[[nodiscard]] inline leftover rounded_within(leftover found, identification_problem const& asked) {
    auto const round = [](box& part, box const& whole) {
        auto inner = part.size() == whole.size() ? intersect(part, whole) : box{};
        if (inner.size() > 0 && !is_empty(inner)) part = sivid::rounded_within(inner, whole);
    };
    round(found.parameters, asked.prior);
    for (std::size_t e = 0; e < std::min(found.starts.size(), asked.experiments.size()); ++e)
        round(found.starts[e], asked.experiments[e].initial);
    return found;
}

/// Asks one contractor.
/// @returns the share of the volume that it left; less than 1 as well where starts shrank
inline double ask(contractor const& by, inquiry& asked, work_limit const& limit,
                  contraction_record& says) {
    using outcome = contraction_record::outcome;
    stopwatch const clock;
    auto const before = asked.problem().prior;
    bool const gained = asked.narrow(rounded_within(by(asked, limit, says), asked.problem()));
    double const left = std::min(1.0, relative_volume(asked.problem().prior, before).upper());
    says.seconds += clock.spent();
    says.left *= left;
    if (gained) says.how = outcome::gained;
    if (!gained && !limit() && says.how == outcome::idle) says.how = outcome::cut_short;
    return left;
}

/// Asks contractors in turn, each again when another has gained, until they rest.
/// @returns whether anything was gained
inline bool ask_in_turn(std::vector<contractor const*> const& by, std::string const& why,
                        inquiry& asked, work_limit const& limit) {
    using outcome = contraction_record::outcome;
    constexpr double idle = 0.8; // of the volume: who leaves more gives others no new chance
    auto const count = by.size();
    contraction_journal records(count);
    std::vector<char> due(count, 1);
    for (std::size_t k = 0; k < count; ++k) records[k] = {by[k]->name(), why};
    for (std::size_t k = 0; std::ranges::count(due, 1) > 0 && !asked.empty(); k = (k + 1) % count) {
        if (due[k] == 0) continue;
        due[k] = 0;
        if (!limit()) {
            if (records[k].how == outcome::idle) records[k].how = outcome::cut_short;
            continue;
        }
        bool const more = ask(*by[k], asked, limit, records[k]) < idle;
        for (std::size_t other = 0; more && other < count; ++other) due[other] = other != k;
    }
    bool gained = false;
    for (auto& r : records) {
        gained = gained || r.how == outcome::gained;
        asked.journal().push_back(std::move(r));
    }
    return gained;
}

/// Stands for the contractors that a program does not have.
class contractors_left_out : public contractor {
public:
    [[nodiscard]] std::string name() const override { return "fits and contractors"; }
    [[nodiscard]] std::string obstacle(identification_problem const&) const override {
        return "this program has none: include <sivid/paving/complete.hpp>, or link to "
               "sivid::compiled";
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const&,
                                      contraction_record&) const override {
        return asked.left();
    }
};

} // namespace paving_detail

SIVID_DECL strategy default_strategy(search_kind of) {
    auto const usual = paving_detail::parts_of_program().usual_strategy;
    if (usual != nullptr) return usual(of);
    return {{{{std::make_shared<paving_detail::contractors_left_out>()}}}};
}

SIVID_DECL void contract(strategy const& how, inquiry& asked) {
    using outcome = contraction_record::outcome;
    for (auto const& step : how.steps) {
        if (asked.empty()) return;
        auto const note = [&](contractor const& by, std::string why, outcome as) {
            asked.journal().push_back({by.name(), std::move(why), as});
        };
        std::vector<contractor const*> able;
        for (auto const& by : step.by) {
            auto obstacle = by->obstacle(asked.problem());
            if (obstacle.empty())
                able.push_back(by.get());
            else
                note(*by, std::move(obstacle), outcome::not_applicable);
        }
        if (able.empty()) continue;
        bool const late = !asked.limit()();
        auto const promise = late        ? strategy::promise{false, "no time was left"}
                             : step.when ? step.when(asked)
                                         : strategy::promise{};
        if (!promise.worth) {
            for (auto const* by : able)
                note(*by, promise.why, late ? outcome::cut_short : outcome::not_applicable);
            continue;
        }
        work_limit const own(step.share * asked.limit().seconds(), asked.limit());
        if (paving_detail::ask_in_turn(able, promise.why, asked, own) && step.ends) return;
    }
}

} // namespace sivid

#endif
