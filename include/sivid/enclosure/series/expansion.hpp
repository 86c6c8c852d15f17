// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SERIES_EXPANSION_HPP
#define SIVID_ENCLOSURE_SERIES_EXPANSION_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/matrix.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace sivid {

/// Coefficients 0 and 1 of the inputs at a time, on the pieces that govern a step.
template <class T>
struct input_pieces {
    std::vector<T> value;
    std::vector<T> slope;

    input_pieces() = default;
    /// @param start  the step's begin, in each lane if it is not a double: it selects the pieces
    /// @param t      the expansion point, or a range of times within the step
    template <class Start>
    input_pieces(flow const& f, Start const& start, T const& t)
        : value(f.model().about.inputs.size(), arithmetic_of<T>::point(0.0)), slope(value) {
        using A = arithmetic_of<T>;
        for (auto const i : f.sampled_inputs()) {
            auto const& u = f.input(i);
            auto const on_pieces = [&](auto const& get) {
                if constexpr (std::is_arithmetic_v<Start>) {
                    return A::enclose(get(u.piece(start)));
                } else {
                    return A::enclose_lanes([&](std::size_t l) {
                        return get(u.piece(lane_traits<Start>::get(start, l)));
                    });
                }
            };
            slope[i] = on_pieces([&](std::size_t p) { return u.template slope<interval>(p); });
            auto const since =
                A::sub(t, on_pieces([&](std::size_t p) { return interval(u.times()[p]); }));
            value[i] = A::add(on_pieces([&](std::size_t p) { return interval(u.values()[p]); }),
                              A::mul(slope[i], since));
        }
    }
    T operator()(std::size_t i, std::size_t k) const {
        if (k == 0) return value[i];
        return k == 1 ? slope[i] : arithmetic_of<T>::point(0.0);
    }
};

namespace enclosure_detail {
/// What computes V with its columns side by side, where the lanes are not taken by boxes
/// (taylor_expansion.hpp).
template <class T>
struct columns_of {
    struct type {};
};
} // namespace enclosure_detail

/// Which derivatives of the flow an expansion computes.
enum class variations {
    by_state,              ///< n columns
    by_state_and_parameter ///< n + parameters columns
};

/// Taylor coefficients of the solution of x' = f(t, x, p, u), and of its variational equation
///   \f$ V' = \partial_x f \, V + [0, \partial_p f] \f$, \f$ V(0) = [1, 0] \f$,
/// about any states and times of scalar type T: an interval, a Taylor model, a double. Each
/// coefficient encloses the true one at every point of the arguments' ranges.
template <class T>
class expansion {
    using arithmetic = arithmetic_of<T>;
    using storage = model_detail::storage_of<T>;

public:
    /// @param values  see `series`
    expansion(flow const& f, std::size_t max_order,
              variations which = variations::by_state_and_parameter,
              size_of_values<T> const& values = {})
        : flow_(&f),
          stride_(max_order + 1),
          columns_(f.states() + (which == variations::by_state_and_parameter ? f.parameters() : 0)),
          program_(which == variations::by_state ? &f.rate_state_jacobian() : &f.rate_jacobian()),
          entries_(which == variations::by_state ? f.state_entries() : f.entries().size()),
          series_(*program_, max_order, values),
          x_(storage::make(f.states() * stride_, values)),
          v_(storage::make(f.states() * columns_ * stride_, values)) {
        if constexpr (arithmetic::keeps_rows) {
            columns_at_once_ = enclosure_detail::columns_of<T>::make(f, *program_, entries_,
                                                                     columns_, stride_, values);
        }
    }

    template <class Box>
    void set_parameters(Box const& p) {
        series_.set_parameters(p);
    }

    /// Coefficients 0 .. order of the solution through `x` at `t`.
    template <class Start, class States>
    void expand(Start const& start, T const& t, States const& x, std::size_t order) {
        inputs_ = input_pieces<T>(*flow_, start, t);
        auto const n = flow_->states();
        for (std::size_t i = 0; i < n; ++i) x_[i * stride_] = x[i];
        series_.start(t);
        for (std::size_t k = 0; k < order; ++k) {
            series_.advance_principal(k, state_at(), inputs_);
            for (std::size_t i = 0; i < n; ++i) {
                bool const zero = k > 0 && !flow_->rate().output_varies(i);
                T& next = x_[i * stride_ + k + 1];
                if (zero) {
                    next = arithmetic::point(0.0);
                } else {
                    over(series_.output(i, k), k + 1, next);
                }
            }
        }
        jumped_ = series_.jumped();
        undefined_ = series_.undefined();
    }

    /// The coefficients 0 .. order of V in addition, after `expand` of at least that order.
    void add_variations(std::size_t order) {
        auto const n = flow_->states();
        for (std::size_t k = 0; k < order; ++k) {
            series_.advance_rest(k, state_at(), inputs_);
        }
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns_; ++c) {
                v(i, c, 0) = arithmetic::point(i == c ? 1.0 : 0.0);
            }
        }
        if constexpr (arithmetic::keeps_rows) {
            columns_at_once_.expand(series_, order);
            for (std::size_t i = 0; i < n; ++i) {
                for (auto const c : columns_at_once_.columns(i)) {
                    for (std::size_t k = 1; k <= order; ++k) {
                        columns_at_once_.get_into(v(i, c, k), i, c, k);
                    }
                }
            }
        } else {
            for (std::size_t k = 0; k < order; ++k) {
                for (std::size_t i = 0; i < n; ++i) {
                    for (std::size_t c = 0; c < columns_; ++c) {
                        if (flow_->sensitive(i, c)) next_variation(i, c, k, v(i, c, k + 1));
                    }
                }
            }
        }
    }

    /// Both.
    template <class Start, class States>
    void expand_with_variations(Start const& start, T const& t, States const& x,
                                std::size_t order) {
        expand(start, t, x, order);
        add_variations(order);
    }

    [[nodiscard]] std::size_t columns() const { return columns_; }
    /// \f$ x_i^{[k]} \f$
    [[nodiscard]] T const& state(std::size_t i, std::size_t k) const { return x_[i * stride_ + k]; }
    /// \f$ V_{ic}^{[k]} \f$, c a state or state_count + a parameter.
    [[nodiscard]] T const& variation(std::size_t i, std::size_t c, std::size_t k) const {
        return v_[(i * columns_ + c) * stride_ + k];
    }
    /// Value of an entry of the Jacobian of f, after `expand_with_variations`.
    [[nodiscard]] T const& jacobian(jacobian_entry const& e) const {
        return series_.output(e.output, 0);
    }
    [[nodiscard]] typename arithmetic::mask undefined() const { return series_.undefined(); }
    /// The rates are defined, but a derivative of them that V needs is not, as of a root at 0: all
    /// solutions, unique or not, stay where the rates are bounded.
    [[nodiscard]] typename arithmetic::mask steep() const {
        return series_.undefined() & !undefined_;
    }
    [[nodiscard]] typename arithmetic::mask kinked() const { return series_.kinked(); }
    /// The right-hand side itself may jump within the last `expand` (not its Jacobian).
    [[nodiscard]] typename arithmetic::mask jumped() const { return jumped_; }
    [[nodiscard]] std::size_t max_order() const { return stride_ - 1; }
    /// The coefficients of everything that the program computes, and the program.
    [[nodiscard]] series<T> const& coefficients() const { return series_; }
    [[nodiscard]] tape const& program() const { return *program_; }
    /// Coefficient 1 of an input, as the last expansion took it.
    [[nodiscard]] T const& input_slope(std::size_t i) const { return inputs_.slope[i]; }

private:
    T& v(std::size_t i, std::size_t c, std::size_t k) {
        return v_[(i * columns_ + c) * stride_ + k];
    }
    [[nodiscard]] auto state_at() const {
        return [this](std::size_t i, std::size_t k) -> T const& { return x_[i * stride_ + k]; };
    }
    /// Coefficient k of row i of the Jacobian times column c of V, divided by k + 1.
    void next_variation(std::size_t i, std::size_t c, std::size_t k, T& result) {
        auto const n = flow_->states();
        typename arithmetic::accumulator sum(result);
        for (std::size_t m = 0; m < entries_; ++m) {
            auto const& e = flow_->entries()[m];
            if (e.row != i) continue;
            bool const varies = program_->output_varies(e.output);
            if (e.column >= n) {
                if (e.column == c && (k == 0 || varies)) sum.add(series_.output(e.output, k));
                continue;
            }
            if (!flow_->sensitive(e.column, c)) continue;
            std::size_t const last = varies ? k : 0;
            for (std::size_t j = 0; j <= last; ++j) {
                if (k - j == 0 && e.column != c) continue; // V starts as the identity
                sum.add_product(series_.output(e.output, j), v(e.column, c, k - j));
            }
        }
        sum.result_into(result);
        if (k > 0) over(result, k + 1, result);
    }
    static void over(T const& a, std::size_t k, T& result) {
        if (k == 1) {
            result = a;
        } else if constexpr (requires { arithmetic::over_into(result, a, k); }) {
            arithmetic::over_into(result, a, k);
        } else {
            result = arithmetic::over(a, k);
        }
    }

    flow const* flow_;
    std::size_t stride_;
    std::size_t columns_;
    tape const* program_;
    std::size_t entries_; ///< of the Jacobian, that the program computes
    series<T> series_;
    input_pieces<T> inputs_;
    typename storage::type x_;
    typename storage::type v_;
    [[no_unique_address]] typename enclosure_detail::columns_of<T>::type columns_at_once_;
    typename arithmetic::mask jumped_{}, undefined_{}; ///< of the rates, after the last `expand`
};

} // namespace sivid

#endif
