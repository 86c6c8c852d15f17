// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_EXCLUSION_CHECK_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_EXCLUSION_CHECK_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/paving/run/further_runs.hpp>
#include <sivid/paving/run/plain_run.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

/// Walks along a proof of what is excluded: keeps the current box, what is known of it, and what no
/// step has proved. Steps that make no sense change nothing, so that whatever the proof says the
/// boxes that are left open hold all that is neither proved nor in a row.
class proof_walk {
public:
    /// @param rows  boxes of which nothing is claimed
    /// @param keep_going  once false, rows may be in what is left open; may be empty
    proof_walk(box const& prior, std::vector<box> rows, std::size_t experiments,
               std::function<bool()> keep_going = nullptr)
        : rows_(std::move(rows)), keep_going_(std::move(keep_going)) {
        std::vector<std::size_t> all(rows_.size());
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
        waiting_.push_back({prior, response_list(experiments), std::move(all)});
    }

    [[nodiscard]] bool done() const { return waiting_.empty(); }
    /// The current box. @given  not `done()`
    [[nodiscard]] box const& cell() const { return waiting_.back().set; }

    /// @param found  of an experiment over the current box
    void learn(std::size_t experiment, std::shared_ptr<response const> found) {
        waiting_.back().known[experiment] = std::move(found);
    }

    /// @param excluded  whether what is known proves that a part of the current box holds nothing:
    ///   (response_list, box) -> bool
    template <class Excluded>
    void take(proof_step const& step, Excluded const& excluded) {
        using kind = proof_step::kind;
        auto& now = waiting_.back();
        bool const has_side = step.index < now.set.size();
        if (step.what == kind::cut && has_side) {
            auto const part = beyond(now.set, step);
            if (is_empty(part)) return;
            if (!excluded(now.known, part)) leave(part, now.rows);
            now.set = before(now.set, step);
            if (is_empty(now.set)) waiting_.pop_back();
        } else if (step.what == kind::split && has_side) {
            if (!contains(now.set[step.index], step.at)) return;
            auto [low, high] = bisect(now.set, step.index, step.at);
            auto upper = now;
            for (auto* const half : {&low, &high}) {
                auto& to = half == &low ? now : upper;
                to.set = std::move(*half);
                std::erase_if(to.rows,
                              [&](std::size_t k) { return is_empty(intersect(rows_[k], to.set)); });
            }
            std::swap(now, upper); // the lower half is next
            waiting_.push_back(std::move(upper));
        } else if (step.what == kind::empty || step.what == kind::leaf) {
            if (step.what == kind::leaf || !excluded(now.known, now.set)) leave(now.set, now.rows);
            waiting_.pop_back();
        }
    }

    /// What is in no row and was not proved, that to which no step came included.
    [[nodiscard]] std::vector<box> open() && {
        for (auto const& w : waiting_) leave(w.set, w.rows);
        return std::move(open_);
    }

private:
    struct place {
        box set;
        response_list known; ///< by experiment, null where nothing is known
        std::vector<std::size_t> rows;
    };

    void leave(box const& part, std::vector<std::size_t> const& rows) {
        std::vector<box> meeting;
        if (keep_going_ && !keep_going_()) {
            open_.push_back(part);
            return;
        }
        for (auto const k : rows) {
            auto common = intersect(rows_[k], part);
            if (subset(part, common)) return;
            if (!is_empty(common)) meeting.push_back(std::move(common));
        }
        for (auto& gap : cover(part, meeting, 2e-15, keep_going_).gaps)
            open_.push_back(std::move(gap));
    }

    std::vector<box> rows_;
    std::function<bool()> keep_going_;
    std::vector<place> waiting_; ///< the current one last
    std::vector<box> open_;
};

/// The certificate of an exclusion, evaluated: \f$ \sum_i w_i (y_i(p, x_0) - b_i) \f$ over a box of
/// parameters and all starts, where \f$ b_i \f$ is the upper end of measurement i for a positive
/// weight and the lower one for a negative. Who meets all weighted measurements makes no term
/// positive; where the sum is positive throughout, nobody does.
///   Written apart from what proposes the weights and from the certificates of the search, in the
///   arithmetic of I.
/// @tparam I  interval type
template <class I>
class weighted_outputs {
    using traits = interval_traits<I>;

public:
    /// @param known    of boxes of parameters around `part`; null where an experiment is not known
    /// @param weights  (experiment, output, weight), of measurements that are bounded in the
    ///                 direction of their weights
    weighted_outputs(response_list const& known, box const& part,
                     std::vector<measurement_weight> const& weights) {
        std::size_t unknowns = part.size();
        for (std::size_t e = 0; e < known.size(); ++e) {
            if (!known[e]) continue;
            auto const& r = *known[e];
            std::vector<I> c(r.table->size(), traits::point(0.0));
            bool any = false;
            for (auto const& w : weights) {
                if (w.experiment != e) continue;
                any = true;
                take(r, w, c);
            }
            if (any) place(r, part, unknowns, std::move(c));
            for (auto const& side : r.unknowns.initial) unknowns += side.radius > 0 ? 1 : 0;
        }
    }

    /// Whether the sum is positive throughout, by proof.
    [[nodiscard]] bool positive() const {
        I least = constant_;
        for (auto const& [e, c] : terms_) {
            bool const even =
                std::all_of(e.begin(), e.end(), [](auto const& f) { return f.second % 2 == 0; });
            double const size = traits::mag(c);
            if (!std::isfinite(size)) return false;
            if (even && traits::lower(c) >= 0) continue; // never below 0
            least = traits::sub(least, traits::bounds(0.0, size));
        }
        return traits::lower(least) > 0;
    }

private:
    /// Unknowns with their powers, those of power 0 left out.
    using monomial = std::vector<std::pair<std::size_t, std::uint8_t>>;

    void take(response const& r, measurement_weight const& w, std::vector<I>& c) {
        I const weight = traits::point(w.value);
        double const end = w.value > 0 ? r.bounds[w.output].upper() : r.bounds[w.output].lower();
        constant_ = traits::sub(constant_, traits::mul(weight, traits::point(end)));
        double const radius = r.radius[w.output];
        constant_ = traits::add(constant_, traits::mul(weight, traits::bounds(-radius, radius)));
        for (std::size_t m = 0; m < c.size(); ++m) {
            double const own = r.coefficients[m * r.outputs() + w.output];
            c[m] = traits::add(c[m], traits::mul(weight, traits::point(own)));
        }
    }

    /// Adds the polynomial in the unknowns of the part: \f$ q = middle + reach \, d \f$.
    void place(response const& r, box const& part, std::size_t first_start, std::vector<I> c) {
        auto const n = r.table->variables;
        std::vector<std::size_t> unknown(n, 0);
        std::vector<I> middle(n, traits::point(0.0)), reach(n, traits::point(1.0));
        typename traits::mask undefined{};
        for (std::size_t j = 0; j < part.size(); ++j) {
            auto const& side = r.unknowns.parameters[j];
            if (side.radius == 0) continue;
            I const radius = traits::point(side.radius);
            I const off = traits::sub(traits::point(mid(part[j])), traits::point(side.centre));
            unknown[side.variable] = j;
            middle[side.variable] = traits::div(off, radius, undefined);
            reach[side.variable] = traits::div(traits::point(rad(part[j])), radius, undefined);
        }
        for (auto const& side : r.unknowns.initial) {
            if (side.radius > 0) unknown[side.variable] = first_start++;
        }
        for (std::size_t v = 0; v < n; ++v) {
            if (traits::mag(middle[v]) == 0) continue;
            r.table->shift(v, [&](std::size_t m, std::size_t k) {
                c[m] = traits::add(c[m], traits::mul(middle[v], c[k]));
            });
        }
        for (std::size_t m = 0; m < c.size(); ++m) {
            monomial e;
            for (std::size_t v = 0; v < n; ++v) {
                auto const power = r.table->exponents[m][v];
                if (power == 0) continue;
                e.emplace_back(unknown[v], power);
                for (std::size_t k = 0; k < power; ++k) c[m] = traits::mul(c[m], reach[v]);
            }
            if (e.empty()) {
                constant_ = traits::add(constant_, c[m]);
                continue;
            }
            std::sort(e.begin(), e.end());
            auto const [term, is_new] = terms_.emplace(std::move(e), c[m]);
            if (!is_new) term->second = traits::add(term->second, c[m]);
        }
        if (undefined) constant_ = traits::entire();
    }

    I constant_ = traits::point(0.0);
    std::map<monomial, I> terms_;
};

/// Whether weights prove that no parameter of a part explains the data.
///   Whoever explains the data violates at most the allowed outliers, so a group of measurements
///   that share none with another is met in the whole when there is a group more than outliers
///   allowed to the experiments in the groups. Each group is proved to be met by nobody.
/// @param known   of boxes of parameters around `part`; null where an experiment is not known
/// @param groups  from anywhere: what names no measurement, or shares one, proves nothing
template <class I>
[[nodiscard]] bool weights_exclude(response_list const& known, box const& part,
                                   proof_step::groups const& groups) {
    std::set<std::pair<std::size_t, std::size_t>> seen;
    std::set<std::size_t> experiments;
    for (auto const& group : groups) {
        std::set<std::pair<std::size_t, std::size_t>> own;
        for (auto const& w : group) {
            if (w.experiment >= known.size() || !known[w.experiment]) return false;
            auto const& r = *known[w.experiment];
            if (w.output >= r.outputs() || !std::isfinite(w.value)) return false;
            auto const& bound = r.bounds[w.output];
            if (!std::isfinite(w.value > 0 ? bound.upper() : bound.lower())) return false;
            experiments.insert(w.experiment);
            if (r.allowed > 0) own.insert({w.experiment, w.output});
        }
        for (auto const& m : own) {
            if (!seen.insert(m).second) return false;
        }
    }
    std::size_t allowed = 0;
    for (auto const e : experiments) allowed += known[e]->allowed;
    return groups.size() > allowed &&
           std::all_of(groups.begin(), groups.end(), [&](auto const& group) {
               return weighted_outputs<I>(known, part, group).positive();
           });
}

/// Encloses the outputs that a response states for a start and parameters.
/// @given  points of the boxes that it is of
[[nodiscard]] inline std::vector<interval>
outputs_at(response const& r, std::vector<double> const& start, std::vector<double> const& p) {
    using traits = interval_traits<interval>;
    std::vector<interval> q(r.table->variables, interval(0.0));
    bool undefined = false;
    auto const place = [&](auto const& sides, std::vector<double> const& x) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            auto const& s = sides[i];
            if (s.radius == 0) continue;
            q[s.variable] = traits::div(traits::sub(traits::point(x[i]), traits::point(s.centre)),
                                        traits::point(s.radius), undefined);
        }
    };
    place(r.unknowns.initial, start);
    place(r.unknowns.parameters, p);
    std::vector<interval> y;
    for (double const radius : r.radius) y.push_back(traits::bounds(-radius, radius));
    for (std::size_t m = 0; m < r.table->size(); ++m) {
        auto term = traits::point(1.0);
        for (std::size_t v = 0; v < q.size(); ++v) {
            for (unsigned k = 0; k < r.table->exponents[m][v]; ++k) term = traits::mul(term, q[v]);
        }
        for (std::size_t k = 0; k < y.size(); ++k) {
            double const c = r.coefficients[m * r.outputs() + k];
            y[k] = traits::add(y[k], traits::mul(traits::point(c), term));
        }
    }
    return y;
}

/// Holds responses against another integrator: at a point of their boxes the outputs by sets of
/// first order, in the arithmetic of I, must meet what the response states for the point. Of two
/// enclosures of one number that share none, one is wrong.
///   It proves nothing; it makes a defect show that all Taylor models have in common.
/// @cost  one run of a point each time
template <class I>
class response_audit {
public:
    response_audit(identification_problem const& problem, enclosure_options const& options)
        : problem_(&problem), options_(options), runs_(problem.experiments.size()) {}

    /// @returns false for a contradiction
    [[nodiscard]] bool operator()(response const& r, std::size_t e, box const& region) {
        auto const& own = problem_->experiments[e];
        if (!runs_[e]) {
            runs_[e] =
                std::make_unique<plain_run<I>>(problem_->model, problem_->choice, own, options_);
        }
        auto const start = drawn(own.initial), p = drawn(region);
        auto const seen = (*runs_[e])(point_box(start), point_box(p)).outputs;
        auto const stated = outputs_at(r, start, p);
        for (std::size_t k = 0; k < std::min(seen.size(), stated.size()); ++k) {
            auto const& value = seen[k].value;
            if (!seen[k].defined) continue;
            if (interval_traits<I>::lower(value) > stated[k].upper() ||
                interval_traits<I>::upper(value) < stated[k].lower()) {
                return false;
            }
        }
        return true;
    }

private:
    /// A point of a box: each coordinate an end or anywhere between.
    [[nodiscard]] std::vector<double> drawn(box const& x) {
        std::vector<double> point;
        for (auto const& side : x) {
            double const share = std::uniform_real_distribution<double>(-0.5, 1.5)(random_);
            double const at =
                side.lower() + std::clamp(share, 0.0, 1.0) * (side.upper() - side.lower());
            point.push_back(std::clamp(at, side.lower(), side.upper()));
        }
        return point;
    }

    identification_problem const* problem_;
    enclosure_options options_;
    std::vector<std::unique_ptr<plain_run<I>>> runs_;
    std::mt19937_64 random_{1};
};

/// Follows the proof of what a search excluded: Taylor models in scalars over the boxes that it
/// names, and its weights of the measurements, proved by `weighted_outputs` in the arithmetic of I.
///   Neither the packs of the search nor its decisions and its splitting take part.
template <class I>
class exclusion_check {
public:
    exclusion_check(identification_problem const& problem, certificate_options const& options,
                    run_options const& how = {})
        : problem_(&problem),
          audit_(problem, options),
          limit_(options.seconds, options.keep_going) {
        samples_.reserve(problem.experiments.size()); // the runs keep references
        for (auto const& e : problem.experiments) {
            flows_.push_back(std::make_unique<flow>(problem.model, problem.choice, e.inputs));
            samples_.push_back(sorted(e.measurements));
            runs_.push_back(
                make_scalar_run(*flows_.back(), e, samples_.back(), e.initial, problem.prior, how));
        }
    }

    /// Whether the time is up.
    [[nodiscard]] bool over() const { return !limit_(); }

    /// Follows a proof from the prior on.
    /// @param rows  of which nothing is claimed
    /// @returns  boxes that hold all of the prior that is in no row and not proved to be excluded;
    ///           once it is `over`, of rows as well
    [[nodiscard]] std::vector<box> follow(exclusion_proof const& proof,
                                          std::vector<box> const& rows) {
        proof_walk walk(problem_->prior, rows, runs_.size(), [this] { return !over(); });
        for (auto const& step : proof) {
            if (walk.done() || over()) break;
            if (step.what == proof_step::kind::run) {
                if (step.index < runs_.size()) walk.learn(step.index, run(step.index, walk.cell()));
                continue;
            }
            walk.take(step, [&](response_list const& known, box const& part) {
                bool const proved = weights_exclude<I>(known, part, step.why);
                steps_ += proved ? 1 : 0;
                return proved;
            });
        }
        return std::move(walk).open();
    }
    /// Steps of proofs that were proved.
    [[nodiscard]] std::size_t steps() const { return steps_; }

    /// Enclosures that sets of first order contradict at a point: a defect. They prove nothing.
    [[nodiscard]] std::size_t contradictions() const { return contradictions_; }

private:
    /// One experiment over a region; nothing where two integrators contradict each other.
    [[nodiscard]] std::shared_ptr<response const> run(std::size_t e, box const& region) {
        auto found = (*runs_[e])(problem_->experiments[e].initial, region);
        if (audit_(*found, e, region)) return found;
        ++contradictions_;
        return nullptr;
    }

    identification_problem const* problem_;
    response_audit<I> audit_;
    std::vector<std::unique_ptr<flow>> flows_;
    std::vector<record> samples_;
    std::vector<std::unique_ptr<experiment_run>> runs_;
    std::size_t contradictions_ = 0, steps_ = 0;
    work_limit limit_;
};

} // namespace sivid

#endif
