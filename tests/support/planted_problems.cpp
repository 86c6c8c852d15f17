// SPDX-License-Identifier: MIT
#include "support/planted_problems.hpp"

#include "support/real_functions.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace planted {

namespace {

using namespace support;

/// A right-hand side that is a sum of random terms, each a product of powers of the parameters
/// times a function of the states, the input or time; every equation is damped.
struct random_rate {
    struct term {
        std::size_t equation = 0;
        double coefficient = 1;
        std::vector<int> powers; ///< of the parameters, -1 to 2
        std::size_t kind = 0, a = 0, b = 0;
    };
    static constexpr std::size_t kinds = 13;
    std::vector<double> damping; ///< by state
    std::vector<term> terms;

    template <class T, class X, class P, class U>
    X operator()(T const& t, X const& x, P const& p, U const& u) const {
        X f;
        for (std::size_t i = 0; i < x.size(); ++i) f.push_back(-(damping[i] * x[i]));
        for (auto const& one : terms) {
            using value = typename X::value_type;
            value c(one.coefficient);
            for (std::size_t j = 0; j < p.size(); ++j) {
                for (int k = 0; k < one.powers[j]; ++k) c = c * p[j];
                if (one.powers[j] < 0) c = c / p[j];
            }
            f[one.equation] = f[one.equation] + c * shape_of(one, t, x, u);
        }
        return f;
    }

private:
    template <class T, class X, class U>
    static typename X::value_type shape_of(term const& one, T const& t, X const& x, U const& u) {
        using namespace real;
        using value = typename X::value_type;
        auto const &a = x[one.a], &b = x[one.b];
        switch (one.kind) {
        case 0:
            return value(1.0);
        case 1:
            return a * b;
        case 2:
            return sin(a);
        case 3:
            return tanh(a);
        case 4:
            return abs(a);
        case 5:
            return max(a, b);
        case 6:
            return saturate(a, value(-0.5), value(0.5));
        case 7:
            return a / (1 + sqr(b));
        case 8:
            return exp(-sqr(a));
        case 9:
            return sin(2 * t);
        case 10:
            return abs(a) * b;
        case 11:
            return u.empty() ? value(0.5) : u[0];
        default:
            return a;
        }
    }
};

/// v' = p0 u - p1 sign(v), x' = v, with a held input: solved in closed form, sticking included.
struct coulomb_friction {
    template <class T, class X, class P, class U>
    X operator()(T const&, X const& x, P const& p, U const& u) const {
        using namespace real;
        return {x[1], p[0] * u[0] - p[1] * sign(x[1])};
    }
    [[nodiscard]] static std::vector<extended_state>
    solve(extended_state x, extended_state const& p, double from, std::vector<double> const& times,
          std::vector<sivid::sampled_signal> const& inputs) {
        std::vector<extended_state> result;
        double now = from;
        auto const glide = [&x](extended a, extended h) {
            x[0] += h * (x[1] + a * h / 2);
            x[1] += a * h;
        };
        for (double const target : times) {
            while (now < target) {
                double const to = std::fmin(target, inputs[0].next_knot(now));
                extended const push = p[0] * inputs[0].approximate(now);
                extended left = static_cast<extended>(to) - now;
                if (x[1] != 0) { // until v is 0, if that is before the piece's end
                    extended const a = push - (x[1] > 0 ? p[1] : -p[1]);
                    bool const stops = a * x[1] < 0 && -x[1] / a <= left;
                    extended const while_sliding = stops ? -x[1] / a : left;
                    glide(a, while_sliding);
                    if (stops) x[1] = 0;
                    left -= while_sliding;
                }
                if (left > 0 && std::fabs(push) > p[1])
                    glide(push - (push > 0 ? p[1] : -p[1]), left);
                now = to;
            }
            result.push_back(x);
        }
        return result;
    }
};

/// What is measured: the states, and perhaps one product more.
struct observed {
    std::optional<std::size_t> scaled_by; ///< a parameter times the first state as a last channel

    template <class T, class X, class P, class U>
    X operator()(T const&, X const& x, P const& p, U const&) const {
        X y = x;
        if (scaled_by) y.push_back(p[*scaled_by] * x[0]);
        return y;
    }
};

/// States across kinks of the rate: Fehlberg's estimate is 0 for rates that are constant on both
/// sides of a kink, so Dormand and Prince's is used, in steps that no kink outgrows.
std::vector<extended_state> kinked_states(extended_rate const& rate, extended_state x,
                                          extended_state const& p, double from,
                                          std::vector<double> const& times,
                                          std::vector<sivid::sampled_signal> const& inputs) {
    return reference_states<dormand_prince>(rate, std::move(x), p, from, times, inputs, 1e-14L,
                                            1.0 / 64);
}

/// A model of the family, ready to be planted.
struct ground {
    shape size;
    box prior;
    std::vector<double> start;
    double input_low = -1, input_high = 1;
    bool only_hold = false;
    bool kinked = false; ///< the rate is not smooth
};

using reference_solver = std::function<std::vector<extended_state>(
    extended_state const&, extended_state const&, double, std::vector<double> const&,
    std::vector<sivid::sampled_signal> const&)>;

/// Spreads starts, times, inputs and bounds at random over a model; outputs beyond 100 are refused.
std::optional<planted_problem> plant_on(draws& d, ground const& g, observed const& look,
                                        recorded_rate const& rate,
                                        reference_solver const& reference) {
    planted_problem result;
    auto& problem = result.problem;
    problem.model = model_of(g.size, rate, look);
    problem.choice.unknown = all_constants(g.size.constants);
    problem.prior = g.prior;
    result.truth = d.in(g.prior);
    auto const channels = problem.model.about.channels.size();
    std::size_t const experiments = 1 + d.below(3) / (1 + d.below(2));
    double const noise = std::pow(10.0, d.uniform(-2.5, -0.8));
    double const spread = d.below(3) == 0 ? noise * d.uniform(0.1, 2) : 0;
    double const horizon = d.uniform(0.5, 3);
    std::vector<std::vector<sivid::sampled_signal>> inputs(experiments);
    std::vector<sivid::record> samples(experiments);
    for (std::size_t e = 0; e < experiments; ++e) {
        sivid::experiment x;
        x.name = numbered('E', e);
        x.begin = d.below(4) == 0 ? d.uniform(-1, 1) : 0;
        for (std::size_t k = 0; k < g.size.inputs; ++k) {
            std::vector<double> at, value;
            double t = x.begin - (d.coin() ? d.uniform(0, 0.3) : 0);
            for (std::size_t n = 1 + d.below(7); n > 0; --n) {
                at.push_back(t);
                value.push_back(d.uniform(g.input_low, g.input_high));
                t += d.uniform(0.05, 0.6);
            }
            bool const hold = g.only_hold || d.coin();
            inputs[e].emplace_back(
                at, value, hold ? sivid::interpolation::hold : sivid::interpolation::linear);
            x.inputs.push_back(inputs[e].back());
        }
        std::vector<double> x0;
        for (double const s : g.start) {
            double const centre = s * d.uniform(0.7, 1.3);
            x.initial = box(g.size.states);
            x0.push_back(centre);
        }
        for (std::size_t i = 0; i < x0.size(); ++i) {
            bool const uncertain = spread > 0 && d.below(3) > 0;
            x.initial[i] = uncertain ? around(x0[i], spread) : interval(x0[i]);
            x0[i] = d.in(x.initial[i]);
        }
        result.starts.push_back(x0);
        std::size_t const count = 4 + d.below(10);
        for (std::size_t k = 0; k < count; ++k) {
            double const share =
                (static_cast<double>(k) + d.uniform(0, 1)) / static_cast<double>(count);
            double at = x.begin + horizon * share;
            if (d.below(8) == 0 && !samples[e].empty()) at = samples[e].back().time;
            if (k == 0 && d.below(4) == 0) at = x.begin;
            samples[e].push_back({at, d.below(channels), interval(0)});
        }
        samples[e] = sivid::sorted(samples[e]);
        x.outliers = d.below(2) == 0 ? 0 : d.below(3);
        result.outliers.emplace_back();
        for (std::size_t k = d.below(x.outliers + 1); k > 0; --k) {
            result.outliers[e].insert(d.below(count));
        }
        problem.experiments.push_back(x);
    }
    std::vector<double> begins;
    for (auto const& e : problem.experiments) begins.push_back(e.begin);
    result.simulate = [=](std::size_t e, std::vector<double> const& p,
                          std::vector<double> const& x0) {
        std::vector<double> times;
        for (auto const& m : samples[e]) times.push_back(m.time);
        auto const parameters = extend(p);
        auto const states = reference(extend(x0), parameters, begins[e], times, inputs[e]);
        extended_state y;
        for (std::size_t k = 0; k < times.size(); ++k) {
            auto const seen = look(extended(times[k]), states[k], parameters, extended_state{});
            y.push_back(seen[samples[e][k].channel]);
        }
        return y;
    };
    for (std::size_t e = 0; e < experiments; ++e) {
        auto const y = result.simulate(e, result.truth, result.starts[e]);
        for (std::size_t k = 0; k < y.size(); ++k) {
            if (!(std::fabs(y[k]) < 100)) return std::nullopt;
            double const exact = static_cast<double>(y[k]);
            // The truth may be as close to an end of its bound as the reference is trusted.
            double const room = 1e-9 * (1 + std::fabs(exact));
            double const below = d.below(5) == 0 ? room : noise * d.uniform(0.02, 1) + room;
            double const above = d.below(5) == 0 ? room : noise * d.uniform(0.02, 1) + room;
            double shift = 0;
            if (result.outliers[e].count(k) > 0) {
                shift = (d.coin() ? 1 : -1) * (below + above) * d.uniform(1.5, 40);
            }
            samples[e][k].bound = between(exact + shift - below, exact + shift + above);
        }
        problem.experiments[e].measurements = samples[e];
    }
    return result;
}

/// The same with the reference that integrates the rate.
std::optional<planted_problem> plant_on(draws& d, ground const& g, observed const& look,
                                        planted_rate const& all) {
    return plant_on(d, g, look, all.on<sivid::expression>(),
                    [rate = all.on<extended>(),
                     kinked = g.kinked](extended_state const& x0, extended_state const& p,
                                        double from, std::vector<double> const& times,
                                        std::vector<sivid::sampled_signal> const& inputs) {
                        if (kinked) return kinked_states(rate, x0, p, from, times, inputs);
                        return reference_states(rate, x0, p, from, times, inputs, 1e-15L);
                    });
}

std::optional<planted_problem> plant_random(draws& d) {
    ground g;
    g.size = {1 + d.below(3), 1 + d.below(4), d.below(2), 20};
    random_rate rate;
    std::vector<bool> divides(g.size.constants, false);
    for (std::size_t i = 0; i < g.size.states; ++i) {
        rate.damping.push_back(d.uniform(0.1, 1));
        g.start.push_back(d.uniform(-1, 1));
    }
    for (std::size_t n = g.size.states + d.below(4); n > 0; --n) {
        random_rate::term one;
        one.equation = d.below(g.size.states);
        one.coefficient = d.uniform(0.3, 1.2) * (d.coin() ? 1 : -1);
        for (std::size_t j = 0; j < g.size.constants; ++j) {
            static constexpr std::array<int, 8> powers{0, 0, 0, 1, 1, 1, 2, -1};
            one.powers.push_back(powers[d.below(powers.size())]);
            divides[j] = divides[j] || one.powers.back() < 0;
        }
        one.kind = d.below(random_rate::kinds);
        g.kinked = g.kinked || (one.kind >= 4 && one.kind <= 6) || one.kind == 10;
        one.a = d.below(g.size.states);
        one.b = d.below(g.size.states);
        rate.terms.push_back(std::move(one));
    }
    g.prior = box(g.size.constants);
    for (std::size_t j = 0; j < g.size.constants; ++j) {
        double const low = d.uniform(0.4, 1.2), wide = d.uniform(0.1, 0.9);
        // 0 inside the prior, or negative altogether, now and then.
        double const move = divides[j] || d.below(5) > 0 ? 0.0 : -low - d.uniform(0, 1.5) * wide;
        g.prior[j] = between(low + move, low + move + wide);
    }
    observed look;
    if (d.below(4) == 0) look.scaled_by = d.below(g.size.constants);
    return plant_on(d, g, look, rate);
}

constexpr std::size_t classics = 14;

/// One of the classic models.
std::optional<planted_problem> plant_classic(draws& d, std::size_t which) {
    observed look;
    auto const with = [&](ground const& g, planted_rate const& rate) {
        if (d.below(5) == 0) look.scaled_by = d.below(g.size.constants);
        return plant_on(d, g, look, rate);
    };
    switch (which) {
    case 0: // linear
        return with({{1, 2, 1, 20}, box{between(0.3, 2), between(-1, 1.5)}, {1}},
                    [](auto const&, auto const& x, auto const& p, auto const& u) {
                        return std::vector{p[1] * u[0] - p[0] * x[0]};
                    });
    case 1: // logistic
        return with({{1, 2, 0, 20}, box{between(0.5, 1.5), between(0.8, 1.6)}, {0.2}},
                    [](auto const&, auto const& x, auto const& p, auto const&) {
                        return std::vector{p[0] * x[0] * (1 - x[0] / p[1])};
                    });
    case 2: // Lotka and Volterra, two rates or all four
        return with({{2, 2, 0, 50}, box{between(0.8, 1.4), between(0.7, 1.2)}, {1.2, 1}},
                    [](auto const&, auto const& x, auto const& p, auto const&) {
                        return std::vector{p[0] * x[0] - x[0] * x[1], p[1] * x[0] * x[1] - x[1]};
                    });
    case 3:
        return with(
            {{2, 4, 0, 50},
             box{between(0.8, 1.2), between(0.8, 1.2), between(0.9, 1.1), between(0.7, 1)},
             {1.2, 1}},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{x[0] * (p[0] - p[1] * x[1]), x[1] * (p[2] * x[0] - p[3])};
            });
    case 4: // driven pendulum
        return with(
            {{2, 3, 1, 20}, box{between(1, 3), between(0, 0.5), between(0.5, 1.5)}, {1, 0.2}},
            [](auto const&, auto const& x, auto const& p, auto const& u) {
                using namespace real;
                return std::vector{x[1], p[2] * u[0] - p[0] * sin(x[0]) - p[1] * x[1]};
            });
    case 5: // Michaelis and Menten
        return with({{1, 2, 0, 20}, box{between(0.5, 2), between(0.3, 1.5)}, {2}},
                    [](auto const&, auto const& x, auto const& p, auto const&) {
                        return std::vector{-(p[0] * x[0] / (p[1] + x[0]))};
                    });
    case 6: // a craft: an area and a lever known through their product
        return with({{3, 3, 1, 10},
                     box{between(0.2, 0.6), between(0.5, 1.5), between(0.5, 1)},
                     {1, 0.1, 0.1}},
                    [](auto const&, auto const& x, auto const& p, auto const& u) {
                        using namespace real;
                        auto const speed = sqrt(sqr(x[0]) + sqr(x[1]) + 0.01);
                        return std::vector{x[1] * x[2] + 1 - 0.5 * x[0] / speed -
                                               p[0] * speed * x[0],
                                           -(x[0] * x[2]) + p[0] * u[0] - p[0] * speed * x[1],
                                           -(p[1] * p[2] * u[0]) - 0.8 * x[2]};
                    });
    case 7: // spring and mass, all through ratios
        return with(
            {{2, 3, 1, 20}, box{between(0.5, 1.5), between(0.1, 0.6), between(0.8, 1.6)}, {1, 0.3}},
            [](auto const&, auto const& x, auto const& p, auto const& u) {
                return std::vector{x[1], (u[0] - p[0] * x[0] - p[1] * x[1]) / p[2]};
            });
    case 8: // quadratic friction, a kink in the second derivative
        return with(
            {{2, 2, 1, 20}, box{between(0.5, 2), between(0.1, 1)}, {0.5, 0.4}, -1, 1, false, true},
            [](auto const&, auto const& x, auto const& p, auto const& u) {
                using namespace real;
                return std::vector{x[1], u[0] - p[0] * x[0] - p[1] * abs(x[1]) * x[1]};
            });
    case 9: // dry friction with a steep slope
        return with(
            {{1, 2, 1, 20}, box{between(0.2, 0.8), between(0.8, 1.2)}, {0.6}, -1, 1, false, true},
            [](auto const&, auto const& x, auto const& p, auto const& u) {
                using namespace real;
                using value = std::decay_t<decltype(x[0])>;
                return std::vector{p[1] * u[0] -
                                   p[0] * saturate(10 * x[0], value(-1.0), value(1.0))};
            });
    case 10: // an actuator that saturates at an unknown limit
        return with(
            {{1, 2, 1, 20}, box{between(0.3, 0.9), between(0.5, 1.5)}, {0.5}, 0, 1.2, false, true},
            [](auto const&, auto const& x, auto const& p, auto const& u) {
                using namespace real;
                return std::vector{p[1] * (min(u[0], p[0]) - x[0])};
            });
    case 11: // Torricelli's tank
        return with({{1, 2, 1, 20}, box{between(0.2, 0.6), between(0.6, 1.2)}, {2}, 0.3, 1},
                    [](auto const&, auto const& x, auto const& p, auto const& u) {
                        using namespace real;
                        return std::vector{p[1] * u[0] - p[0] * sqrt(x[0])};
                    });
    case 12: { // dry friction with a jump, and sticking
        coulomb_friction const law;
        return plant_on(
            d, {{2, 2, 1, 20}, box{between(0.8, 1.2), between(0.1, 0.5)}, {0.1, 0.5}, -1, 1, true},
            look, law,
            [](auto const& x0, auto const& p, double from, auto const& times, auto const& inputs) {
                return coulomb_friction::solve(x0, p, from, times, inputs);
            });
    }
    default: // products in every equation, with an inverse square
        return with({{2, 4, 0, 20},
                     box{between(0.6, 1.2), between(0.5, 1), between(0.7, 1.4), between(-0.5, 0.8)},
                     {1, 0.5}},
                    [](auto const&, auto const& x, auto const& p, auto const&) {
                        using namespace real;
                        return std::vector{p[3] * x[1] - p[0] * p[1] * x[0],
                                           x[0] / (sqr(p[2]) * p[0]) - x[1]};
                    });
    }
}

} // namespace

planted_problem plant_by_seed(draws& d) {
    while (true) {
        bool const classic = d.coin();
        auto planted = classic ? plant_classic(d, d.below(classics)) : plant_random(d);
        if (planted) return std::move(*planted);
    }
}

} // namespace planted
