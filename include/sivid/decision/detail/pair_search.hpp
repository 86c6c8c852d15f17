// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DETAIL_PAIR_SEARCH_HPP
#define SIVID_DECISION_DETAIL_PAIR_SEARCH_HPP

#include <sivid/decision/detail/promise_types.hpp>
#include <sivid/decision/motion_cover.hpp>
#include <sivid/paving/difference_response.hpp>
#include <sivid/paving/lifted_program.hpp>
#include <sivid/paving/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// The sides of one box, then those of another.
[[nodiscard]] inline box joined(box const& a, box const& b) {
    std::vector<interval> sides(a.begin(), a.end());
    sides.insert(sides.end(), b.begin(), b.end());
    return box(std::move(sides));
}

/// Pairs of motions that an experiment cannot tell apart, in pairs of parts, and how far goals lie
/// apart in them.
class pair_search {
public:
    pair_search(prediction_problem const& problem, planned_measurements const& plan,
                std::vector<node_id> const& goals, promise_options const& options)
        : problem_(problem),
          options_(options),
          limit_(options.seconds, options.keep_going),
          outputs_(problem.model, goals) {
        options_.run.enclosure.keep_going = limit_;
        cover_ = std::make_unique<motion_cover>(
            problem, outputs_, time_cells(problem, plan.times, problem.end), options_.run);
        auto const& grid = cover_->times();
        auto const m = cover_->outputs();
        for (double const t : plan.times) {
            auto const at = std::lower_bound(grid.begin(), grid.end(), t);
            auto const k = static_cast<std::size_t>(at - grid.begin());
            for (std::size_t c = 0; c < plan.errors.size(); ++c) {
                double const e = plan.errors[c];
                if (!(e > 0)) continue;
                // The next double: a bound may be a decimal just above.
                double const twice = 2 * std::nextafter(e, HUGE_VAL);
                rows_.push_back({k * m + outputs_.channels[c], k, twice});
            }
        }
    }

    [[nodiscard]] promise operator()() {
        auto whole = cover_->whole();
        cover_->learn({&whole});
        begin(whole);
        if (whole.known->reached == 0) return result_;
        pairs_.push_back({whole, whole, {}});
        judge(pairs_.front());
        while (limit_() && pairs_.size() < options_.pairs) {
            auto const worst =
                std::max_element(pairs_.begin(), pairs_.end(), [](pair const& a, pair const& b) {
                    return (a.settled ? -1 : a.worst) < (b.settled ? -1 : b.worst);
                });
            if (pairs_.empty() || worst->settled || worst->worst <= options_.target) break;
            halve(static_cast<std::size_t>(worst - pairs_.begin()));
        }
        for (std::size_t g = 0; g < result_.goals.size(); ++g) {
            double after = 0;
            for (auto const& p : pairs_) after = std::max(after, p.bound[g]);
            result_.goals[g].after = std::min(after, result_.goals[g].most);
        }
        result_.reached = cover_->times().back();
        for (auto const& p : pairs_) {
            auto const k = std::min(p.a.known->reached, p.b.known->reached);
            result_.reached = std::min(result_.reached, k == 0 ? 0.0 : cover_->times()[k - 1]);
        }
        result_.pairs = pairs_.size();
        result_.integrations = cover_->integrations();
        return result_;
    }

private:
    using traits = interval_traits<interval>;
    struct row {
        std::size_t output, instant;
        double twice; ///< the error's bound
    };
    struct pair {
        motion_cover::part a, b;
        std::vector<double> bound; ///< of each goal of a, less that of b
        double worst = 0;          ///< of these, in what they were
        bool settled = false;      ///< cannot be halved
    };

    /// How far the goals lie apart before the experiment.
    void begin(motion_cover::part const& whole) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        if (whole.known->reached == 0) {
            result_.goals.assign(outputs_.margins.size(), {0, infinity, infinity});
            return;
        }
        auto const v = cover_->look(whole);
        for (auto const y : outputs_.margins) {
            auto const width = traits::sub(traits::point(v.high[y]), traits::point(v.low[y]));
            auto const rest = traits::mul(traits::point(4.0), traits::point(v.rest[y]));
            promised_width g;
            g.most = upper(width);
            g.before = std::max(0.0, lower(traits::sub(width, rest)));
            g.after = g.most;
            result_.goals.push_back(g);
        }
    }

    /// What is measured already says of a part's parameters, once for each integration.
    measured_responses const& heard(motion_cover::part const& p) {
        auto const [at, fresh] = heard_.try_emplace(p.known.get());
        if (fresh) {
            kept_.push_back(p.known); // its address stays its own
            if (problem_.measured)
                at->second = problem_.measured(p.known->parameters, std::function<bool()>(limit_));
        }
        return at->second;
    }

    void judge(pair& p) {
        auto const count = result_.goals.size();
        p.bound.assign(count, 0.0);
        for (std::size_t g = 0; g < count; ++g) p.bound[g] = result_.goals[g].most;
        auto const reached = std::min(p.a.known->reached, p.b.known->reached);
        if (reached > 0) {
            std::vector<compared_outputs> rows;
            for (auto const& r : rows_) {
                if (r.instant < reached)
                    rows.push_back({r.output, r.output, traits::bounds(-r.twice, r.twice)});
            }
            auto const first_goal = rows.size();
            for (auto const y : outputs_.margins) rows.push_back({y, y, traits::entire()});
            response_list known{std::make_shared<response>(
                difference_of(*p.a.known->answer, *p.b.known->answer, rows))};
            std::vector<box> starts{joined(p.a.initial, p.b.initial)};
            auto const hear = [&](motion_cover::part const& of, motion_cover::part const& other,
                                  bool other_first) {
                auto const& data = heard(of);
                for (std::size_t e = 0; e < data.known.size(); ++e) {
                    known.push_back(std::make_shared<response>(
                        beside(*data.known[e], other.parameters, other_first)));
                    starts.push_back(data.starts[e]);
                }
            };
            hear(p.a, p.b, false);
            hear(p.b, p.a, true);
            lifted_program const program(known, joined(p.a.parameters, p.b.parameters), starts,
                                         curved_share);
            for (std::size_t g = 0; g < count; ++g)
                p.bound[g] = std::min(p.bound[g], program.end_of(0, first_goal + g, true));
        }
        weigh(p);
    }
    void weigh(pair& p) const {
        p.worst = 0;
        for (std::size_t g = 0; g < p.bound.size(); ++g) {
            double const share = p.bound[g] / std::max(result_.goals[g].before, 1e-300);
            p.worst = std::max(p.worst, std::min(share, 1e300));
        }
    }

    /// The largest part of an error's bound that remainders take.
    [[nodiscard]] double blur(motion_cover::part const& p) const {
        double most = 0;
        for (auto const& r : rows_) {
            if (r.instant >= p.known->reached) return std::numeric_limits<double>::infinity();
            most = std::max(most, 2 * p.known->answer->radius[r.output] / r.twice);
        }
        return most;
    }
    /// What halving each side of a part promises: what bends the outputs, or moves the states where
    /// they are lost.
    [[nodiscard]] std::vector<double> score(motion_cover::part const& p) const {
        auto const v = cover_->look(p, true);
        if (!p.known->complete && v.reached < cover_->times().size())
            return cover_->moved_by_sides(p, v);
        std::vector<double> result(cover_->sides(), 0.0);
        for (std::size_t side = 0; side < result.size(); ++side) {
            auto const q = cover_->variable_of(p, side);
            if (q < v.curvature.size() && cover_->share(p, side) > 0)
                result[side] = v.curvature[q] + 1e-9 * cover_->share(p, side);
        }
        return result;
    }
    void halve(std::size_t index) {
        auto const whole = pairs_[index];
        auto const a = score(whole.a), b = score(whole.b);
        auto const most = [](std::vector<double> const& s) {
            return s.empty() ? 0.0 : *std::max_element(s.begin(), s.end());
        };
        bool const first = most(a) >= most(b);
        auto const& cut = first ? whole.a : whole.b;
        auto const side = motion_cover::most(first ? a : b);
        auto halves = side == motion_cover::none ? cover_->split(cut) : cover_->split(cut, side);
        if (halves.empty() || cover_->widest_share(cut) <= 1e-7) {
            pairs_[index].settled = true;
            return;
        }
        if (blur(cut) > 0.25) {
            std::vector<motion_cover::part*> fresh;
            for (auto& h : halves) fresh.push_back(&h);
            for (auto* h : fresh) h->known = nullptr;
            cover_->learn(fresh);
        }
        pairs_.erase(pairs_.begin() + static_cast<std::ptrdiff_t>(index));
        for (auto& h : halves) {
            pair next = first ? pair{h, whole.b, {}} : pair{whole.a, h, {}};
            judge(next);
            for (std::size_t g = 0; g < next.bound.size(); ++g) // what held of the whole holds
                next.bound[g] = std::min(next.bound[g], whole.bound[g]);
            weigh(next);
            bool const apart = *std::min_element(next.bound.begin(), next.bound.end()) ==
                               -std::numeric_limits<double>::infinity();
            bool const counts =
                std::any_of(next.bound.begin(), next.bound.end(), [](double x) { return x > 0; });
            if (counts && !apart) pairs_.push_back(std::move(next));
        }
    }

    /// Products that move no measurement by more than this share of its bound stay errors.
    static constexpr double curved_share = 0.01;

    prediction_problem const& problem_;
    promise_options options_;
    work_limit limit_;
    followed_outputs outputs_;
    std::unique_ptr<motion_cover> cover_;
    std::vector<row> rows_;
    std::vector<pair> pairs_;
    std::map<motion_cover::knowledge const*, measured_responses> heard_;
    std::vector<std::shared_ptr<motion_cover::knowledge const>> kept_;
    promise result_;
};

} // namespace sivid::decision_detail

#endif
