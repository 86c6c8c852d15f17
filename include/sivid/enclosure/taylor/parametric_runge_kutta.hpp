// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_RUNGE_KUTTA_HPP
#define SIVID_ENCLOSURE_TAYLOR_PARAMETRIC_RUNGE_KUTTA_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/runge_kutta/implicit_runge_kutta.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// The centre of a set follows a Runge-Kutta method of order p, explicit or implicit, in
/// polynomials:
///   \f$ \phi(h; P) + h^{p+1} ( x_{p+1}(b) - \phi_{p+1}([0,h]; P) ) \f$
/// with b the tube of `parametric_flow`. The stages of an implicit method are proved by a Krawczyk
/// operator that holds for every value of the unknowns.
/// Smooth models only: a step whose tube touches a kink is not taken.
/// @ref  docs/runge_kutta.md
template <class Model>
class runge_kutta_centre {
    using shape_type = typename Model::shape_type;

public:
    static constexpr bool by_formula = true;

    /// The series that prove the tube are of the method's order.
    /// @throws std::invalid_argument when the options name no method
    [[nodiscard]] static enclosure_options fit(enclosure_options options) {
        if (!options.method) {
            throw std::invalid_argument("parametric_runge_kutta: the options name no method");
        }
        options.order = options.method->order;
        return options;
    }

    runge_kutta_centre(flow const& f, enclosure_options const& options, shape_type const& shape,
                       shape_type const& tube_shape)
        : shape_(&shape), tube_shape_(&tube_shape), order_(options.order) {
        if (options.method->is_explicit()) {
            explicit_value_.emplace(f, *options.method, shape);
            explicit_next_.emplace(f, *options.method, tube_shape);
        } else {
            implicit_value_.emplace(f, *options.method, shape);
            implicit_next_.emplace(f, *options.method, tube_shape);
        }
    }

    /// @param wide  the same with the variables of a tube
    void set_parameters(std::vector<Model> const& p, std::vector<Model> const& wide) {
        if (explicit_value_) {
            explicit_value_->set_parameters(p);
            explicit_next_->set_parameters(wide);
        } else {
            implicit_value_->set_parameters(p);
            implicit_next_->set_parameters(wide);
        }
    }

    /// The method's value after h, and its coefficient p + 1 at all times of the step.
    /// @param s  these times, from 0 to at least h
    /// @returns  what is not proved
    [[nodiscard]] std::optional<failure_reason> apply(double from, std::vector<Model> const& x,
                                                      interval const& h, Model const& s) {
        bool never = false;
        power_ = interval_traits<interval>::pown(h, static_cast<int>(order_ + 1), never);
        auto const length = Model::constant(h);
        std::vector<Model> start;
        for (auto const& p : x) start.push_back(converted(p, *tube_shape_));
        if (explicit_value_) {
            bool undefined = false;
            value_ = explicit_value_->coefficient(from, x, length, 0, undefined);
            bool const rough = explicit_value_->kinked();
            next_ = explicit_next_->coefficient(from, start, s, order_ + 1, undefined);
            if (undefined || rough || explicit_next_->kinked()) return failure_reason::minimum_step;
            return std::nullopt;
        }
        auto const last = implicit_value_->stages().prove(from, x, length);
        if (!last) return failure_reason::unsolved_stages;
        value_ = implicit_value_->value(x, length, *last);
        // One region of uniqueness for the whole step, which holds the stages at its begin and
        // those that make the value: they are on one branch.
        std::vector<Model> there;
        for (auto const& k : last->value) there.push_back(converted(k, *tube_shape_));
        auto const first = implicit_next_->stages().apply(from, start, Model::constant(0.0),
                                                          std::vector<Model>(there.size()));
        if (!first) return failure_reason::unsolved_stages;
        auto const all = implicit_next_->stages().prove(from, start, s, {*first, there});
        if (!all || !all->holds(*first) || !all->holds(there))
            return failure_reason::unsolved_stages;
        auto next = implicit_next_->coefficient(from, start, s, *all, order_ + 1);
        if (!next) return failure_reason::unsolved_stages;
        next_ = std::move(*next);
        return std::nullopt;
    }
    /// What state i may lose by the method's part of the local error.
    [[nodiscard]] double loss(std::size_t i) const {
        return (next_[i].spread() + next_[i].r()) * power_.upper();
    }
    /// State i at the end of the step.
    /// @param series  coefficient p + 1 of the solution on the tube
    [[nodiscard]] Model at_end(std::size_t i, Model const& series) const {
        return value_[i] + scaled(without_last_variable(series - next_[i], *shape_), power_);
    }

private:
    shape_type const *shape_, *tube_shape_;
    std::size_t order_; ///< p
    std::optional<runge_kutta<Model>> explicit_value_, explicit_next_;
    std::optional<implicit_runge_kutta<Model>> implicit_value_, implicit_next_;
    std::vector<Model> value_; ///< phi(h; P)
    std::vector<Model> next_;  ///< phi_{p+1}
    interval power_;           ///< h^{p+1}
};

/// A `parametric_flow` by the method that the options name.
template <class Model = taylor_model<double>>
using parametric_runge_kutta = parametric_flow<Model, runge_kutta_centre<Model>>;

#ifdef SIVID_COMPILED // its members are compiled once
extern template class parametric_flow<taylor_model<double>,
                                      runge_kutta_centre<taylor_model<double>>>;
extern template class implicit_stages<taylor_model<double>>;
#endif

} // namespace sivid

#endif
