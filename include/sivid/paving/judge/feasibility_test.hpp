// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_FEASIBILITY_TEST_HPP
#define SIVID_PAVING_JUDGE_FEASIBILITY_TEST_HPP

#include <sivid/model/change/added_start.hpp>
#include <sivid/model/change/detail/smoothed.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/detail/kink_ranges.hpp>
#include <sivid/paving/judge/detail/response_judgement.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/run/detail/lasting_radii.hpp>
#include <sivid/paving/run/detail/run_pool.hpp>
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/paving/set_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Tests boxes of parameters against all experiments of a problem.
///   outside: in some experiment more than `outliers` measurements certainly fail, whatever the
///   start and, within their error bounds, the inputs; inside: in every experiment at least n -
///   `outliers` certainly hold, for the recorded inputs and for some start in the box: the one
///   given to `set_starts`, or one that follows the parameters (`explaining_starts`) where none of
///   them has to (`starts_follow_parameters`).
/// The outlier rule is the consistent reading of the report's Algorithm 2.
class feasibility_test {
public:
    /// `judge` and `learn` are for several threads at once.
    static constexpr bool concurrent = true;

    /// Responses of the experiments over a region: for all starts and inputs, and for the chosen
    /// ones.
    struct knowledge {
        box region;
        response_list all_starts;
        response_list chosen_starts;
    };

    /// @given  boxes that are asked about lie within the prior, and starts within those of their
    ///         experiments: states that rest there are numbers in the runs (`region_of_runs`)
    feasibility_test(identification_problem const& problem, feasibility_test_options const& options)
        : problem_(&problem), options_(options) {
        problem.require_valid();
        follows_ = starts_follow_parameters(problem);
        records_.reserve(problem.experiments.size()); // the runs keep references
        for (auto const& e : problem.experiments) {
            auto const flow_with = [&](std::vector<signal> const& inputs) {
                return std::make_shared<flow const>(problem.model, problem.choice, inputs,
                                                    region_of_runs{e.initial, problem.prior});
            };
            flows_.push_back(flow_with(e.inputs));
            records_.push_back(sorted(e.measurements));
            starts_.push_back(e.initial);
            recorded_.push_back(flows_.back()->uncertain() ? flow_with(nominal(e.inputs))
                                                           : flows_.back());
        }
        auto const pool_of = [&](std::vector<std::shared_ptr<flow const>> const& flows) {
            return std::make_unique<run_pool>([&problem, flows, records = records_.data(),
                                               run = static_cast<run_options const&>(options)] {
                run_set runs;
                for (std::size_t e = 0; e < flows.size(); ++e) {
                    runs.push_back(make_run(*flows[e], problem.experiments[e], records[e],
                                            problem.prior, run));
                }
                return runs;
            });
        };
        pool_ = pool_of(flows_);
        for (std::size_t e = 0; e < flows_.size(); ++e) {
            lasting_.emplace_back();
            if (!flows_[e]->uncertain()) continue;
            if (!recorded_pool_) recorded_pool_ = pool_of(recorded_);
            lasting_[e] = std::make_unique<lasting_radii>(*flows_[e], problem.experiments[e],
                                                          records_[e], problem.prior, options);
        }
    }

    /// Initial states, one box per experiment within its own, from which existence is proved.
    /// States that effects added keep all of their ranges: where they follow the parameters, each
    /// has its own there.
    void set_starts(std::vector<box> starts) {
        starts_ = std::move(starts);
        for (std::size_t e = 0; e < starts_.size(); ++e)
            for (auto const& a : problem_->model.added_states)
                starts_[e][a.state] = problem_->experiments[e].initial[a.state];
    }
    [[nodiscard]] std::vector<box> const& starts() const { return starts_; }

    /// What is known from elsewhere to hold every feasible parameter (trusted): the rest of each
    /// box is cut off before it is run.
    void set_rest(box rest) {
        left_ = std::move(rest);
        first_.reset();
    }
    /// Which share of the measurements runs over a box reach from all starts; 1 when they decide
    /// it. What was found is kept for the `learn` to come.
    /// @given  nobody else works with this object meanwhile
    [[nodiscard]] double reached(box const& parameters) {
        auto found = learn({parameters});
        double const share = reached(found[0]);
        first_.emplace(parameters, std::move(found));
        return share;
    }
    /// The same of what was found about a box.
    [[nodiscard]] static double reached(assessment<knowledge> const& found) {
        std::size_t seen = 0, all = 0;
        if (found.knowledge) {
            for (auto const& r : found.knowledge->all_starts) {
                seen += r->outputs();
                all += r->measurements;
            }
        }
        return all == 0 ? 1 : static_cast<double>(seen) / static_cast<double>(all);
    }

    /// Whether it was told to stop (`enclosure_options::keep_going` of its runs).
    [[nodiscard]] bool cancelled() const { return options_.cancelled(); }

    [[nodiscard]] std::size_t integrations() const {
        return pool_->integrations() + (recorded_pool_ ? recorded_pool_->integrations() : 0);
    }
    /// In the order of time.
    [[nodiscard]] record const& record_of(std::size_t e) const { return records_[e]; }

    /// Decides and contracts by what is known, without integrating.
    [[nodiscard]] assessment<knowledge> judge(box const& parameters,
                                              std::shared_ptr<knowledge const> const& known) const {
        assessment<knowledge> result{.rest = parameters};
        if (known && options_.contract && subset(parameters, known->region)) {
            double const share = judge(*known, result);
            result.blind =
                result.verdict == box_verdict::undecided && !(share <= options_.sharp_enough);
            if (!result.blind) result.knowledge = known;
            return result;
        }
        result.blind = true;
        return result;
    }

    /// Integrates over each of the boxes, then decides and contracts.
    /// The sets depend on all the boxes, in their order: they share step orders while they are
    /// integrated together.
    [[nodiscard]] std::vector<assessment<knowledge>> learn(std::vector<box> const& boxes) {
        if (first_ && boxes.size() == 1 && same(boxes[0], first_->first)) {
            auto found = std::move(first_->second);
            first_.reset();
            return found;
        }
        auto runs = pool_->borrow();
        auto batch = start(boxes);
        for (std::size_t e = 0; e < flows_.size() && !batch.open.empty(); ++e) {
            run_all(runs, e, batch);
        }
        for (std::size_t e = 0; e < flows_.size() && !batch.open.empty(); ++e) {
            run_chosen(runs, e, batch);
        }
        for (auto const k : batch.open) {
            // `rest` may have shrunk since an experiment was judged.
            auto& result = batch.results[k];
            auto smear = std::move(result.smear);
            (void)judge(*batch.found[k], result);
            result.knowledge = std::move(batch.found[k]);
            // Runs that end at once tell nothing of the sides that come into play later: barrel of
            // an extruder (robots).
            if (reached(result) < 0.05) smear.clear();
            result.smear = std::move(smear);
        }
        return std::move(batch.results);
    }
    [[nodiscard]] std::size_t at_once() const { return pool_->at_once(); }
    /// Bytes that responses take.
    [[nodiscard]] static std::size_t bytes(knowledge const& known) {
        std::size_t sum = sizeof(knowledge);
        for (std::size_t e = 0; e < known.all_starts.size(); ++e) {
            auto const& all = known.all_starts[e];
            auto const& chosen = known.chosen_starts[e];
            sum += 2 * sizeof all + all->bytes();
            if (chosen != all) sum += chosen->bytes();
        }
        return sum;
    }

    /// One experiment over next to nothing with the recorded inputs, by the options for witnesses.
    /// Where a kink stops or blurs a point, or leaves open whether it meets its measurements, it is
    /// rounded off (`smoothed`) by little against the narrowest measurement. A trajectory that is
    /// stiff, or chatters at a kink, would take a million steps of the shortest length: it ends
    /// after `feasibility_test_options::witness_steps` and some for each knot and measurement.
    [[nodiscard]] std::shared_ptr<response const> run_finely(std::size_t e, box const& initial,
                                                             box const& parameters) {
        pool_->count(1);
        auto options = options_.witness;
        auto& most = options.maximum_steps;
        most = std::min(most, options_.witness_steps + 4 * stops(e));
        auto const run = [&](flow const& f, carried_set set, double shortest = 1) {
            auto own = options;
            own.set = set;
            own.minimum_step *= shortest;
            return (*make_run(f, problem_->experiments[e], records_[e], initial, parameters, own))(
                initial, parameters);
        };
        bool const point = paving_detail::unknown_count(initial, parameters) == 0;
        if (point && options.set == carried_set::taylor_model) {
            auto best = run(*recorded_[e], carried_set::taylor_model);
            auto const open = [&] { return on_the_brink(*best, parameters); };
            bool const sharp = best->blur() < 0.02;
            auto rest = parameters;
            if ((sharp && !open()) || assess(*best, rest).refuted) return best;
            if (auto const f = smooth_flow(e)) {
                auto smooth = run(*f, carried_set::taylor_model, 1e-8); // kinks are as narrow
                if (smooth->blur() < best->blur()) best = std::move(smooth);
            }
            if (best->blur() < detail::infinity && !(sharp && open())) return best;
            auto other = run(*recorded_[e], carried_set::doubleton);
            return other->blur() < best->blur() ? other : best;
        }
        return run(*recorded_[e], carried_set::doubleton);
    }
    /// One experiment over boxes of starts and parameters, for all possible inputs.
    [[nodiscard]] std::vector<std::shared_ptr<response const>>
    run(std::size_t e, box const& initial, std::vector<box> const& parameters) {
        auto answers = pool_->borrow()(e, initial, parameters);
        for (auto& answer : answers) answer = marked(e, answer);
        return answers;
    }
    [[nodiscard]] std::shared_ptr<response const> run(std::size_t e, box const& initial,
                                                      box const& parameters) {
        return run(e, initial, std::vector<box>{parameters})[0];
    }

private:
    /// The recorded flow without kinks; none where it has none.
    [[nodiscard]] std::unique_ptr<flow const> smooth_flow(std::size_t e) const {
        auto const& posed = problem_->experiments[e];
        auto const smooth = smoothed(problem_->model, 1e-8 * finest_share(records_[e]),
                                     ranges_in(*problem_, posed));
        if (smooth.bounds.empty()) return nullptr;
        auto inputs = nominal(posed.inputs);
        for (double const bound : smooth.bounds) {
            inputs.emplace_back(sampled_signal({posed.begin}, {0.0}, interpolation::hold, {bound}));
        }
        return std::make_unique<flow const>(smooth.model, problem_->choice, inputs,
                                            region_of_runs{posed.initial, problem_->prior});
    }
    /// Knots of the inputs and measurements until the last of them: each ends a step.
    [[nodiscard]] std::size_t stops(std::size_t e) const {
        std::size_t count = records_[e].size();
        if (records_[e].empty()) return count;
        double const end = records_[e].back().time;
        for (double t = recorded_[e]->next_knot(problem_->experiments[e].begin); t < end;
             t = recorded_[e]->next_knot(t)) {
            ++count;
        }
        return count;
    }
    /// Boxes that are integrated together.
    struct box_batch {
        std::vector<assessment<knowledge>> results;
        std::vector<std::shared_ptr<knowledge>> found;
        std::vector<std::size_t> open; ///< which of them no experiment has refuted
    };
    /// Cuts off what is known not to hold feasible parameters.
    [[nodiscard]] box_batch start(std::vector<box> const& boxes) const {
        box_batch batch;
        for (auto const& x : boxes) {
            batch.results.push_back({.rest = x});
            auto& mine = batch.results.back();
            mine.smear.assign(x.size(), 0.0);
            batch.found.push_back(std::make_shared<knowledge>());
            if (left_) {
                mine.rest = intersect(x, *left_);
                if (is_empty(mine.rest)) {
                    mine.rest = x;
                    mine.verdict = box_verdict::outside;
                    mine.proof.push_back({proof_step::kind::empty});
                    continue;
                }
                add_cuts(mine.proof, x, mine.rest);
            }
            batch.open.push_back(batch.results.size() - 1);
            batch.found.back()->region = mine.rest;
        }
        return batch;
    }
    /// Runs from all starts; boxes that the experiment refutes are open no more.
    void run_all(run_pool::loan& runs, std::size_t e, box_batch& batch) const {
        std::vector<box> regions;
        for (auto const k : batch.open) {
            // What earlier experiments cut off need not be integrated, if it is worth the
            // narrower use.
            auto& region = batch.found[k]->region;
            auto const& rest = batch.results[k].rest;
            if (relative_volume(rest, region).upper() < 0.5) region = rest;
            regions.push_back(region);
        }
        auto const answers = runs(e, problem_->experiments[e].initial, regions);
        std::vector<std::size_t> still_open;
        for (std::size_t n = 0; n < batch.open.size(); ++n) {
            auto const k = batch.open[n];
            auto& result = batch.results[k];
            ++result.cost;
            auto part = result.rest;
            result.proof.push_back({proof_step::kind::run, e});
            auto const says = assess(*answers[n], part);
            batch.found[k]->all_starts.push_back(answers[n]);
            batch.found[k]->chosen_starts.push_back(answers[n]);
            if (says.refuted) {
                result.verdict = box_verdict::outside;
                result.proof.push_back({proof_step::kind::empty});
                continue;
            }
            if (options_.contract) {
                part = rounded_within(part, result.rest);
                add_cuts(result.proof, result.rest, part);
                result.rest = std::move(part);
            }
            add_smear(result, says.smear);
            still_open.push_back(k);
        }
        batch.open = std::move(still_open);
    }
    /// Runs from the chosen starts, with inputs as recorded, over what no experiment refutes.
    void run_chosen(run_pool::loan& runs, std::size_t e, box_batch& batch) const {
        auto const& all = problem_->experiments[e].initial;
        bool const uncertain = flows_[e]->uncertain();
        if (!uncertain && (is_point(all) || !starts_differ(e))) return;
        std::vector<box> promising;
        std::vector<std::size_t> whose;
        for (auto const k : batch.open) {
            auto& answer = batch.found[k]->all_starts[e];
            if (uncertain) answer = batch.found[k]->chosen_starts[e] = marked(e, answer);
            auto part = batch.results[k].rest;
            auto const says = assess(*answer, part);
            // Not worth a run where neither the box nor, later, parts of it might hold.
            bool const sharp = answer->outputs() == answer->measurements &&
                               says.sharpness <= options_.sharp_enough;
            // Else starts that follow the parameters do as well, without a run.
            bool const spoilt = uncertain || !options_.contract || says.blur > 0.25;
            if (says.explained || says.refuted || !(says.may_hold || sharp) || !spoilt) continue;
            promising.push_back(batch.found[k]->region);
            whose.push_back(k);
        }
        if (promising.empty()) return;
        auto const chosen = uncertain ? recorded_pool_->borrow()(e, starts_[e], promising)
                                      : runs(e, starts_[e], promising);
        for (std::size_t n = 0; n < whose.size(); ++n) {
            ++batch.results[whose[n]].cost;
            batch.found[whose[n]]->chosen_starts[e] = chosen[n];
        }
    }
    /// Notes how much of the radii is due to uncertain inputs.
    [[nodiscard]] std::shared_ptr<response const>
    marked(std::size_t e, std::shared_ptr<response const> answer) const {
        if (!flows_[e]->uncertain()) return answer;
        auto own = std::make_shared<response>(*answer);
        own->lasting = (*lasting_[e])();
        return own;
    }
    static bool same(box const& x, box const& y) { return subset(x, y) && subset(y, x); }
    static bool is_point(box const& x) {
        return std::all_of(x.begin(), x.end(), interval_traits<interval>::is_point);
    }
    [[nodiscard]] bool starts_differ(std::size_t e) const {
        return !subset(problem_->experiments[e].initial, starts_[e]);
    }
    static void add_smear(assessment<knowledge>& a, std::vector<double> const& more) {
        for (std::size_t j = 0; j < a.smear.size(); ++j) a.smear[j] += more[j];
    }

    /// Contracts and decides by responses alone. @returns the largest non-affine share.
    double judge(knowledge const& known, assessment<knowledge>& a) const {
        auto found = judge_by_responses(known.all_starts, known.chosen_starts, std::move(a.rest),
                                        {options_.contract, options_.cut, !follows_});
        a.verdict = found.verdict;
        a.rest = std::move(found.rest);
        a.smear = std::move(found.smear);
        std::move(found.proof.begin(), found.proof.end(), std::back_inserter(a.proof));
        return found.share;
    }

    identification_problem const* problem_;
    feasibility_test_options options_;
    std::vector<std::shared_ptr<flow const>> flows_;
    std::vector<record> records_;
    std::vector<box> starts_;
    bool follows_ = false;    ///< some start: the parameters
    std::optional<box> left_; ///< of all parameters
    std::optional<std::pair<box, std::vector<assessment<knowledge>>>> first_; ///< learnt ahead
    std::vector<std::shared_ptr<flow const>> recorded_;   ///< `flows_`, without input errors
    std::vector<std::unique_ptr<lasting_radii>> lasting_; ///< where inputs have errors
    std::unique_ptr<run_pool> pool_;
    std::unique_ptr<run_pool> recorded_pool_; ///< where inputs have errors
};

} // namespace sivid

#endif
