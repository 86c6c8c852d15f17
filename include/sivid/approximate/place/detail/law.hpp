// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_LAW_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_LAW_HPP

#include <sivid/approximate/place/detail/knot_trace.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
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
        : about_(&model.about), traces_(&traces), roles_(model) {}

    /// For a missing rate.
    [[nodiscard]] std::vector<law> for_rates() const {
        std::vector<law> laws;
        auto const none = factor{"", [](knot_trace const&, std::size_t) { return 1.0; }};
        with_gain(none, laws, true);
        for (std::size_t i = 0; i < about_->inputs.size(); ++i) {
            auto const name = about_->inputs[i].name;
            with_gain({name, [i](knot_trace const& t, std::size_t k) { return t.inputs[k][i]; }},
                      laws, false);
            with_gain({name + "^2", [i](knot_trace const& t,
                                        std::size_t k) { return t.inputs[k][i] * t.inputs[k][i]; }},
                      laws, false);
        }
        geometric(laws);
        return laws;
    }
    /// For what is wrong with an input, in the unit of the input.
    [[nodiscard]] std::vector<law> for_input(std::size_t i) const {
        std::vector<law> laws;
        auto const name = about_->inputs[i].name;
        auto const value = [i](knot_trace const& t, std::size_t k) { return t.inputs[k][i]; };
        add(laws, "1", [](knot_trace const&, std::size_t) { return 1.0; });
        add(laws, name, value);
        add(laws, name + "*t",
            [=](knot_trace const& t, std::size_t k) { return value(t, k) * t.times[k]; });
        for (auto const j : roles_.moving) {
            add(laws, name + "*" + about_->states[j].name,
                [=](knot_trace const& t, std::size_t k) { return value(t, k) * t.states[k][j]; });
        }
        add(laws, "d(" + name + ")/dt",
            [i](knot_trace const& t, std::size_t k) { return t.input_slopes[k][i]; });
        add(laws, name + "^3",
            [=](knot_trace const& t, std::size_t k) { return std::pow(value(t, k), 3); });
        add(laws, "sgn(" + name + ")",
            [=](knot_trace const& t, std::size_t k) { return sign(value(t, k)); });
        transients(name, value, laws);
        hinges({"", [](knot_trace const&, std::size_t) { return 1.0; }}, i, laws);
        return laws;
    }
    /// Swings of a missing rate, at frequencies close enough for `missing_term` to find its own.
    [[nodiscard]] std::vector<law> waves() const {
        std::vector<law> laws;
        double longest = 0;
        for (auto const& t : *traces_)
            if (!t.times.empty()) longest = std::max(longest, t.times.back() - t.times.front());
        if (!(longest > 0)) return laws;
        for (double w = 3 / longest; w < 60 / longest; w *= 1.2) {
            double const own = rounded_to(w, 2);
            auto const arg = nearest_text(own) + "*t";
            laws.push_back({"cos(" + arg + "), sin(" + arg + ")",
                            {},
                            {values([own](auto const& t, std::size_t k) {
                                 return std::cos(own * t.times[k]);
                             }),
                             values([own](auto const& t, std::size_t k) {
                                 return std::sin(own * t.times[k]);
                             })},
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
            auto const x = [i](knot_trace const& t, std::size_t k) { return t.states[k][i]; };
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (auto const& own : values(x)) {
                for (double const v : own) {
                    low = std::min(low, v);
                    high = std::max(high, v);
                }
            }
            if (!(low < high) || low < -1e-3 * high) continue;
            auto const name = about_->states[i].name;
            for (int share = 1; share < 20; ++share) {
                double const threshold = low + (high - low) * share / 20;
                auto const text = nearest_text(threshold, 3);
                auto const regime = name + " > " + text;
                add(
                    laws, "max(" + name + "-" + text + ",0)",
                    [=](knot_trace const& t, std::size_t k) {
                        return std::max(x(t, k) - threshold, 0.0);
                    },
                    regime);
                add(
                    laws, "1",
                    [=](knot_trace const& t, std::size_t k) {
                        return x(t, k) > threshold ? 1.0 : 0.0;
                    },
                    regime);
            }
        }
        return laws;
    }

private:
    using function = std::function<double(knot_trace const&, std::size_t)>;
    struct factor {
        std::string name;
        function value;
    };

    static double sign(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }
    [[nodiscard]] std::vector<std::vector<double>> values(function const& f) const {
        std::vector<std::vector<double>> result;
        for (auto const& t : *traces_) {
            auto& own = result.emplace_back();
            for (std::size_t k = 0; k < t.times.size(); ++k) own.push_back(f(t, k));
        }
        return result;
    }
    void add(std::vector<law>& laws, std::string text, function const& f, std::string regime = {},
             std::string formula = {}) const {
        laws.push_back({std::move(text), std::move(regime), {values(f)}, std::move(formula)});
    }
    static std::string product(std::string const& a, std::string const& b) {
        return a.empty() ? b : b == "1" ? a : a + "*" + b;
    }
    /// The largest |state i| along the motions.
    [[nodiscard]] double reach(function const& f) const {
        double most = 0;
        for (auto const& own : values(f)) {
            for (double const v : own) most = std::max(most, std::abs(v));
        }
        return most;
    }
    void with_gain(factor const& gain, std::vector<law>& laws, bool alone) const {
        auto const put = [&](std::string const& text, function const& f,
                             std::optional<std::string> const& formula = {}) {
            auto const g = gain.value;
            auto const own = formula.value_or(text);
            add(
                laws, product(gain.name, text),
                [g, f](knot_trace const& t, std::size_t k) { return g(t, k) * f(t, k); }, {},
                own.empty() ? own : product(gain.name, own));
        };
        put("1", [](knot_trace const&, std::size_t) { return 1.0; });
        put("t", [](knot_trace const& t, std::size_t k) { return t.times[k]; });
        for (auto const i : roles_.moving) {
            auto const name = about_->states[i].name;
            auto const x = [i](knot_trace const& t, std::size_t k) { return t.states[k][i]; };
            put(name, x);
            if (!alone) continue;
            double const small = rounded_to(0.02 * reach(x) + 1e-300, 2);
            put("abs(" + name + ")*" + name,
                [=](knot_trace const& t, std::size_t k) { return std::abs(x(t, k)) * x(t, k); });
            put(
                "sgn(" + name + ")",
                [=](knot_trace const& t, std::size_t k) {
                    return x(t, k) / std::hypot(x(t, k), small);
                },
                "sgn(" + name + ":" + nearest_text(small) + ")");
            put(name + "^3",
                [=](knot_trace const& t, std::size_t k) { return std::pow(x(t, k), 3); });
            for (auto const j : roles_.moving) {
                if (j < i) continue;
                put(j == i ? name + "^2" : name + "*" + about_->states[j].name,
                    [=](knot_trace const& t, std::size_t k) { return x(t, k) * t.states[k][j]; });
            }
        }
        for (std::size_t j = 0; j < about_->inputs.size(); ++j) {
            auto const name = about_->inputs[j].name;
            if (gain.name == name || gain.name == name + "^2") {
                transients(gain.name, gain.value, laws);
                continue;
            }
            auto const u = [j](knot_trace const& t, std::size_t k) { return t.inputs[k][j]; };
            if (!alone) put(name, u);
            put(
                "d(" + name + ")/dt",
                [j](knot_trace const& t, std::size_t k) { return t.input_slopes[k][j]; }, "");
            put(name + "^3",
                [=](knot_trace const& t, std::size_t k) { return std::pow(u(t, k), 3); });
            put(
                "sgn(" + name + ")",
                [=](knot_trace const& t, std::size_t k) { return sign(u(t, k)); }, "");
            hinges(gain, j, laws);
        }
        if (alone) transients("", gain.value, laws);
    }
    void transients(std::string const& name, function const& f, std::vector<law>& laws) const {
        for (double const tau : {0.1, 0.25, 0.6}) {
            auto const text = "exp(-t/" + nearest_text(tau, 6) + ")";
            add(laws, product(name, text), [=](knot_trace const& t, std::size_t k) {
                return f(t, k) * std::exp(-t.times[k] / tau);
            });
        }
    }
    /// What an input does beyond a threshold.
    void hinges(factor const& gain, std::size_t j, std::vector<law>& laws) const {
        auto const name = about_->inputs[j].name;
        auto const u = [j](knot_trace const& t, std::size_t k) { return t.inputs[k][j]; };
        double const most = reach(u);
        if (!(most > 0)) return;
        for (int share = 1; share < 10; ++share) {
            double const threshold = rounded_to(most * share / 10, 2);
            auto const text = nearest_text(threshold);
            auto const g = gain.value;
            add(
                laws, product(gain.name, "sgn(" + name + ")*max(abs(" + name + ")-" + text + ",0)"),
                [=](knot_trace const& t, std::size_t k) {
                    return g(t, k) * sign(u(t, k)) * std::max(std::abs(u(t, k)) - threshold, 0.0);
                },
                "abs(" + name + ") > " + text,
                product(gain.name, "beyond(" + name + ":" + text + ")"));
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
        auto const speed = [same](knot_trace const& t, std::size_t k) {
            double sum = 0;
            for (auto const i : same) sum += t.states[k][i] * t.states[k][i];
            return std::sqrt(sum);
        };
        auto const norm = "sqrt(" +
                          joined(same, "+", [&](auto i) { return about_->states[i].name + "^2"; }) +
                          ")";
        for (auto const i : same) {
            add(
                laws, "speed*" + about_->states[i].name,
                [=](knot_trace const& t, std::size_t k) { return speed(t, k) * t.states[k][i]; },
                {}, norm + "*" + about_->states[i].name);
            add(laws, about_->states[i].name + "/speed", [=](knot_trace const& t, std::size_t k) {
                return t.states[k][i] / (speed(t, k) + 0.02);
            });
        }
        for (auto const i : roles_.angles) {
            auto const name = about_->states[i].name;
            for (bool const fast : {false, true}) {
                if (fast && same.empty()) continue;
                auto const g = [=](knot_trace const& t, std::size_t k) {
                    return fast ? speed(t, k) : 1.0;
                };
                auto const c = [=](knot_trace const& t, std::size_t k) {
                    return g(t, k) * std::cos(t.states[k][i]);
                };
                auto const s = [=](knot_trace const& t, std::size_t k) {
                    return g(t, k) * std::sin(t.states[k][i]);
                };
                std::string const head = fast ? "speed*" : "";
                laws.push_back({head + "cos(" + name + "), " + head + "sin(" + name + ")",
                                {},
                                {values(c), values(s)},
                                (fast ? norm + "*" : "") + "turn(" + name + ")"});
            }
        }
    }

    model_description const* about_;
    std::vector<knot_trace> const* traces_;
    law_roles roles_;
};

} // namespace sivid

#endif
