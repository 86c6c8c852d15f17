// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_IMPL_PLACE_ESTIMATE_IPP
#define SIVID_APPROXIMATE_PLACE_IMPL_PLACE_ESTIMATE_IPP

#include <sivid/approximate/place/detail/place_estimate.hpp>

#include <sivid/approximate/fit/detail/thinned.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/place/detail/law_search.hpp>
#include <sivid/approximate/place/detail/missing_rate.hpp>
#include <sivid/approximate/place/detail/place_search.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace approximate_detail {

/// The work of `estimate_places`.
class place_estimator {
public:
    place_estimator(identification_problem const& problem, place_options options,
                    approximate_fit const* base)
        : problem_(&problem), options_(std::move(options)), base_(base) {}

    [[nodiscard]] place_estimate operator()() {
        stopwatch const clock;
        place_estimate result;
        result.base =
            base_ != nullptr ? *base_ : approximate_fitter(*problem_, options_.search.go_on)();
        result.inflation = result.base.inflation;
        if (!(result.base.inflation <= 1) && !result.base.parameters.empty()) search(result);
        result.seconds = clock.spent();
        return result;
    }

private:
    static constexpr double plain_share = 0.8; ///< of the gain: what a law must reach to be named

    [[nodiscard]] std::string equation_name(std::string const& state) const {
        auto const named = options_.equation_names.find(state);
        return named == options_.equation_names.end() ? state : named->second;
    }
    [[nodiscard]] std::string label(place const& p) const {
        return p.kind == place_kind::sensor  ? "sensor " + p.name
               : p.kind == place_kind::input ? "input " + p.name
                                             : equation_name(p.name);
    }

    [[nodiscard]] std::vector<std::string> names_of_set(place_fitter const& fit,
                                                        std::vector<std::size_t> const& set) const {
        std::vector<std::string> list;
        for (auto const p : set) list.push_back(label(fit.places()[p]));
        return list;
    }
    /// A faulty input whose error follows no law, or is a mere gain, which parameters imitate.
    [[nodiscard]] bool doubtful_input(place_fit const& best, place_fitter& fit) const {
        auto const states = problem_->model.about.states.size();
        fit.release(best.set);
        auto const targets = fit.targets();
        for (std::size_t c = 0; c < targets.size(); ++c) {
            if (targets[c] < states) continue;
            law_search laws(fit, best);
            if (!laws.valid()) return true;
            auto const list =
                law_library(problem_->model, laws.traces()).for_input(targets[c] - states);
            auto const ranked = laws.for_target(c, list);
            if (ranked.empty() || ranked.front().share < plain_share) return true;
            if (list[ranked.front().index].text ==
                problem_->model.about.inputs[targets[c] - states].name)
                return true;
        }
        return false;
    }

    void search(place_estimate& result) {
        std::vector<bool> measured(problem_->model.observe.size(), false);
        std::vector<bool> sampled(problem_->model.about.inputs.size(), true);
        for (auto const& e : problem_->experiments) {
            for (auto const& m : e.measurements) measured[m.channel] = true;
            for (std::size_t i = 0; i < sampled.size(); ++i) {
                sampled[i] = sampled[i] && std::holds_alternative<sampled_signal>(e.inputs[i]);
            }
        }
        // A part of many samples tells which equations and sensors are wrong as well as all.
        auto const seen = thinned(*problem_, many_measurements);
        auto missed = result.base; // of these measurements
        missed.residuals = thinned(missed.residuals, thinned_indices(*problem_, many_measurements));
        place_fitter fit(seen, places_of(problem_->model, measured, sampled));
        fit.simulations().set_workers(options_.workers);
        fit.simulations().set_keep_going(options_.search.go_on);
        auto const base = fit.plain(result.base.parameters, result.base.starts);
        fit.release({});
        fit.set_scales(missing_rate_scales(fit.simulations(), fit.vector_of(base)));
        place_search sets(fit, base, options_.search);
        sets.run();
        auto best = sets.best();
        if (doubtful_input(best, fit)) {
            auto const doubtful = names_of_set(fit, best.set);
            sets.run(false);
            if (sets.best().inflation <= 1) {
                best = sets.best();
                result.alternatives.push_back(doubtful);
            } else {
                sets.run();
            }
        }
        for (auto const& t : sets.tried()) {
            result.tried.push_back({names_of_set(fit, t.set), t.inflation, t.score, t.cost});
        }
        for (auto const& a : sets.alternatives())
            result.alternatives.push_back(names_of_set(fit, a));
        result.inflation = best.inflation;
        auto const covariances = fit.covariances(best);
        for (auto const& [index, loss] : sets.ranking()) {
            auto const& where = fit.places()[index];
            estimated_place p;
            p.kind = where.kind;
            p.members = where.members;
            p.name = where.name;
            p.loss = loss;
            p.sensors = where.sensors;
            if (where.is_sensor()) {
                sensor(p, index, best, fit, missed);
            } else {
                missing(p, best, fit, covariances);
            }
            result.places.push_back(std::move(p));
        }
        name_laws(result, best, fit);
    }

    void missing(estimated_place& p, place_fit const& best, place_fitter& fit,
                 std::vector<Eigen::MatrixXd> const& covariances) const {
        auto const& about = problem_->model.about;
        auto target = p.members.front();
        if (p.kind == place_kind::input) {
            p.unit = about.inputs[target].unit;
            target += about.states.size();
        } else {
            p.unit = rate_unit(about.states[target].unit, about.time_unit);
            p.name = equation_name(p.name);
        }
        for (std::size_t e = 0; e < problem_->experiments.size(); ++e) {
            if (best.deviation.size() <= e) continue;
            p.rates.push_back({problem_->experiments[e].name, fit.simulations().knots(e),
                               best.state.missing[e][target], best.deviation[e][target]});
        }
        auto const& targets = fit.targets();
        auto const c = static_cast<std::size_t>(std::find(targets.begin(), targets.end(), target) -
                                                targets.begin());
        locate(p, covariances, targets.size(), c);
    }

    /// A sensor's fault is named after what of it moves the channel most.
    void sensor(estimated_place& p, std::size_t index, place_fit const& best, place_fitter& fit,
                approximate_fit const& base) const {
        auto const& faults = fit.extended().faults[index];
        if (fit.places()[index].askew) {
            askew(p, faults, best, fit, base);
            return;
        }
        auto const offsets = p.members.size();
        double const scale = best.state.parameters[faults.front()];
        bool const late = faults.size() > offsets + 1;
        double const delay = late ? best.state.parameters[faults[1]] : 0;
        // The member and scenario that the fault explains most.
        double most = -1;
        double by_scale = 0, by_delay = 0, by_offset = 0;
        for (std::size_t e = 0; e < problem_->experiments.size(); ++e) {
            auto const& requests = fit.simulations().requests(e);
            for (std::size_t m = 0; m < offsets; ++m) {
                double sum = 0;
                double low = HUGE_VAL, high = -HUGE_VAL, steep = 0, before = 0, since = 0;
                bool any = false;
                for (std::size_t k = 0; k < requests.size(); ++k) {
                    if (requests[k].channel != p.members[m]) continue;
                    sum += base.residuals[e][k] * base.residuals[e][k];
                    double const y = fit.simulations().centres(e)[k];
                    low = std::min(low, y);
                    high = std::max(high, y);
                    if (any && requests[k].time > since)
                        steep = std::max(steep, std::abs(y - before) / (requests[k].time - since));
                    any = true;
                    before = y;
                    since = requests[k].time;
                }
                if (!any) continue;
                by_scale =
                    std::max(by_scale, std::abs(scale) * std::max(std::abs(low), std::abs(high)));
                by_delay = std::max(by_delay, delay * steep);
                double const offset = best.state.parameters[faults[faults.size() - offsets + m]];
                by_offset = std::max(by_offset, std::abs(offset));
                if (!(sum > most)) continue;
                most = sum;
                p.scenario = problem_->experiments[e].name;
                p.from = problem_->experiments[e].begin;
                p.to = since;
                p.name = problem_->model.about.channels[p.members[m]].name;
                p.unit = problem_->model.about.channels[p.members[m]].unit;
                p.missing = offset;
                p.law = "offset";
            }
        }
        if (by_scale > by_offset && by_scale >= by_delay) {
            p.law = "scale";
            p.missing = scale;
            p.unit = "1";
        } else if (by_delay > by_offset) {
            p.law = "latency";
            p.missing = delay;
            p.unit = problem_->model.about.time_unit;
        }
    }

    /// An instrument that is mounted askew is named after the channel that it spoils most.
    void askew(estimated_place& p, std::vector<std::size_t> const& faults, place_fit const& best,
               place_fitter& fit, approximate_fit const& base) const {
        double most = -1;
        for (std::size_t e = 0; e < problem_->experiments.size(); ++e) {
            auto const& requests = fit.simulations().requests(e);
            for (std::size_t m = 0; m < 2; ++m) {
                double sum = 0, end = problem_->experiments[e].begin;
                for (std::size_t k = 0; k < requests.size(); ++k) {
                    if (requests[k].channel != p.members[m]) continue;
                    sum += base.residuals[e][k] * base.residuals[e][k];
                    end = requests[k].time;
                }
                if (!(sum > most)) continue;
                most = sum;
                auto const& channels = problem_->model.about.channels;
                p.scenario = problem_->experiments[e].name;
                p.from = problem_->experiments[e].begin;
                p.to = end;
                p.name = channels[p.members[m]].name;
                p.missing = best.state.parameters[faults[m]];
                p.unit = "1";
                p.law = std::string{"cross-talk of "} + channels[p.members[1 - m]].name;
            }
        }
    }

    void name_laws(place_estimate& result, place_fit const& best, place_fitter& fit) const {
        law_search laws(fit, best);
        auto const targets = fit.targets();
        if (targets.empty() || !laws.valid()) return;
        law_library const library(problem_->model, laws.traces());
        auto const states = problem_->model.about.states.size();
        for (std::size_t c = 0; c < targets.size(); ++c) {
            bool const input = targets[c] >= states;
            auto list = input ? library.for_input(targets[c] - states) : library.for_rates();
            auto ranked = laws.for_target(c, list);
            if (!input) propose_terms(result, targets[c], library, laws, c);
            auto const stands_out = [&ranked] {
                return !ranked.empty() && ranked.front().share >= plain_share;
            };
            if (!stands_out()) {
                list = library.beyond_levels();
                ranked = laws.for_target(c, list);
            }
            // A shape that no law has is better left without a name.
            if (!stands_out()) continue;
            for (auto& p : result.places) {
                if (p.kind == place_kind::sensor || (p.kind == place_kind::input) != input)
                    continue;
                if (p.members.front() != (input ? targets[c] - states : targets[c])) continue;
                p.law = list[ranked.front().index].text;
                p.regime = list[ranked.front().index].regime;
            }
        }
    }

    /// Terms whose shape gains a good part of what the free missing rate does, alone or beside one
    /// of the best.
    void propose_terms(place_estimate& result, std::size_t equation, law_library const& library,
                       law_search& laws, std::size_t target) const {
        auto list = library.for_rates();
        auto more = library.waves();
        std::move(more.begin(), more.end(), std::back_inserter(list));
        std::erase_if(list, [](law const& l) { return l.formula.empty() || !(l.reach() > 0); });
        auto const& state = problem_->model.about.states[equation].name;
        for (auto& p : result.places) {
            if (p.kind != place_kind::equation || p.members.front() != equation) continue;
            double most = 0;
            for (auto const& r : p.rates)
                for (double const v : r.values) most = std::max(most, std::abs(v));
            if (!(most > 0)) continue;
            // A swing finds its own frequency: those nearby would be the same.
            std::vector<double> swings;
            auto const swings_already = [&swings](double w) {
                constexpr double apart = 1.18 / 0.85;
                return std::any_of(swings.begin(), swings.end(), [w](double known) {
                    return w < apart * known && known < apart * w;
                });
            };
            auto const add = [&](std::vector<ranked_law> const& ranked, std::size_t up_to) {
                for (auto const& found : ranked) {
                    if (p.terms.size() >= up_to || found.share < least_share) return;
                    auto const& own = list[found.index];
                    double const size = rounded_to(4 * most / own.reach(), 1);
                    auto term = state + "'~" + nearest_text(size) +
                                (own.formula == "1" ? "" : "*" + own.formula);
                    bool const known =
                        std::find(p.terms.begin(), p.terms.end(), term) != p.terms.end();
                    if (known || swings_already(own.frequency)) continue;
                    if (own.frequency > 0) swings.push_back(own.frequency);
                    p.terms.push_back(std::move(term));
                }
            };
            auto const alone = laws.for_target(target, list);
            add(alone, most_alone);
            for (std::size_t k = 0; k < std::min(most_beside, alone.size()); ++k) {
                add(laws.for_target(target, list, &list[alone[k].index]),
                    p.terms.size() + most_partners);
            }
        }
    }

    identification_problem const* problem_;
    place_options options_;
    approximate_fit const* base_;
    static constexpr std::size_t most_alone = 8, most_beside = 2, most_partners = 4;
    static constexpr double least_share = 0.3; ///< of the gain: what a term must reach to be tried
};

} // namespace approximate_detail

SIVID_DECL place_estimate estimate_places(identification_problem const& problem,
                                          place_options options, approximate_fit const* base) {
    return approximate_detail::place_estimator(problem, std::move(options), base)();
}

} // namespace sivid

#endif
