// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_ANSWER_HULLS_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_ANSWER_HULLS_HPP

#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>
#include <sivid/diagnosis/candidate/detail/episode_hulls.hpp>
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/diagnosis_effort.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Bounds what an answer that explains the data leaves open: the parameters of its effects, the
/// constants of the model, when an effect begins and ends.
class answer_hulls {
public:
    answer_hulls(diagnosis_run& run, diagnosis_effort& effort, diagnosis_options const& options)
        : run_(&run), effort_(&effort), options_(&options) {}

    /// Every value that explains the data lies in what is found.
    /// @cost  searches until their hulls rest, at most for the time that is left
    void operator()() {
        auto& causes = run_->result.causes;
        if (run_->answer == 0 || causes.empty()) return;
        auto& c = causes.front();
        if (!(c.inflation.upper() <= 1)) return;
        if (!effort_->go_on("bounding the effect's parameters")) return;
        std::vector<effect> effects;
        for (auto const e : run_->candidates[run_->answer].figures.effects)
            effects.push_back(run_->catalogue[e]);
        bool const later =
            effects.size() == 1 && (effects.front().begins_later() || effects.front().ends());
        effect_hull_options options;
        options.test = effort_->test();
        options.seconds =
            std::min(of_time_left * effort_->left(), effort_->seconds_of(options_->hulls));
        options.boxes = options_->hulls.boxes;
        options.strategy = options_->strategy;
        options.tried = [this](contraction_journal const& more) {
            add(run_->result.journal, more);
        };
        options.keep_going = [this] { return effort_->go_on(); };
        run_->answer_hull = later ? explained_hull{bound_times(effects.front(), c, options)}
                                  : effect_hulls(run_->base, effects, options);
        auto const own = run_->base.prior.size();
        for (std::size_t k = 0; k < c.parameters.size(); ++k) {
            c.parameters[k].hull = run_->answer_hull.parameters[own + k];
        }
    }

private:
    static constexpr double of_time_left = 0.9; ///< a search may end a little late

    /// When the effect begins and ends; and hulls that hold whenever that is.
    [[nodiscard]] box bound_times(effect const& e, cause& c, effect_hull_options const& options) {
        auto const found = hulls_of_episodes(run_->base, e, options);
        for (std::size_t k = 0; k < e.only_in.size(); ++k) {
            auto const& all = run_->base.experiments;
            auto const s = index_of(all, e.only_in[k], "experiment");
            auto const add = [&](auto& to, double at, interval const& range) {
                to.push_back({all[s].name, run_->base.model.about.time_unit, at, range,
                              measured_time(all[s])});
            };
            if (k < e.since.size() && e.since[k] > effect::from_start)
                add(c.onsets, e.since[k], found.times[s].on);
            if (k < e.until.size() && e.until[k] < effect::for_ever)
                add(c.ends, e.until[k], found.times[s].off);
        }
        return found.parameters;
    }

    diagnosis_run* run_;
    diagnosis_effort* effort_;
    diagnosis_options const* options_;
};

} // namespace sivid

#endif
