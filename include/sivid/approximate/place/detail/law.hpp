// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_LAW_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_LAW_HPP

#include <sivid/approximate/place/detail/knot_trace.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A shape that something missing may have: one or more functions whose factors are free.
struct law {
    std::string text;   ///< in the model's names, e.g. "abs(r)*r"
    std::string regime; ///< where it acts, e.g. "abs(delta) > 0.21"; empty when everywhere
    /// [function][experiment][knot]
    std::vector<std::vector<std::vector<double>>> functions;
    std::string formula{}; ///< as `missing_term` reads it; empty when it does not
    double frequency = 0;  ///< of a swing [rad/s]
    /// What it costs to choose it, as `ranked_law::score` counts: where many of a kind are tried
    /// one of them fits by chance.
    double cost = 0;

    /// The largest size of a function along the motions.
    [[nodiscard]] double reach() const {
        double most = 0;
        for (auto const& f : functions)
            for (auto const& own : f)
                for (double const v : own) most = std::max(most, std::abs(v));
        return most;
    }
};

/// The roles that the states of a model play in laws.
struct law_roles {
    std::vector<std::size_t> moving; ///< states on which dynamic rates depend otherwise
    std::vector<std::size_t> angles; ///< states of which rates take sine or cosine

    explicit law_roles(recorded_model const& model) {
        auto const needed = reachable(model.g, model.rate);
        std::vector<bool> angle(model.rate.size(), false), moves(model.rate.size(), false);
        for (std::size_t k = 0; k < model.g.size(); ++k) {
            auto const& n = model.g.nodes()[k];
            if (!needed[k] || is_leaf(n.op)) continue;
            bool const turns = n.op == operation::sin || n.op == operation::cos;
            auto const use = [&](node_id i) {
                auto const& child = model.g[i];
                if (child.op != operation::state) return;
                (turns ? angle : moves)[static_cast<std::size_t>(child.index)] = true;
            };
            use(n.a);
            if (is_binary(n.op)) use(n.b);
        }
        for (std::size_t i = 0; i < model.rate.size(); ++i) {
            // A rate that is a state alone has no operation above it.
            auto const& n = model.g[model.rate[i]];
            if (n.op == operation::state) moves[static_cast<std::size_t>(n.index)] = true;
        }
        for (std::size_t i = 0; i < model.rate.size(); ++i) {
            if (angle[i]) angles.push_back(i);
            if (moves[i]) moving.push_back(i);
        }
    }
};

/// The generic laws of a model along its motions.
class law_library {
public:
    law_library(recorded_model const& model, std::vector<knot_trace> const& traces)
        : about_(&model.about), roles_(model) {
        for (auto const& t : traces) lengths_.push_back(static_cast<Eigen::Index>(t.times.size()));
        auto const along = [&](auto const& value) {
            array all(std::accumulate(lengths_.begin(), lengths_.end(), Eigen::Index{0}));
            Eigen::Index at = 0;
            for (auto const& t : traces)
                for (std::size_t k = 0; k < t.times.size(); ++k) all[at++] = value(t, k);
            return all;
        };
        t_ = along([](knot_trace const& t, std::size_t k) { return t.times[k]; });
        one_ = array::Ones(t_.size());
        for (std::size_t i = 0; i < about_->states.size(); ++i)
            x_.push_back(along([i](auto const& t, std::size_t k) { return t.states[k][i]; }));
        for (std::size_t i = 0; i < about_->inputs.size(); ++i) {
            u_.push_back(along([i](auto const& t, std::size_t k) { return t.inputs[k][i]; }));
            slope_.push_back(
                along([i](auto const& t, std::size_t k) { return t.input_slopes[k][i]; }));
        }
        for (auto const& t : traces)
            // The last piece has what is left.
            for (std::size_t k = 1; k + 1 < std::max<std::size_t>(t.times.size(), 3); ++k)
                if (k < t.times.size()) step_ = std::max(step_, t.times[k] - t.times[k - 1]);
    }

    /// For a missing rate.
    [[nodiscard]] std::vector<law> for_rates() const {
        std::vector<law> laws;
        with_gain("", one_, laws, true);
        for (std::size_t i = 0; i < u_.size(); ++i) {
            auto const& name = about_->inputs[i].name;
            with_gain(name, u_[i], laws, false);
            with_gain(name + "^2", u_[i].square(), laws, false);
        }
        geometric(laws);
        third_degree(laws);
        return laws;
    }
    /// For what is wrong with an input, in the unit of the input.
    [[nodiscard]] std::vector<law> for_input(std::size_t i) const {
        std::vector<law> laws;
        auto const& name = about_->inputs[i].name;
        auto const& u = u_[i];
        add(laws, "1", one_);
        add(laws, name, u);
        add(laws, name + "*t", u * t_);
        for (auto const j : roles_.moving)
            add(laws, name + "*" + about_->states[j].name, u * x_[j]);
        add(laws, "d(" + name + ")/dt", slope_[i]);
        add(laws, name + "^3", u.cube());
        add(laws, "sgn(" + name + ")", u.sign());
        transients(name, u, laws);
        hinges("", one_, i, laws);
        return laws;
    }
    /// Swings of a missing rate, at frequencies close enough for `missing_term` to find its own.
    [[nodiscard]] std::vector<law> waves() const {
        std::vector<law> laws;
        double longest = 0;
        for (auto const& own : values(t_))
            if (!own.empty()) longest = std::max(longest, own.back() - own.front());
        if (!(longest > 0)) return laws;
        for (double w = 3 / longest; w < 60 / longest; w *= 1.2) {
            double const own = rounded_to(w, 2);
            auto const arg = nearest_text(own) + "*t";
            laws.push_back({"cos(" + arg + "), sin(" + arg + ")",
                            {},
                            {values((own * t_).cos()), values((own * t_).sin())},
                            "wave(" + arg + ")",
                            own});
        }
        return laws;
    }
    /// What begins where a state that never changes its sign, such as a level, passes a threshold:
    /// at once, or in proportion to how far it is beyond.
    [[nodiscard]] std::vector<law> beyond_levels() const {
        std::vector<law> laws;
        for (auto const i : roles_.moving) {
            auto const& x = x_[i];
            if (x.size() == 0) continue;
            double const low = x.minCoeff(), high = x.maxCoeff();
            if (!(low < high) || low < -1e-3 * high) continue;
            auto const& name = about_->states[i].name;
            for (int share = 1; share < 20; ++share) {
                double const threshold = low + (high - low) * share / 20;
                auto const text = nearest_text(threshold, 3);
                auto const regime = name + " > " + text;
                add(laws, "max(" + name + "-" + text + ",0)", (x - threshold).max(0.0), regime);
                add(laws, "1", (x > threshold).cast<double>(), regime);
            }
        }
        return laws;
    }

private:
    using array = Eigen::ArrayXd; ///< at all knots, one experiment after the other

    [[nodiscard]] std::vector<std::vector<double>> values(array const& all) const {
        std::vector<std::vector<double>> result;
        auto const* from = all.data();
        for (auto const n : lengths_) {
            result.emplace_back(from, from + n);
            from += n;
        }
        return result;
    }
    void add(std::vector<law>& laws, std::string text, array const& f, std::string regime = {},
             std::string formula = {}) const {
        laws.push_back({std::move(text), std::move(regime), {values(f)}, std::move(formula)});
    }
    static std::string product(std::string const& a, std::string const& b) {
        return a.empty() ? b : b == "1" ? a : a + "*" + b;
    }
    [[nodiscard]] static double largest(array const& f) {
        return f.size() == 0 ? 0 : f.abs().maxCoeff();
    }
    void with_gain(std::string const& gain, array const& g, std::vector<law>& laws,
                   bool alone) const {
        auto const put = [&](std::string const& text, array const& f,
                             std::optional<std::string> const& formula = {}) {
            auto const own = formula.value_or(text);
            add(laws, product(gain, text), g * f, {}, own.empty() ? own : product(gain, own));
        };
        put("1", one_);
        put("t", t_);
        for (auto const i : roles_.moving) {
            auto const& name = about_->states[i].name;
            auto const& x = x_[i];
            put(name, x);
            if (!alone) continue;
            double const small = rounded_to(0.02 * largest(x) + 1e-300, 2);
            put("abs(" + name + ")*" + name, x.abs() * x);
            put("sgn(" + name + ")",
                x.unaryExpr([small](double v) { return v / std::hypot(v, small); }),
                "sgn(" + name + ":" + nearest_text(small) + ")");
            put(name + "^3", x.cube());
            for (auto const j : roles_.moving) {
                if (j < i) continue;
                put(j == i ? name + "^2" : name + "*" + about_->states[j].name, x * x_[j]);
            }
        }
        for (std::size_t j = 0; j < u_.size(); ++j) {
            auto const& name = about_->inputs[j].name;
            if (gain == name || gain == name + "^2") {
                transients(gain, g, laws);
                continue;
            }
            if (!alone) put(name, u_[j]);
            put("d(" + name + ")/dt", slope_[j], "");
            put(name + "^3", u_[j].cube());
            put("sgn(" + name + ")", u_[j].sign(), "");
            hinges(gain, g, j, laws);
        }
        if (alone) transients("", g, laws);
    }
    /// Products of three inputs and states that the others have not: "x^2*y", "u*x*y", "x*y*z".
    void third_degree(std::vector<law>& laws) const {
        constexpr std::size_t most = 16; // factors: 816 products, a tenth of a second
        std::vector<std::pair<std::string, array const*>> factors;
        for (std::size_t j = 0; j < u_.size(); ++j)
            factors.emplace_back(about_->inputs[j].name, &u_[j]);
        for (auto const i : roles_.moving) factors.emplace_back(about_->states[i].name, &x_[i]);
        auto const n = factors.size(), begin = laws.size();
        for (std::size_t i = 0; i < n && n <= most; ++i) {
            for (std::size_t j = i; j < n; ++j) {
                for (std::size_t k = j; k < n; ++k) {
                    bool const cube = i == k, square = i == j || j == k;
                    if (cube || (square && j < u_.size())) continue; // x^3, u^2*x
                    auto const& [a, f] = factors[i];
                    auto const& [b, g] = factors[j];
                    auto const& [c, h] = factors[k];
                    auto const text = i == j   ? a + "^2*" + c
                                      : j == k ? a + "*" + b + "^2"
                                               : a + "*" + b + "*" + c;
                    add(laws, text, *f * *g * *h, {}, text);
                }
            }
        }
        double const cost = 2 * std::log(static_cast<double>(laws.size() - begin + 1));
        for (auto k = begin; k < laws.size(); ++k) laws[k].cost = cost;
    }
    /// What fades within half a step of the knots to some steps: quicker it is not seen, and slower
    /// it is no transient.
    void transients(std::string const& name, array const& f, std::vector<law>& laws) const {
        for (double const steps : {0.5, 1.25, 3.0}) {
            double const tau = rounded_to(steps * step_, 2);
            if (!(tau > 0)) continue;
            add(laws, product(name, "exp(-t/" + nearest_text(tau, 6) + ")"), f * (-t_ / tau).exp());
        }
    }
    /// What an input does beyond a threshold.
    void hinges(std::string const& gain, array const& g, std::size_t j,
                std::vector<law>& laws) const {
        auto const& name = about_->inputs[j].name;
        auto const& u = u_[j];
        double const most = largest(u);
        if (!(most > 0)) return;
        for (int share = 1; share < 10; ++share) {
            double const threshold = rounded_to(most * share / 10, 2);
            auto const text = nearest_text(threshold);
            add(laws, product(gain, "sgn(" + name + ")*max(abs(" + name + ")-" + text + ",0)"),
                g * u.sign() * (u.abs() - threshold).max(0.0), "abs(" + name + ") > " + text,
                product(gain, "beyond(" + name + ":" + text + ")"));
        }
    }
    /// cos, sin of angles, alone and times a speed; products with the speed.
    void geometric(std::vector<law>& laws) const {
        std::vector<std::size_t> same;
        for (auto const i : roles_.moving) {
            bool const shared =
                std::any_of(roles_.moving.begin(), roles_.moving.end(), [&](auto j) {
                    return j != i && about_->states[j].unit == about_->states[i].unit;
                });
            if (shared) same.push_back(i);
        }
        array speed = array::Zero(t_.size());
        for (auto const i : same) speed += x_[i].square();
        speed = speed.sqrt().eval();
        auto const norm = "sqrt(" +
                          joined(same, "+", [&](auto i) { return about_->states[i].name + "^2"; }) +
                          ")";
        for (auto const i : same) {
            auto const& name = about_->states[i].name;
            add(laws, "speed*" + name, speed * x_[i], {}, norm + "*" + name);
            if (largest(speed) > 0) // smooth near rest
                add(laws, name + "/speed", x_[i] / (speed + 0.05 * largest(speed)));
        }
        for (auto const i : roles_.angles) {
            auto const& name = about_->states[i].name;
            for (bool const fast : {false, true}) {
                if (fast && same.empty()) continue;
                auto const& g = fast ? speed : one_;
                std::string const head = fast ? "speed*" : "";
                laws.push_back({head + "cos(" + name + "), " + head + "sin(" + name + ")",
                                {},
                                {values(g * x_[i].cos()), values(g * x_[i].sin())},
                                (fast ? norm + "*" : "") + "turn(" + name + ")"});
            }
        }
    }

    model_description const* about_;
    law_roles roles_;
    std::vector<Eigen::Index> lengths_; ///< knots of each experiment
    double step_ = 0;                   ///< longest distance of two knots
    array t_, one_;
    std::vector<array> x_, u_, slope_; ///< states, inputs and the slopes of these
};

} // namespace sivid

#endif
