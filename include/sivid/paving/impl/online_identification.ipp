// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_ONLINE_IDENTIFICATION_IPP
#define SIVID_PAVING_IMPL_ONLINE_IDENTIFICATION_IPP

#include <sivid/paving/online_identification.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/paving/online/detail/online_paving.hpp>
#include <sivid/paving/online/detail/online_witness.hpp>
#include <sivid/paving/online/online_update.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/detail/drawing.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// What `online_identification` does.
class online_identifier {
public:
    explicit online_identifier(identification_problem problem, online_options options = {})
        : problem_(std::move(problem)), options_(std::move(options)) {
        std::vector<record> first;
        auto checked = problem_;
        for (auto& e : checked.experiments) {
            if (e.measurements.empty()) {
                e.measurements.push_back({e.begin, 0, interval_traits<interval>::entire()});
            }
            e.outliers = 0; // more may be allowed than there are measurements yet
        }
        checked.require_valid();
        if (starts_follow_parameters(problem_))
            throw std::invalid_argument("online_identification: states of effects start where "
                                        "parameters or uncertain inputs say; identify takes them");
        for (auto& e : problem_.experiments) first.push_back(std::exchange(e.measurements, {}));
        structure_ = dependence_of(problem_);
        map_ = reduction::find(problem_, structure_);
        if (options_.only_hulls) {
            options_.refinement.hull_gain = 0.02;
        }
        paving_.emplace(posed(), options_.test);
        witness_.emplace(problem_, options_.test);
        last_ = take(std::move(first));
    }
    online_identifier(online_identifier const&) = delete; // its parts refer to each other
    online_identifier& operator=(online_identifier const&) = delete;

    online_update const& add(std::vector<online_sample> const& samples) {
        std::vector<record> by_experiment(problem_.experiments.size());
        for (auto const& s : samples) {
            auto const fail = [](std::string const& what) {
                throw std::invalid_argument("online_identification: " + what);
            };
            if (s.experiment >= by_experiment.size()) fail("a measurement of no experiment");
            auto const& e = problem_.experiments[s.experiment];
            auto const where = " of experiment '" + e.name + "'";
            if (s.what.channel >= problem_.model.about.channels.size()) {
                fail("a measurement" + where + " in a channel that the model lacks");
            }
            if (!(s.what.time >= e.begin) || !std::isfinite(s.what.time)) {
                fail("a measurement" + where + " before the begin, or at no finite time");
            }
            if (is_empty(s.what.bound)) fail("a measurement" + where + " with an empty bound");
            by_experiment[s.experiment].push_back(s.what);
        }
        return last_ = take(std::move(by_experiment));
    }
    online_update const& refine() {
        if (cut_short_) fitted_at_ = 0;
        return last_ = take(std::vector<record>(problem_.experiments.size()));
    }

    [[nodiscard]] identification_problem const& problem() const { return problem_; }
    [[nodiscard]] online_update const& last() const { return last_; }

    [[nodiscard]] identification result() {
        stopwatch const clock;
        identification result(problem_.prior);
        result.assumptions.push_back(input_assumption(problem_.experiments));
        auto const& run = options_.test;
        result.reason = paving_->reason();
        bool const fit_lacks = judged_verdict() == verdict::undecided && (put_off_ || cut_short_);
        if (result.reason != stop_reason::decided && (fit_lacks || from_other_starts_))
            result.reason = stop_reason::time_budget;
        if (result.reason == stop_reason::time_budget && run.cancelled())
            result.reason = stop_reason::cancelled;
        if (!witness_->exists() && last_.verdict != verdict::inconsistent)
            witness_->find(run.keep_going);
        result.witness = witness_->get();
        result.guess = witness_->guess();
        subpaving reduced(posed().prior);
        std::vector<box> live;
        for (auto const& b : paving_->boxes()) {
            live.push_back(b.set);
            reduced.add(b.set, b.verdict);
        }
        for (auto& gap : cover(posed().prior, live).gaps) {
            reduced.add(std::move(gap), box_verdict::outside);
        }
        auto const left = reduced.outer_hull();
        if (map_) {
            inversion_options drawing;
            drawing.accuracy = options_.refinement.accuracy;
            drawing.accuracy_of_hull = true;
            paving_detail::draw(result, *map_, reduced, problem_.prior, drawing,
                                options_.drawn_boxes);
        } else {
            result.paving = std::move(reduced);
            result.hull = left;
        }
        result.verdict = judged_verdict();
        result.combinations = combinations();
        if (!paving_->boxes().empty()) {
            result.entangled = structure_.entangled;
            result.forced = forced();
        }
        result.boxes = paving_->judged();
        result.integrations = paving_->test().integrations();
        result.seconds = spent_ + clock.spent();
        return result;
    }

private:
    /// In products of parameters where that has fewer; it holds no measurements.
    [[nodiscard]] identification_problem const& posed() const {
        return map_ ? map_->problem() : problem_;
    }

    online_update take(std::vector<record> samples) {
        work_limit const limit(options_.refinement.seconds, options_.test.keep_going);
        online_update now;
        auto const judged = paving_->judged();
        auto const runs = paving_->test().integrations();
        for (std::size_t e = 0; e < samples.size(); ++e) {
            auto& all = problem_.experiments[e].measurements;
            all.insert(all.end(), samples[e].begin(), samples[e].end());
            samples_ += samples[e].size();
        }
        for (std::size_t e = 0; e < samples.size(); ++e) witness_->add(e, samples[e]);
        if (put_off_) look_for_witness(limit);
        paving_->update(samples, options_.refinement, limit);
        ask_contractors(limit);
        look_for_witness(limit);
        if (from_other_starts_ && limit()) {
            from_other_starts_ = false;
            paving_->learn_anew();
            paving_->refine(options_.refinement, limit);
        }
        now.verdict = judged_verdict();
        now.samples = samples_;
        now.combinations = combinations();
        now.hull = hull();
        now.live = paving_->boxes().size();
        now.regions = paving_->regions();
        now.judged = paving_->judged() - judged;
        now.integrations = paving_->test().integrations() - runs;
        now.seconds = limit.spent();
        spent_ += now.seconds;
        return now;
    }
    /// What is blind is told by equations, perhaps; not again for each measurement.
    void ask_contractors(work_limit const& limit) {
        bool const blind = std::any_of(paving_->boxes().begin(), paving_->boxes().end(),
                                       [](auto const& b) { return b.blind; });
        if (!blind || samples_ == 0 || 2 * samples_ < 3 * asked_at_ || !limit()) return;
        asked_at_ = samples_;
        auto left = posed();
        left.prior = paving_->hull();
        for (std::size_t e = 0; e < left.experiments.size(); ++e) {
            left.experiments[e].measurements = problem_.experiments[e].measurements;
            auto& most = left.experiments[e].outliers;
            most = std::min(most, left.experiments[e].measurements.size());
        }
        std::erase_if(left.experiments, [](experiment const& e) { return e.measurements.empty(); });
        work_limit const own(0.3 * limit.seconds(), limit);
        inquiry asked(std::move(left), limited(options_.test, own), {}, own);
        contract(options_.strategy, asked);
        if (!asked.narrowed()) return;
        paving_->restrict_to(asked.problem().prior);
        if (limit()) paving_->refine(options_.refinement, limit);
    }
    /// A fit costs more the more measurements there are: not again for each of them.
    [[nodiscard]] bool fit_is_due() const {
        return samples_ > 0 && 10 * samples_ >= 11 * fitted_at_ &&
               judged_verdict() == verdict::undecided;
    }
    /// A fit for which an update leaves no time comes first in the next; one that was cut short is
    /// gone on with in idle time, or when it is due again.
    void look_for_witness(work_limit const& limit) {
        put_off_ = fit_is_due() && !limit();
        if (put_off_ || !fit_is_due()) return;
        witness_->find(limit);
        fitted_at_ = samples_;
        cut_short_ = !limit();
        if (auto const w = witness_->get()) start_from(*w);
    }
    /// Existence is proved from the starts of the witness from now on.
    void start_from(verified_witness const& w) {
        std::vector<box> starts;
        bool uncertain = false;
        for (std::size_t e = 0; e < w.starts.size(); ++e) {
            starts.push_back(point_within(problem_.experiments[e].initial, w.starts[e]));
            uncertain = uncertain || !subset(problem_.experiments[e].initial, starts[e]);
        }
        if (!uncertain) return;
        paving_->test().set_starts(std::move(starts));
        from_other_starts_ = true;
    }

    [[nodiscard]] verdict judged_verdict() const {
        if (paving_->boxes().empty()) return verdict::inconsistent;
        if (witness_->exists()) return verdict::consistent;
        for (auto const& b : paving_->boxes()) {
            if (b.verdict != box_verdict::inside) continue;
            if (!map_) return verdict::consistent;
            // Some parameter of the prior has products in the box.
            auto const p = map_->approximate_preimage(problem_.prior, mid(b.set));
            if (contains(problem_.prior, p) && subset(map_->forward(point_box(p)), b.set)) {
                return verdict::consistent;
            }
        }
        return verdict::undecided;
    }
    [[nodiscard]] box hull() const {
        auto const left = paving_->hull();
        if (!map_ || is_empty(left)) return left;
        auto p = problem_.prior;
        for (int round = 0; round < 4 && !is_empty(p); ++round) p = map_->backward(p, left);
        return p;
    }
    [[nodiscard]] std::vector<combination_hull> combinations() const {
        if (paving_->boxes().empty()) return {};
        auto const left = paving_->hull();
        return paving_detail::hulls_of(structure_, map_ ? &left : nullptr, paving_->boxes());
    }
    /// Measurements that fail in every live box.
    [[nodiscard]] std::vector<forced_outlier> forced() const {
        std::vector<forced_outlier> result;
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e) {
            if (problem_.experiments[e].outliers == 0) continue;
            auto const& arrived = paving_->test().arrived(e);
            std::vector<std::size_t> order; // of time, as others count
            for (std::size_t n = 0; n < arrived.size(); ++n) order.push_back(n);
            std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
                auto const& x = arrived[a];
                auto const& y = arrived[b];
                return x.time < y.time || (x.time == y.time && x.channel < y.channel);
            });
            for (std::size_t i = 0; i < order.size(); ++i) {
                auto const& boxes = paving_->boxes();
                bool const always = std::all_of(boxes.begin(), boxes.end(), [&](auto const& b) {
                    return b.home &&
                           b.home->all[e].known.status(order[i], b.set) == sample_status::fails;
                });
                if (always) result.push_back({e, i});
            }
        }
        return result;
    }

    identification_problem problem_;
    online_options options_;
    dependence_structure structure_;
    std::optional<reduction> map_;
    std::optional<online_paving> paving_;
    std::optional<online_witness> witness_;
    online_update last_;
    std::size_t samples_ = 0, fitted_at_ = 0, asked_at_ = 0;
    bool put_off_ = false, cut_short_ = false; ///< the last fit
    bool from_other_starts_ = false;           ///< are the regions to be followed
    double spent_ = 0;
};

} // namespace paving_detail

SIVID_DECL online_identification::online_identification(identification_problem problem,
                                                        online_options options)
    : work_(std::make_unique<paving_detail::online_identifier>(std::move(problem),
                                                               std::move(options))) {}
SIVID_DECL online_identification::~online_identification() = default;
SIVID_DECL online_update const&
online_identification::add(std::vector<online_sample> const& samples) {
    return work_->add(samples);
}
SIVID_DECL online_update const& online_identification::refine() { return work_->refine(); }
SIVID_DECL identification_problem const& online_identification::problem() const {
    return work_->problem();
}
SIVID_DECL online_update const& online_identification::last() const { return work_->last(); }
SIVID_DECL identification online_identification::result() { return work_->result(); }

} // namespace sivid

#endif
