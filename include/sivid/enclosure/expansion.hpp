// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_EXPANSION_HPP
#define SIVID_ENCLOSURE_EXPANSION_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/model/series.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/matrix.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// Coefficients 0 and 1 of the inputs at a time, on the pieces that govern a step.
template <class T>
struct input_pieces {
    std::vector<T> value;
    std::vector<T> slope;

    /// @param start  the step's begin: it selects the pieces
    /// @param t      the expansion point, or a range of times within the step
    input_pieces(flow const& f, double start, T const& t)
        : value(f.model().about.inputs.size(), arithmetic_of<T>::point(0.0)), slope(value) {
        for (auto const i : f.sampled_inputs()) {
            auto const& u = f.input(i);
            auto const piece = u.piece(start);
            if constexpr (std::is_same_v<T, double>) {
                value[i] = u.approximate_on(piece, t);
            } else {
                value[i] = u.template value<T>(piece, t);
                slope[i] = u.template slope<T>(piece);
            }
        }
    }
    T operator()(std::size_t i, std::size_t k) const {
        if (k == 0) return value[i];
        return k == 1 ? slope[i] : arithmetic_of<T>::point(0.0);
    }
};

/// Taylor coefficients of the solution of x' = f(t, x, p, u), and of its variational equation
///   \f$ V' = \partial_x f \, V + [0, \partial_p f] \f$, \f$ V(0) = [1, 0] \f$,
/// about any box of states and range of times. For intervals, each coefficient encloses the true
/// one at every point of the ranges.
template <class I>
class expansion {
    using traits = arithmetic_of<I>;

public:
    expansion(flow const& f, std::size_t max_order)
        : flow_(&f),
          stride_(max_order + 1),
          values_(f.rate(), max_order),
          jacobian_(f.rate_jacobian(), max_order),
          x_(f.states() * stride_, traits::point(0.0)),
          v_(f.states() * (f.states() + f.parameters()) * stride_, traits::point(0.0)) {}

    void set_parameters(basic_box<I> const& p) {
        values_.set_parameters(p);
        jacobian_.set_parameters(p);
    }

    /// Coefficients 0 .. order of the solution through `x` at `t`.
    void expand(double start, I const& t, basic_box<I> const& x, std::size_t order) {
        run(values_, start, t, x, order);
    }

    /// The same with the coefficients 0 .. order of V.
    void expand_with_variations(double start, I const& t, basic_box<I> const& x,
                                std::size_t order) {
        run(jacobian_, start, t, x, order);
        auto const n = flow_->states();
        auto const columns = n + flow_->parameters();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns; ++c) {
                v(i, c, 0) = traits::point(i == c ? 1.0 : 0.0);
            }
        }
        auto const& program = flow_->rate_jacobian();
        for (std::size_t k = 0; k < order; ++k) {
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t c = 0; c < columns; ++c) v(i, c, k + 1) = traits::point(0.0);
            }
            for (auto const& e : flow_->entries()) {
                bool const varies = program.output_varies(e.output);
                if (e.column >= n) {
                    if (k == 0 || varies) {
                        auto& target = v(e.row, e.column, k + 1);
                        target = traits::add(target, jacobian_.output(e.output, k));
                    }
                    continue;
                }
                std::size_t const last = varies ? k : 0;
                for (std::size_t c = 0; c < columns; ++c) {
                    if (!flow_->sensitive(e.column, c)) continue;
                    I sum = v(e.row, c, k + 1);
                    for (std::size_t j = 0; j <= last; ++j) {
                        sum = traits::add(
                            sum, traits::mul(jacobian_.output(e.output, j), v(e.column, c, k - j)));
                    }
                    v(e.row, c, k + 1) = sum;
                }
            }
            divide(k, columns);
        }
    }

    /// \f$ x_i^{[k]} \f$
    [[nodiscard]] I const& state(std::size_t i, std::size_t k) const { return x_[i * stride_ + k]; }
    /// \f$ V_{ic}^{[k]} \f$, c a state or state_count + a parameter.
    [[nodiscard]] I const& variation(std::size_t i, std::size_t c, std::size_t k) const {
        return v_[(i * (flow_->states() + flow_->parameters()) + c) * stride_ + k];
    }
    /// Value of an entry of the Jacobian of f, after `expand_with_variations`.
    [[nodiscard]] I const& jacobian(jacobian_entry const& e) const {
        return jacobian_.output(e.output, 0);
    }
    [[nodiscard]] typename traits::mask undefined() const { return undefined_; }
    [[nodiscard]] bool kinked() const { return kinked_; }
    /// The right-hand side itself may jump within the last `expand` (not its Jacobian).
    [[nodiscard]] bool jumped() const { return jumped_; }
    [[nodiscard]] std::size_t max_order() const { return stride_ - 1; }

private:
    I& v(std::size_t i, std::size_t c, std::size_t k) {
        return v_[(i * (flow_->states() + flow_->parameters()) + c) * stride_ + k];
    }
    void run(series<I>& s, double start, I const& t, basic_box<I> const& x, std::size_t order) {
        input_pieces<I> const inputs(*flow_, start, t);
        auto const state = [this](std::size_t i, std::size_t k) { return x_[i * stride_ + k]; };
        auto const n = flow_->states();
        for (std::size_t i = 0; i < n; ++i) x_[i * stride_] = x[i];
        s.start(t);
        // The last order is needed of the Jacobian only where its entries enter V of that order.
        for (std::size_t k = 0; k < order; ++k) {
            s.advance(k, state, inputs);
            for (std::size_t i = 0; i < n; ++i) {
                bool const zero = k > 0 && !flow_->rate().output_varies(i);
                x_[i * stride_ + k + 1] = zero ? traits::point(0.0) : over(s.output(i, k), k + 1);
            }
        }
        undefined_ = s.undefined();
        kinked_ = s.kinked();
        jumped_ = values_.jumped();
    }
    void divide(std::size_t k, std::size_t columns) {
        if (k == 0) return;
        for (std::size_t i = 0; i < flow_->states(); ++i) {
            for (std::size_t c = 0; c < columns; ++c) {
                if (flow_->sensitive(i, c)) v(i, c, k + 1) = over(v(i, c, k + 1), k + 1);
            }
        }
    }
    static I over(I const& a, std::size_t k) {
        typename traits::mask undefined{};
        return k == 1 ? a : traits::div(a, traits::point(static_cast<double>(k)), undefined);
    }

    flow const* flow_;
    std::size_t stride_;
    series<I> values_;
    series<I> jacobian_;
    std::vector<I> x_;
    std::vector<I> v_;
    typename traits::mask undefined_{};
    bool kinked_ = false;
    bool jumped_ = false;
};

} // namespace sivid

#endif
