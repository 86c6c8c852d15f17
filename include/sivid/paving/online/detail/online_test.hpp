// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_ONLINE_DETAIL_ONLINE_TEST_HPP
#define SIVID_PAVING_ONLINE_DETAIL_ONLINE_TEST_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/detail/response_judgement.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/online/detail/online_region.hpp>
#include <sivid/paving/run/continued_run.hpp>
#include <sivid/paving/run/experiment_run.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Tests boxes of parameters against measurements that arrive one by one.
///   The trajectories over a region go on from where they are when a measurement is later than all
///   before; a late one costs a run of its own from the begin. A failed measurement never becomes
///   feasible again, so what is outside stays outside: the budgets of outliers do not grow.
class online_test {
public:
    using region_list = std::vector<std::shared_ptr<online_region>>;

    /// @param problem  with or without measurements; kept by reference
    online_test(identification_problem const& problem, feasibility_test_options options)
        : problem_(&problem), options_(std::move(options)) {
        for (auto const& e : problem.experiments) {
            flows_.push_back(std::make_unique<flow>(problem.model, problem.choice, e.inputs,
                                                    region_of_runs{e.initial, problem.prior}));
            static_cast<run_options&>(options_) =
                paving_detail::options_for(*flows_.back(), options_);
            runs_.push_back(make_continued_run(*flows_.back(), e, problem.prior, options_));
            arrived_.emplace_back();
            front_.push_back(e.begin);
            starts_.push_back(e.initial);
        }
    }

    /// Initial states, one box per experiment, from which existence is proved in regions to come.
    void set_starts(std::vector<box> starts) { starts_ = std::move(starts); }
    [[nodiscard]] std::size_t integrations() const { return integrations_; }
    [[nodiscard]] std::size_t at_once() const {
        std::size_t most = 1;
        for (auto const& r : runs_) most = std::max(most, r->at_once());
        return most;
    }
    /// Measurements of an experiment as they arrived; the place of one is its number.
    [[nodiscard]] record const& arrived(std::size_t e) const { return arrived_[e]; }

    /// Tells all regions of new measurements of an experiment.
    void add(std::size_t e, record const& samples, region_list const& regions) {
        std::vector<std::size_t> numbers;
        for (auto const& s : samples) {
            numbers.push_back(arrived_[e].size());
            arrived_[e].push_back(s);
        }
        std::vector<online_region::run_state*> runs;
        region_list owners;
        for (auto const& r : regions) {
            r->for_each_run(e, [&](auto& run) {
                runs.push_back(&run);
                owners.push_back(r);
            });
        }
        std::vector<std::size_t> timely, late;
        for (auto const n : numbers) {
            (arrived_[e][n].time < front_[e] ? late : timely).push_back(n);
        }
        std::vector<arrivals> found(runs.size());
        carry(e, timely, runs, found);
        look_back(e, late, runs, owners, found);
        for (std::size_t k = 0; k < runs.size(); ++k) deliver(*owners[k], *runs[k], found[k]);
        for (auto const n : timely) front_[e] = std::max(front_[e], arrived_[e][n].time);
    }

    /// Integrates over boxes, from the begin to the last measurement.
    /// @returns for each box its region; `refuted` when the measurements exclude all of it
    [[nodiscard]] region_list learn(std::vector<box> const& boxes) {
        region_list result;
        for (auto const& x : boxes) {
            result.push_back(std::make_shared<online_region>());
            result.back()->domain = result.back()->live = x;
        }
        for (std::size_t e = 0; e < runs_.size(); ++e) {
            auto const& initial = problem_->experiments[e].initial;
            std::vector<online_region::run_state*> runs;
            region_list owners;
            for (auto const& r : result) {
                r->all.push_back(begin(e, initial, r->domain));
                r->chosen.emplace_back();
                if (!subset(initial, starts_[e])) {
                    r->chosen[e].emplace(begin(e, starts_[e], r->domain));
                }
            }
            for (auto const& r : result) {
                if (r->refuted) continue;
                r->for_each_run(e, [&](auto& run) {
                    runs.push_back(&run);
                    owners.push_back(r);
                });
            }
            std::vector<std::size_t> numbers;
            for (std::size_t n = 0; n < arrived_[e].size(); ++n) numbers.push_back(n);
            std::vector<arrivals> found(runs.size());
            carry(e, numbers, runs, found);
            for (std::size_t k = 0; k < runs.size(); ++k) {
                deliver(*owners[k], *runs[k], found[k]);
                runs[k]->known.forget_news();
            }
        }
        return result;
    }

    /// Decides and contracts a part of a region; see `judge_by_responses`.
    [[nodiscard]] response_judgement judge(online_region const& r, box const& part) const {
        return judge_by_responses(r.responses(false), r.responses(true), part,
                                  {options_.contract, options_.cut});
    }
    /// Whether trajectories over the part alone would say more.
    [[nodiscard]] bool blind(response_judgement const& j) const {
        return j.verdict == box_verdict::undecided && !(j.share <= options_.sharp_enough);
    }

private:
    struct arrivals {
        std::vector<growing_response::arrival> seen;
        std::vector<std::size_t> missed;
        std::size_t failed = 0; ///< as it seems
    };

    [[nodiscard]] online_region::run_state begin(std::size_t e, box const& starts,
                                                 box const& parameters) {
        ++integrations_;
        carried_family family(*runs_[e], starts, parameters);
        auto const q = problem_->experiments[e].outliers;
        growing_response known(runs_[e]->unknowns(family.id()), runs_[e]->table(family.id()), q);
        return {starts, std::move(family), std::move(known)};
    }

    /// Carries families on to the measurements with these numbers, in the order of their times.
    void carry(std::size_t e, std::vector<std::size_t> numbers,
               std::vector<online_region::run_state*> const& runs, std::vector<arrivals>& found) {
        auto const& samples = arrived_[e];
        std::stable_sort(numbers.begin(), numbers.end(), [&](std::size_t a, std::size_t b) {
            return samples[a].time < samples[b].time;
        });
        for (std::size_t from = 0; from < numbers.size();) {
            double const time = samples[numbers[from]].time;
            std::vector<std::size_t> together;
            std::vector<std::size_t> channels;
            for (; from < numbers.size() && samples[numbers[from]].time == time; ++from) {
                together.push_back(numbers[from]);
                channels.push_back(samples[numbers[from]].channel);
            }
            std::vector<continued_run::family> families;
            std::vector<std::size_t> whose;
            for (std::size_t k = 0; k < runs.size(); ++k) {
                if (runs[k]->family) {
                    families.push_back(runs[k]->family->id());
                    whose.push_back(k);
                } else {
                    found[k].missed.insert(found[k].missed.end(), together.begin(), together.end());
                }
            }
            auto outputs = runs_[e]->read(families, time, channels);
            for (std::size_t f = 0; f < families.size(); ++f) {
                auto& own = found[whose[f]];
                bool hopeless = true;
                auto& failed = own.failed;
                for (std::size_t c = 0; c < outputs[f].size(); ++c) {
                    auto& y = outputs[f][c];
                    auto const& bound = samples[together[c]].bound;
                    hopeless = hopeless && paving_detail::is_hopeless(y.radius, y.spread(), bound,
                                                                      options_.hopeless);
                    double const reach = (y.spread() + y.radius) * (1 + 1e-9);
                    double const least = y.coefficients[0] - reach;
                    double const most = y.coefficients[0] + reach;
                    failed += least > bound.upper() || most < bound.lower() ? 1 : 0;
                    own.seen.push_back({together[c], bound, std::move(y)});
                }
                if (outputs[f].empty()) {
                    own.missed.insert(own.missed.end(), together.begin(), together.end());
                }
                // Refuted: `deliver` proves it, so the rest need not be integrated.
                if (hopeless || failed > problem_->experiments[e].outliers) {
                    runs[whose[f]]->family.reset();
                }
            }
        }
    }

    /// Runs from the begin to measurements that are earlier than what came before.
    void look_back(std::size_t e, std::vector<std::size_t> const& numbers,
                   std::vector<online_region::run_state*> const& runs, region_list const& owners,
                   std::vector<arrivals>& found) {
        if (numbers.empty()) return;
        std::vector<online_region::run_state> again;
        again.reserve(runs.size());
        std::vector<online_region::run_state*> fresh;
        for (std::size_t k = 0; k < runs.size(); ++k) {
            again.push_back(begin(e, runs[k]->starts, owners[k]->domain));
            fresh.push_back(&again.back());
        }
        carry(e, numbers, fresh, found);
    }

    static void deliver(online_region& r, online_region::run_state& run, arrivals const& found) {
        run.known.take(found.seen, r.live);
        for (auto const n : found.missed) run.known.miss(n);
        bool const for_all = std::any_of(r.all.begin(), r.all.end(),
                                         [&](auto const& other) { return &other == &run; });
        if (for_all && run.known.refuted()) r.refuted = true;
    }

    identification_problem const* problem_;
    feasibility_test_options options_;
    std::vector<std::unique_ptr<flow>> flows_;
    std::vector<std::unique_ptr<continued_run>> runs_;
    std::vector<record> arrived_;
    std::vector<double> front_; ///< where the trajectories of each experiment are
    std::vector<box> starts_;
    std::size_t integrations_ = 0;
};

} // namespace sivid

#endif
