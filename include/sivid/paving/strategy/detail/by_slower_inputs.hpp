// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_BY_SLOWER_INPUTS_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_BY_SLOWER_INPUTS_HPP

#include <sivid/model/change/detail/slower_inputs.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/detail/by_windows.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <string>

namespace sivid::paving_detail {

/// Windows, where starts are uncertain, and a search with inputs of ten samples to a line
/// (`with_slower_inputs`): where an input has a thousand samples or more, and a run at the fit
/// tells at least a quarter of the measurements to half their bounds.
class by_slower_inputs : public contractor {
public:
    [[nodiscard]] std::string name() const override { return "slower inputs"; }
    [[nodiscard]] std::string obstacle(identification_problem const& problem) const override {
        double const period = sample_period(problem);
        if (!(period > 0)) return "no input has a thousand samples";
        return with_slower_inputs(problem, 10 * period)
                   ? ""
                   : "the rates are no sum of inputs and states";
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record& says) const override {
        double const period = 10 * sample_period(asked.problem());
        auto const slow = with_slower_inputs(asked.problem(), period);
        if (!slow) return asked.left();
        inquiry slower(*slow, asked.options(), asked.search(), limit);
        if (seen_sharply(slower.test(), *slow, asked) < 0.25) {
            says.why += ", but a run at the fit is told too coarsely";
            return asked.left();
        }
        says.figures.emplace_back("input period", period);
        if (!slower.starts_known() && slower.reach() < 0.25) {
            // They are cheaper here than over the recorded inputs, and end by themselves.
            auto const left = windows_all_along()(slower, limit, says);
            says.figures.emplace_back("input period", period);
            slower.narrow(left);
        }
        auto search = asked.search();
        search.hull_gain = 0.02;
        search.keep_outside = false;
        search.proof_bytes = 0;
        search.checkpoint = nullptr;
        search.resume = nullptr;
        search.seconds = limit.seconds();
        if (!slower.empty() && search.seconds > 0) {
            auto const before = slower.integrations();
            auto const found = invert(slower.test(), slower.problem().prior, search);
            says.integrations += slower.integrations() - before;
            slower.narrow({found.paving.outer_hull()});
        }
        return slower.left();
    }

private:
    /// The share of the measurements that a run at the fit tells to half their bounds.
    [[nodiscard]] static double seen_sharply(feasibility_test& test,
                                             identification_problem const& problem,
                                             inquiry const& asked) {
        auto const point = asked.fitted();
        auto const starts = asked.fitted_starts();
        std::size_t sharp = 0, all = 0;
        for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
            auto const from =
                starts.empty() ? point_box(mid(problem.experiments[e].initial)) : starts[e];
            auto const answer = test.run(e, from, point);
            auto const values = output_ranges(*answer, point);
            for (std::size_t i = 0; i < values.size(); ++i)
                sharp += width(values[i]) <= 0.5 * width(answer->bounds[i]) ? 1 : 0;
            all += answer->measurements;
        }
        return static_cast<double>(sharp) / static_cast<double>(std::max<std::size_t>(all, 1));
    }
};

} // namespace sivid::paving_detail

#endif
