// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SENSITIVITY_SENSITIVITY_TUBE_HPP
#define SIVID_ENCLOSURE_SENSITIVITY_SENSITIVITY_TUBE_HPP

#include <sivid/enclosure/set/detail/derivative_set.hpp>
#include <sivid/enclosure/tube.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// A tube together with the derivatives of all its trajectories by initial state and parameters:
/// the solution of the variational equation \f$ S' = f_x S + [0, f_p],\ S = [1, 0] \f$ at the
/// begin, enclosed for every member at every time. Columns: initial states, then parameters.
///   Across kinks the enclosed derivative is Clarke's generalised one. Where the right-hand side
///   may jump there is none: from there on every entry is unbounded.
template <class I>
class sensitivity_tube {
    using traits = arithmetic_of<I>;

public:
    sensitivity_tube(tube<I> states, std::vector<std::optional<derivative_set<I>>> derivatives)
        : states_(std::move(states)), derivatives_(std::move(derivatives)) {
        if (derivatives_.size() != states_.steps().size() + 1) {
            throw std::invalid_argument("sensitivity_tube: one set of derivatives for the begin "
                                        "and one for each step");
        }
    }

    [[nodiscard]] tube<I> const& states() const { return states_; }

    /// \f$ \partial x(t) / \partial (x_0, p) \f$, n x (n + parameters).
    /// @throws std::out_of_range outside the tube
    /// @cost  that of one step when t lies inside a step
    [[nodiscard]] interval_matrix<I> at(double t) const {
        if (t == states_.end_time()) return hull_of(derivatives_.back());
        auto const k = states_.step_index(t);
        if (t == states_.steps()[k].from) return hull_of(derivatives_[k]);
        if (!derivatives_[k]) return unknown();
        auto const j = states_.step_derivative(k, t);
        return j ? derivatives_[k]->mapped(*j).hull() : unknown();
    }

    /// The derivatives at all times in [from, to]: over each step \f$ S(s) = V(s) S(step's begin)
    /// \f$ with the bound on V that the step proved.
    [[nodiscard]] interval_matrix<I> over(double from, double to) const {
        if (!(from <= to))
            throw std::invalid_argument("sensitivity_tube: a span must not end before it begins");
        auto result = at(from);
        unite(result, at(to));
        for (std::size_t k = 0; k < states_.steps().size(); ++k) {
            auto const& step = states_.steps()[k];
            if (step.to <= from || step.from >= to) continue;
            if (!derivatives_[k] || step.jumps || step.dissipative) return unknown();
            interval_matrix<I> v(result.rows(), result.cols());
            for (std::size_t i = 0; i < v.rows(); ++i) {
                for (std::size_t c = 0; c < v.cols(); ++c) {
                    double const e =
                        step.variation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c));
                    v(i, c) = traits::add(traits::point(i == c ? 1.0 : 0.0), traits::bounds(-e, e));
                }
            }
            unite(result, derivatives_[k]->mapped(v).hull());
        }
        return result;
    }

    /// \f$ \partial y(t) / \partial (x_0, p) \f$ of the channels, for all members; a held input has
    /// its new value at a knot. Rows of channels that are not defined there, or jump, are
    /// unbounded.
    [[nodiscard]] interval_matrix<I> observe_at(double t) const {
        auto const& f = states_.equations();
        auto const n = f.states();
        auto const s = at(t);
        auto const x = states_.at(t);
        series<I> observe(f.observe_jacobian(), 0);
        observe.set_parameters(states_.ensemble().parameters);
        I const time = traits::point(t);
        input_pieces<I> const inputs(f, t, time);
        observe.start(time);
        auto const state = [&x](std::size_t i, std::size_t) { return x[i]; };
        observe.advance_principal(0, state, inputs);
        bool const jumps = observe.jumped(); // signs in the derivative of a kink are none
        observe.advance_rest(0, state, inputs);
        interval_matrix<I> result(f.channels(), s.cols());
        for (auto const& e : f.observe_entries()) {
            auto const d = observe.output(e.output, 0);
            if (e.column >= n) {
                result(e.row, e.column) = traits::add(result(e.row, e.column), d);
                continue;
            }
            for (std::size_t c = 0; c < s.cols(); ++c) {
                if (!f.sensitive(e.column, c)) continue;
                result(e.row, c) = traits::add(result(e.row, c), traits::mul(d, s(e.column, c)));
            }
        }
        return jumps || observe.undefined() ? unknown(f.channels()) : result;
    }

private:
    [[nodiscard]] interval_matrix<I> unknown() const {
        return unknown(states_.equations().states());
    }
    [[nodiscard]] interval_matrix<I> unknown(std::size_t rows) const {
        auto const& f = states_.equations();
        interval_matrix<I> result(rows, f.states() + f.parameters());
        for (std::size_t i = 0; i < result.rows(); ++i) {
            for (std::size_t c = 0; c < result.cols(); ++c) result(i, c) = traits::entire();
        }
        return result;
    }
    [[nodiscard]] interval_matrix<I> hull_of(std::optional<derivative_set<I>> const& s) const {
        return s ? s->hull() : unknown();
    }
    static void unite(interval_matrix<I>& a, interval_matrix<I> const& b) {
        for (std::size_t i = 0; i < a.rows(); ++i) {
            for (std::size_t c = 0; c < a.cols(); ++c) a(i, c) = traits::hull(a(i, c), b(i, c));
        }
    }

    tube<I> states_;
    std::vector<std::optional<derivative_set<I>>> derivatives_; ///< at the begin, after each step
};

/// Encloses the trajectories as `integrate` does, and their derivatives in the same run.
///   The order of the derivatives' series is `options.variational_order`, about half of the
///   states' order by default, which is enough for the states: for derivatives as sharp as the
///   states, set it to `options.order`.
/// @throws std::invalid_argument for inputs with error bounds: steps bound the derivatives on the
///         recorded inputs only
/// @cost  that of `integrate` and about n (n + parameters) products of matrix entries a step
template <class I = interval>
[[nodiscard]] sensitivity_tube<I>
integrate_with_sensitivities(std::shared_ptr<flow const> f, basic_box<I> const& initial,
                             basic_box<I> const& parameters, double from, double to,
                             enclosure_options const& options = {}) {
    if (!(from <= to)) {
        throw std::invalid_argument("integrate_with_sensitivities: the end lies before the begin");
    }
    if (f->uncertain()) {
        throw std::invalid_argument("integrate_with_sensitivities: inputs with error bounds are "
                                    "not supported; give signals without bounds");
    }
    auto const how = for_span(options, to - from);
    trajectory<I> run(*f, how);
    run.begin(from, initial, parameters);
    tube<I> states(f, how, run.ensemble(), run.set());
    std::vector<std::optional<derivative_set<I>>> derivatives{
        derivative_set<I>(f->states(), f->parameters())};
    while (run.time() < to) {
        if (!run.step(to)) {
            states.stop(*run.failure());
            break;
        }
        auto const& before = derivatives.back();
        auto const j = before ? run.last_derivative() : std::nullopt;
        std::optional<derivative_set<I>> next;
        if (j) next = before->mapped(*j);
        derivatives.push_back(std::move(next));
        states.append(run.last(), run.set());
    }
    return {std::move(states), std::move(derivatives)};
}

} // namespace sivid

#endif
