// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_METHODS_HPP
#define SIVID_ENCLOSURE_METHODS_HPP

/// @file
/// The Runge-Kutta methods that `enclosure_options::method` can name, `rk4()` for instance, and
/// what makes steps by them (docs/theory/runge_kutta.md). Who names none compiles none.

#include <sivid/compiled.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>
#include <sivid/enclosure/runge_kutta/tableau.hpp>
#include <sivid/enclosure/step/step_method.hpp>
#include <sivid/enclosure/stiff/detail/dissipative_step.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// The steps of an explicit method: its formula alone.
template <class I>
class explicit_steps final : public step_method<I> {
public:
    explicit_steps(flow const& f, enclosure_options const& options) : method_(f, *options.method) {}

    void set_ensemble(ensemble<I> const& e) override {
        method_.set_parameters(point_box<I>(e.parameter_centre));
    }
    [[nodiscard]] bool is_implicit() const override { return false; }
    [[nodiscard]] std::optional<runge_kutta_formula<I>>
    formula(double from, std::vector<double> const& m, I const& s) override {
        return method_.formula(from, point_box<I>(m), s);
    }
    [[nodiscard]] std::optional<tube_step<I>>
    prove_long(doubleton<I> const&, double, std::vector<double> const&,
               std::function<bool(tube_step<I>&)> const&) override {
        return std::nullopt;
    }
    [[nodiscard]] std::optional<step_map<I>> map_long(tube_step<I> const&, double) override {
        return std::nullopt;
    }

private:
    runge_kutta<I> method_;
};

/// The steps of an implicit method. Long ones are tried first.
template <class I>
class implicit_steps final : public step_method<I> {
    using traits = arithmetic_of<I>;

public:
    implicit_steps(flow const& f, enclosure_options const& options)
        : options_(options), method_(f, *options.method), long_(f, *options.method) {}

    void set_ensemble(ensemble<I> const& e) override {
        ensemble_ = &e;
        method_.set_parameters(point_box<I>(e.parameter_centre));
        long_.set_parameters(e.parameters, e.parameter_centre);
        length_ = options_.longest_step();
        pause_ = 0;
    }
    [[nodiscard]] bool is_implicit() const override { return true; }
    [[nodiscard]] std::optional<runge_kutta_formula<I>>
    formula(double from, std::vector<double> const& m, I const& s) override {
        return method_.formula(from, point_box<I>(m), s);
    }
    [[nodiscard]] std::optional<tube_step<I>>
    prove_long(doubleton<I> const& set, double limit, std::vector<double> const& margin,
               std::function<bool(tube_step<I>&)> const& admit) override;
    [[nodiscard]] std::optional<step_map<I>> map_long(tube_step<I> const& step,
                                                      double to) override {
        return long_.map(step.from, to, step.start.centre, step.tube);
    }

private:
    /// What the map of a step loses, of what it may: of each state `margin` by the defect, and by
    /// the slack of the derivative a hundredth of its width besides.
    [[nodiscard]] double loss(step_map<I> const& map, doubleton<I> const& set,
                              basic_box<I> const& x, std::vector<double> const& margin) const;

    enclosure_options options_;
    implicit_runge_kutta<I> method_;
    dissipative_step<I> long_;
    ensemble<I> const* ensemble_ = nullptr;
    double length_ = 1; ///< of the next long step
    int pause_ = 0;     ///< steps until long ones are tried again
};

template <class I>
double implicit_steps<I>::loss(step_map<I> const& map, doubleton<I> const& set,
                               basic_box<I> const& x, std::vector<double> const& margin) const {
    auto const n = x.size();
    double ratio = 0;
    for (std::size_t i = 0; i < n; ++i) {
        auto const row = static_cast<Eigen::Index>(i);
        ratio = std::max(ratio, map.error[row] / margin[i]);
        double spread = 0; // of the derivative, on this set
        for (std::size_t c = 0; c < ensemble_->deviation.size(); ++c) {
            double const size = c < n ? traits::mag(traits::sub(x[c], traits::point(set.centre[c])))
                                      : traits::mag(ensemble_->deviation[c]);
            spread += map.slack(row, static_cast<Eigen::Index>(c)) * size;
        }
        ratio = std::max(ratio, spread / (margin[i] + 0.01 * traits::width(x[i])));
    }
    return ratio;
}

template <class I>
std::optional<tube_step<I>>
implicit_steps<I>::prove_long(doubleton<I> const& set, double limit,
                              std::vector<double> const& margin,
                              std::function<bool(tube_step<I>&)> const& admit) {
    static constexpr double shortest = 2; // in time constants: below, the series do better
    if (pause_ > 0) {
        --pause_;
        return std::nullopt;
    }
    auto const x = set.hull_and_centre();
    double const rest = limit - set.time;
    double const constant = 1 / long_.stiffness(set.time, x);
    double h = std::min({rest, options_.longest_step(), length_});
    if (h < rest && h > 0.5 * rest) h = 0.5 * rest;
    double const proposed = h;
    for (int attempt = 0; attempt < 12 && h > shortest * constant; ++attempt) {
        double const to = h >= rest ? limit : set.time + h;
        if (h < options_.shortest_step() || !(to > set.time)) break;
        auto tube = long_.enclose(set.time, to, x, set.centre, margin);
        auto map = tube ? long_.map(set.time, to, set.centre, *tube) : std::nullopt;
        double const ratio = map ? loss(*map, set, x, margin) : HUGE_VAL;
        if (!(ratio <= 1)) {
            double const power = 1.0 / static_cast<double>(long_.order());
            h *= std::isfinite(ratio) ? std::clamp(0.9 * std::pow(ratio, -power), 0.1, 0.8) : 0.5;
            continue;
        }
        length_ = h < proposed ? 1.1 * h : std::max(length_, 1.5 * h);
        tube_step<I> step;
        step.from = set.time;
        step.to = to;
        step.start = set;
        step.order = long_.order();
        step.long_map = std::make_shared<step_map<I> const>(std::move(*map));
        step.swept = *tube;
        step.tube = std::move(*tube);
        step.variation = Eigen::MatrixXd::Constant(
            static_cast<Eigen::Index>(x.size()),
            static_cast<Eigen::Index>(ensemble_->deviation.size()), HUGE_VAL);
        if (!admit(step)) break;
        return step;
    }
    length_ = 4 * h;
    pause_ = 8;
    return std::nullopt;
}

/// Makes steps by formulas, whatever the method.
template <class I>
struct formula_step_maker final : step_method_maker<I> {
    [[nodiscard]] std::unique_ptr<step_method<I>>
    make(flow const& f, enclosure_options const& options) const override {
        if (options.method->is_explicit()) return std::make_unique<explicit_steps<I>>(f, options);
        return std::make_unique<implicit_steps<I>>(f, options);
    }
};
template <class I>
inline formula_step_maker<I> const makes_formula_steps{};

/// A tableau as a method that options can name, for steps in intervals of type I.
template <class I = interval>
[[nodiscard]] tableau for_steps(tableau t) {
    t.steps = &makes_formula_steps<I>;
    return t;
}

#ifdef SIVID_COMPILED_ALIKE // its members are compiled once
extern template struct formula_step_maker<interval>;
#endif

/// Runge's method of order 2.
[[nodiscard]] inline tableau explicit_midpoint() {
    return for_steps(
        tableau{"explicit midpoint", 2, {{}, {{1, 2}}}, {{0, 1}, {1, 1}}, {{0, 1}, {1, 2}}});
}

/// Heun's method of order 2.
[[nodiscard]] inline tableau heun() {
    return for_steps(tableau{"heun", 2, {{}, {{1, 1}}}, {{1, 2}, {1, 2}}, {{0, 1}, {1, 1}}});
}

/// Kutta's method of order 3.
[[nodiscard]] inline tableau kutta3() {
    return for_steps(tableau{"kutta3",
                             3,
                             {{}, {{1, 2}}, {{-1, 1}, {2, 1}}},
                             {{1, 6}, {2, 3}, {1, 6}},
                             {{0, 1}, {1, 2}, {1, 1}}});
}

/// The classical method of order 4.
[[nodiscard]] inline tableau rk4() {
    return for_steps(tableau{"rk4",
                             4,
                             {{}, {{1, 2}}, {{0, 1}, {1, 2}}, {{0, 1}, {0, 1}, {1, 1}}},
                             {{1, 6}, {1, 3}, {1, 3}, {1, 6}},
                             {{0, 1}, {1, 2}, {1, 2}, {1, 1}}});
}

/// The method of order 5 in the pair of Dormand and Prince, six stages.
/// @ref  Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), table II.5.2
[[nodiscard]] inline tableau dormand_prince5() {
    return for_steps(tableau{"dormand-prince5",
                             5,
                             {{},
                              {{1, 5}},
                              {{3, 40}, {9, 40}},
                              {{44, 45}, {-56, 15}, {32, 9}},
                              {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
                              {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
                             {{35, 384}, {0, 1}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}},
                             {{0, 1}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1, 1}}});
}

/// Butcher's method of order 6, seven stages.
/// @ref  Butcher, J. Austral. Math. Soc. 4 (1964)
[[nodiscard]] inline tableau butcher6() {
    return for_steps(tableau{"butcher6",
                             6,
                             {{},
                              {{1, 3}},
                              {{0, 1}, {2, 3}},
                              {{1, 12}, {1, 3}, {-1, 12}},
                              {{-1, 16}, {9, 8}, {-3, 16}, {-3, 8}},
                              {{0, 1}, {9, 8}, {-3, 8}, {-3, 4}, {1, 2}},
                              {{9, 44}, {-9, 11}, {63, 44}, {18, 11}, {0, 1}, {-16, 11}}},
                             {{11, 120}, {0, 1}, {27, 40}, {27, 40}, {-4, 15}, {-4, 15}, {11, 120}},
                             {{0, 1}, {1, 3}, {2, 3}, {1, 3}, {1, 2}, {1, 2}, {1, 1}}});
}

// The implicit methods, with the nodes of the Gauss, Radau and Lobatto quadratures; the roots are
// enclosed when a method is used.
// Reference: Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section IV.5.

/// Gauss, one stage: the implicit midpoint rule, order 2.
[[nodiscard]] inline tableau gauss2() {
    return for_steps(tableau{"gauss2", 2, {{{1, 2}}}, {{1, 1}}, {{1, 2}}});
}

/// Gauss, two stages, order 4.
[[nodiscard]] inline tableau gauss4() {
    return for_steps(tableau{"gauss4",
                             4,
                             {{{1, 4}, {3, 12, -2, 3}}, {{3, 12, 2, 3}, {1, 4}}},
                             {{1, 2}, {1, 2}},
                             {{3, 6, -1, 3}, {3, 6, 1, 3}}});
}

/// Gauss, three stages, order 6.
[[nodiscard]] inline tableau gauss6() {
    return for_steps(tableau{"gauss6",
                             6,
                             {{{5, 36}, {10, 45, -3, 15}, {25, 180, -6, 15}},
                              {{10, 72, 3, 15}, {2, 9}, {10, 72, -3, 15}},
                              {{25, 180, 6, 15}, {10, 45, 3, 15}, {5, 36}}},
                             {{5, 18}, {4, 9}, {5, 18}},
                             {{5, 10, -1, 15}, {1, 2}, {5, 10, 1, 15}}});
}

/// Radau IIA, two stages, order 3.
[[nodiscard]] inline tableau radau_iia3() {
    return for_steps(tableau{"radau_iia3",
                             3,
                             {{{5, 12}, {-1, 12}}, {{3, 4}, {1, 4}}},
                             {{3, 4}, {1, 4}},
                             {{1, 3}, {1, 1}}});
}

/// Radau IIA, three stages, order 5.
[[nodiscard]] inline tableau radau_iia5() {
    return for_steps(tableau{"radau_iia5",
                             5,
                             {{{88, 360, -7, 6}, {296, 1800, -169, 6}, {-2, 225, 3, 6}},
                              {{296, 1800, 169, 6}, {88, 360, 7, 6}, {-2, 225, -3, 6}},
                              {{16, 36, -1, 6}, {16, 36, 1, 6}, {1, 9}}},
                             {{16, 36, -1, 6}, {16, 36, 1, 6}, {1, 9}},
                             {{4, 10, -1, 6}, {4, 10, 1, 6}, {1, 1}}});
}

/// Lobatto IIIC, two stages, order 2.
[[nodiscard]] inline tableau lobatto_iiic2() {
    return for_steps(tableau{"lobatto_iiic2",
                             2,
                             {{{1, 2}, {-1, 2}}, {{1, 2}, {1, 2}}},
                             {{1, 2}, {1, 2}},
                             {{0, 1}, {1, 1}}});
}

/// Lobatto IIIC, three stages, order 4.
[[nodiscard]] inline tableau lobatto_iiic4() {
    return for_steps(
        tableau{"lobatto_iiic4",
                4,
                {{{1, 6}, {-1, 3}, {1, 6}}, {{1, 6}, {5, 12}, {-1, 12}}, {{1, 6}, {2, 3}, {1, 6}}},
                {{1, 6}, {2, 3}, {1, 6}},
                {{0, 1}, {1, 2}, {1, 1}}});
}

/// Lobatto IIIC, four stages, order 6.
[[nodiscard]] inline tableau lobatto_iiic6() {
    return for_steps(tableau{"lobatto_iiic6",
                             6,
                             {{{1, 12}, {0, 12, -1, 5}, {0, 12, 1, 5}, {-1, 12}},
                              {{1, 12}, {1, 4}, {10, 60, -7, 5}, {0, 60, 1, 5}},
                              {{1, 12}, {10, 60, 7, 5}, {1, 4}, {0, 60, -1, 5}},
                              {{1, 12}, {5, 12}, {5, 12}, {1, 12}}},
                             {{1, 12}, {5, 12}, {5, 12}, {1, 12}},
                             {{0, 1}, {5, 10, -1, 5}, {5, 10, 1, 5}, {1, 1}}});
}

/// All methods that sivid brings along, explicit ones first; each has its `name`.
[[nodiscard]] inline std::vector<tableau> shipped_methods() {
    return {
        explicit_midpoint(), heun(),          kutta3(),        rk4(),          dormand_prince5(),
        butcher6(),          gauss2(),        gauss4(),        gauss6(),       radau_iia3(),
        radau_iia5(),        lobatto_iiic2(), lobatto_iiic4(), lobatto_iiic6()};
}

} // namespace sivid

#endif
