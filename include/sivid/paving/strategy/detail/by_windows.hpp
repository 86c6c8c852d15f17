// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_BY_WINDOWS_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_BY_WINDOWS_HPP

/// @file
/// Contractors that integrate over windows of the records (`contract_by_windows`).

#include <sivid/measurement/signal.hpp>
#include <sivid/model/change/detail/slower_inputs.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/states_seen.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/detail/equation_guide.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace sivid::paving_detail {

/// The time between two samples of the fastest input with a thousand of them or more; 0: none.
inline double sample_period(identification_problem const& problem) {
    double least = HUGE_VAL;
    for (auto const& e : problem.experiments) {
        double const end = e.end();
        for (auto const& s : e.inputs) {
            auto const* const u = std::get_if<sampled_signal>(&s);
            if (u == nullptr) continue;
            auto const& t = u->times();
            auto const knots = std::upper_bound(t.begin(), t.end(), end) -
                               std::upper_bound(t.begin(), t.end(), e.begin);
            if (knots < 1000) continue;
            least = std::min(least, (end - e.begin) / static_cast<double>(knots));
        }
    }
    return std::isfinite(least) ? least : 0;
}

/// Windows begin in boxes of states and take no part where outliers are allowed.
class by_windows : public contractor {
public:
    [[nodiscard]] std::string obstacle(identification_problem const& problem) const override {
        if (problem.model.has_memory()) return "the model has delays";
        if (!problem.model.added_states.empty()) return "effects have states of their own";
        bool const any = std::ranges::any_of(problem.experiments,
                                             [](experiment const& e) { return e.outliers == 0; });
        return any ? "" : "every record may have outliers";
    }

protected:
    [[nodiscard]] static window_options options_for(inquiry const& asked, work_limit const& limit) {
        return {.run = asked.options(),
                .seconds = limit.seconds(),
                .keep_going = limit,
                .workers = asked.search().workers};
    }
    [[nodiscard]] static leftover left_by(window_contraction found, contraction_record& says) {
        says.integrations += found.windows;
        says.figures = {{"windows", static_cast<double>(found.windows)},
                        {"longest window", found.longest}};
        if (found.windows > 0 && !(found.longest > 0))
            says.why += "; no window of the records can be carried from starts so wide: state them "
                        "more narrowly, or give samples nearer to them";
        return {std::move(found.rest), std::move(found.starts)};
    }
};

/// One window of each record, from its begin, which grows as the prior shrinks.
class growing_window : public by_windows {
public:
    [[nodiscard]] std::string name() const override { return "growing window"; }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record& says) const override {
        auto how = options_for(asked, limit);
        how.chained = 1;
        return left_by(contract_by_windows(asked.problem(), how), says);
    }
};

/// One window after the other, each in the states that the one before it has left.
class windows_all_along : public by_windows {
public:
    [[nodiscard]] std::string name() const override { return "windows all along"; }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record& says) const override {
        return left_by(contract_by_windows(asked.problem(), options_for(asked, limit)), says);
    }
};

/// Windows all along the records, with slower inputs where there are any, in states that equations
/// know. For what equations have told something of while runs over what they left end early all the
/// same, such as an arm with dry friction.
class guided_windows : public by_windows {
public:
    [[nodiscard]] std::string name() const override { return "guided windows"; }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record& says) const override {
        auto const& posed = asked.problem();
        auto seen = posed;
        seen.model = with_states_seen(posed.model, "recorded state ");
        double const period = 10 * sample_period(posed);
        auto const slow = period > 0 ? with_slower_inputs(seen, period) : std::nullopt;
        auto const& carried = slow ? *slow : posed;
        equation_guide const guide(posed, carried, limit);
        auto how = options_for(asked, limit);
        how.windows = 16; // all along, eight side by side
        how.equations = std::cref(guide);
        auto result = left_by(contract_by_windows(carried, how), says);
        if (slow) says.figures.emplace_back("input period", period);
        return result;
    }
};

} // namespace sivid::paving_detail

#endif
