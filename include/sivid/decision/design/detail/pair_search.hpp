// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DESIGN_DETAIL_PAIR_SEARCH_HPP
#define SIVID_DECISION_DESIGN_DETAIL_PAIR_SEARCH_HPP

#include <sivid/decision/design/promise_types.hpp>
#include <sivid/decision/motion/detail/motion_cover.hpp>
#include <sivid/number/rounding.hpp>
#include <sivid/paving/contract/detail/lifted_program.hpp>
#include <sivid/paving/response/detail/difference_response.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// The sides of one box, then those of another.
[[nodiscard]] inline box joined(box const& a, box const& b) {
    std::vector<interval> sides(a.begin(), a.end());
    sides.insert(sides.end(), b.begin(), b.end());
    return box(std::move(sides));
}

/// Pairs of motions that an experiment cannot tell apart, in pairs of parts: how far goals lie
/// apart in them, or, of two different models, whether there are any.
class pair_search {
public:
    /// Pairs of the same model.
    pair_search(prediction_problem const& problem, planned_measurements const& plan,
                std::vector<node_id> const& goals, promise_options const& options)
        : pair_search(plan, options) {
        motions_.push_back(std::make_unique<motion_set>(problem, plan, goals, options_.run));
    }
    /// Pairs of two models.
    pair_search(prediction_problem const& first, prediction_problem const& second,
                planned_measurements const& plan, promise_options const& options)
        : pair_search(plan, options) {
        options_.target = 0; // none may be left
        for (auto const* p : {&first, &second})
            motions_.push_back(
                std::make_unique<motion_set>(*p, plan, std::vector<node_id>{}, options_.run));
    }

    [[nodiscard]] promise operator()() {
        auto first = of_first().cover.whole(), second = of_second().cover.whole();
        of_first().cover.learn({&first});
        second.known = first.known;
        if (two_models()) of_second().cover.learn({&second});
        begin(first);
        if (first.known->reached == 0 || second.known->reached == 0) return result_;
        pairs_.push_back({first, second, {}});
        judge(pairs_.front());
        if (two_models() && pairs_.front().apart) pairs_.clear();
        while (limit_() && !pairs_.empty() && pairs_.size() < options_.pairs) {
            auto const worst =
                std::max_element(pairs_.begin(), pairs_.end(), [](pair const& a, pair const& b) {
                    return (a.settled ? -1 : a.worst) < (b.settled ? -1 : b.worst);
                });
            if (worst->settled || worst->worst <= options_.target) break;
            halve(static_cast<std::size_t>(worst - pairs_.begin()));
        }
        for (std::size_t g = 0; g < result_.goals.size(); ++g) {
            double after = 0;
            for (auto const& p : pairs_) after = std::max(after, p.bound[g]);
            result_.goals[g].after = std::min(after, result_.goals[g].most);
        }
        result_.reached = of_first().cover.times().back();
        for (auto const& p : pairs_)
            result_.reached =
                std::min({result_.reached, reached(of_first(), p.a), reached(of_second(), p.b)});
        result_.told_apart = two_models() && pairs_.empty();
        result_.pairs = pairs_.size();
        for (auto const& m : motions_) result_.integrations += m->cover.integrations();
        return result_;
    }

private:
    using traits = interval_traits<interval>;
    /// What is measured of a motion.
    struct row {
        std::size_t output, instant;
    };
    /// The motions of a model, and what the plan measures of them.
    struct motion_set {
        prediction_problem const& problem;
        followed_outputs outputs;
        motion_cover cover;
        std::vector<row> rows;

        motion_set(prediction_problem const& p, planned_measurements const& plan,
                   std::vector<node_id> const& goals, run_options const& run)
            : problem(p),
              outputs(p.model, goals),
              cover(p, outputs, time_cells(p, plan.times, p.end), run) {
            plan.for_each([&](double t, std::size_t c, double) {
                auto const k = cover.instant_of(t);
                rows.push_back({k * cover.outputs() + outputs.channels[c], k});
            });
        }
    };
    struct pair {
        motion_cover::part a, b;
        std::vector<double> bound; ///< of each goal of a, less that of b
        double worst = 0;          ///< of these, in what they were; of two models: how wide it is
        bool settled = false;      ///< cannot be halved
        bool apart = false;        ///< the experiment tells all of these pairs apart
    };

    pair_search(planned_measurements const& plan, promise_options const& options)
        : options_(options), limit_(options.seconds, options.keep_going) {
        options_.run.keep_going = limit_;
        plan.for_each([this](double, std::size_t, double e) { // it may be a decimal just above
            twice_.push_back(2 * detail::next_up(e));
        });
    }
    [[nodiscard]] bool two_models() const { return motions_.size() == 2; }
    [[nodiscard]] motion_set& of_first() const { return *motions_.front(); }
    [[nodiscard]] motion_set& of_second() const { return *motions_.back(); }
    [[nodiscard]] static double reached(motion_set const& m, motion_cover::part const& p) {
        return p.known->reached == 0 ? 0.0 : m.cover.times()[p.known->reached - 1];
    }

    /// How far the goals lie apart before the experiment.
    void begin(motion_cover::part const& whole) {
        auto const& goals = of_first().outputs.margins;
        constexpr double infinity = std::numeric_limits<double>::infinity();
        if (whole.known->reached == 0) {
            result_.goals.assign(goals.size(), {0, infinity, infinity});
            return;
        }
        auto const v = of_first().cover.look(whole);
        auto const attained = reached_of(whole);
        for (auto const y : goals) {
            auto const width_in = [y](motion_cover::view const& of) {
                return traits::sub(traits::point(of.high[y]), traits::point(of.low[y]));
            };
            promised_width g;
            g.most = upper(width_in(v));
            if (attained) {
                auto const rest = traits::mul(traits::point(4.0), traits::point(attained->rest[y]));
                g.before = std::max(0.0, lower(traits::sub(width_in(*attained), rest)));
            }
            g.after = g.most;
            result_.goals.push_back(g);
        }
    }
    /// Bounds over what is known to be reached of the whole; nothing where nothing is.
    [[nodiscard]] std::optional<motion_cover::view>
    reached_of(motion_cover::part const& whole) const {
        auto const& m = of_first();
        if (!m.problem.reached) return m.cover.look(whole);
        if (m.problem.reached->empty()) return std::nullopt;
        auto there = m.problem;
        there.sets = *there.reached;
        motion_cover const cover(there, m.outputs, m.cover.times(), options_.run);
        auto part = cover.whole();
        part.known = whole.known;
        return cover.look(part);
    }

    /// What is measured already says of a part's parameters, once for each integration.
    measured_responses const& heard(motion_set const& m, motion_cover::part const& p) {
        auto const [at, fresh] = heard_.try_emplace(p.known.get());
        if (fresh) {
            kept_.push_back(p.known); // its address stays its own
            if (m.problem.measured)
                at->second = m.problem.measured(p.known->parameters, std::function<bool()>(limit_));
        }
        return at->second;
    }

    void judge(pair& p) {
        auto const& a = of_first();
        auto const& b = of_second();
        auto const count = result_.goals.size();
        p.bound.clear();
        for (auto const& g : result_.goals) p.bound.push_back(g.most);
        std::vector<compared_outputs> rows;
        for (std::size_t k = 0; k < twice_.size(); ++k) {
            if (a.rows[k].instant < p.a.known->reached && b.rows[k].instant < p.b.known->reached)
                rows.push_back(
                    {a.rows[k].output, b.rows[k].output, traits::bounds(-twice_[k], twice_[k])});
        }
        auto const first_goal = rows.size();
        if (p.a.known->reached > 0 && p.b.known->reached > 0) {
            for (auto const y : a.outputs.margins) rows.push_back({y, y, traits::entire()});
        }
        if (!rows.empty()) {
            response_list known{std::make_shared<response>(
                difference_of(*p.a.known->answer, *p.b.known->answer, rows))};
            std::vector<box> starts{joined(p.a.initial, p.b.initial)};
            auto const hear = [&](motion_set const& m, motion_cover::part const& of,
                                  motion_cover::part const& other, bool other_first) {
                auto const& data = heard(m, of);
                for (std::size_t e = 0; e < data.known.size(); ++e) {
                    known.push_back(std::make_shared<response>(
                        beside(*data.known[e], other.parameters, other_first)));
                    starts.push_back(data.starts[e]);
                }
            };
            hear(a, p.a, p.b, false);
            hear(b, p.b, p.a, true);
            lifted_program const program(known, joined(p.a.parameters, p.b.parameters), starts,
                                         curved_share);
            for (std::size_t g = 0; g < count && rows.size() > first_goal; ++g)
                p.bound[g] = std::min(p.bound[g], program.end_of(0, first_goal + g, true));
            if (two_models()) {
                // No pair: an output's own bounds contradict the rest, or nothing is left of it.
                auto const y = widest_miss(*known.front());
                p.apart = program.end_of(0, y, true) < rows[y].bound.lower() ||
                          program.end_of(0, y, false) > rows[y].bound.upper();
            }
        }
        weigh(p);
    }
    /// The output whose middle is farthest beyond its bounds, in these.
    [[nodiscard]] static std::size_t widest_miss(response const& r) {
        std::size_t worst = 0;
        double most = -1;
        for (std::size_t y = 0; y < r.outputs(); ++y) {
            double const share = std::abs(r.coefficients[y]) / r.bounds[y].upper();
            if (share > most) worst = y, most = share;
        }
        return worst;
    }
    void weigh(pair& p) const {
        p.worst = 0;
        if (two_models())
            p.worst = of_first().cover.widest_share(p.a) + of_second().cover.widest_share(p.b);
        for (std::size_t g = 0; g < p.bound.size(); ++g) {
            double const share = p.bound[g] / std::max(result_.goals[g].before, 1e-300);
            p.worst = std::max(p.worst, std::min(share, 1e300));
        }
        for (double const bound : p.bound)
            p.apart = p.apart || bound == -std::numeric_limits<double>::infinity();
    }

    /// The largest part of an error's bound that remainders take.
    [[nodiscard]] double blur(motion_set const& m, motion_cover::part const& p) const {
        double most = 0;
        for (std::size_t k = 0; k < twice_.size(); ++k) {
            if (m.rows[k].instant >= p.known->reached)
                return std::numeric_limits<double>::infinity();
            most = std::max(most, 2 * p.known->answer->radius[m.rows[k].output] / twice_[k]);
        }
        return most;
    }
    /// What halving each side of a part promises: what bends the outputs, or moves the states where
    /// they are lost.
    [[nodiscard]] static std::vector<double> score(motion_set const& m,
                                                   motion_cover::part const& p) {
        auto const v = m.cover.look(p, true);
        if (!p.known->complete && v.reached < m.cover.times().size())
            return m.cover.lost_by_sides(p, v);
        return m.cover.curved_by_sides(p, v);
    }
    void halve(std::size_t index) {
        auto const whole = pairs_[index];
        auto const a = score(of_first(), whole.a), b = score(of_second(), whole.b);
        auto const most = [](std::vector<double> const& s) {
            return s.empty() ? 0.0 : *std::max_element(s.begin(), s.end());
        };
        bool const first = most(a) >= most(b);
        auto& m = first ? of_first() : of_second();
        auto const& cut = first ? whole.a : whole.b;
        auto halves = m.cover.split_by(first ? a : b, cut);
        if (halves.empty() || m.cover.widest_share(cut) <= 1e-7) {
            pairs_[index].settled = true;
            return;
        }
        if (blur(m, cut) > 0.25) {
            for (auto& h : halves) h.known = nullptr;
            m.cover.learn(halves);
        }
        pairs_.erase(pairs_.begin() + static_cast<std::ptrdiff_t>(index));
        for (auto& h : halves) {
            pair next = first ? pair{h, whole.b, {}} : pair{whole.a, h, {}};
            judge(next);
            for (std::size_t g = 0; g < next.bound.size(); ++g) // what held of the whole holds
                next.bound[g] = std::min(next.bound[g], whole.bound[g]);
            weigh(next);
            bool const counts =
                next.bound.empty() ||
                std::any_of(next.bound.begin(), next.bound.end(), [](double x) { return x > 0; });
            if (counts && !next.apart) pairs_.push_back(std::move(next));
        }
    }

    /// Products that move no measurement by more than this share of its bound stay errors.
    static constexpr double curved_share = 0.01;

    promise_options options_;
    work_limit limit_;
    std::vector<double> twice_;                        ///< twice the error of each measurement
    std::vector<std::unique_ptr<motion_set>> motions_; ///< one, or one for each model
    std::vector<pair> pairs_;
    std::map<motion_cover::knowledge const*, measured_responses> heard_;
    std::vector<std::shared_ptr<motion_cover::knowledge const>> kept_;
    promise result_;
};

} // namespace sivid::decision_detail

#endif
