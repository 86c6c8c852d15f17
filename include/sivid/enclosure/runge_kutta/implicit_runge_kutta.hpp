// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_IMPLICIT_RUNGE_KUTTA_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_IMPLICIT_RUNGE_KUTTA_HPP

#include <sivid/enclosure/runge_kutta/implicit_stages.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>
#include <sivid/space/matrix.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// The formula of an implicit Runge-Kutta method as a function of the step,
///   \f$ \phi(s) = x + s \sum_i b_i k_i(s) \f$, where k(s) is the solution of the stage equations
///   that begins as f(t, x) at s = 0: proved to exist on the whole step, to be the only one near,
///   and expanded in s by the same series as the solution itself.
/// The local error is that of explicit methods: \f$ h^{p+1} ( x^{[p+1]}(B) - \phi^{[p+1]}([0,h]) )
/// \f$.
/// @tparam T  an interval type, or a Taylor model
/// @ref  docs/runge_kutta.md; Alexandre dit Sandretto and Chapoutot, Reliable Computing 22 (2016)
template <class T>
class implicit_runge_kutta {
    using arithmetic = arithmetic_of<T>;
    using vector = std::vector<T>;

public:
    /// @throws std::invalid_argument for a tableau of another shape, or not of its stated order
    /// @param values  see `series`
    implicit_runge_kutta(flow const& f, tableau const& method, size_of_values<T> const& values = {})
        : flow_(&f), order_(method.order), stages_(f, method, values) {
        for (auto const& x : method.b) {
            b_.push_back(arithmetic::enclose(x.template enclose<interval>()));
        }
    }

    [[nodiscard]] std::size_t order() const { return order_; }
    [[nodiscard]] implicit_stages<T>& stages() { return stages_; }
    template <class Box>
    void set_parameters(Box const& p) {
        stages_.set_parameters(p);
    }

    /// \f$ \phi \f$ at every s in `step`, from proven stages there.
    [[nodiscard]] vector value(vector const& x, T const& step, stage_set<T> const& k) const {
        auto result = weighted(k.value);
        for (std::size_t s = 0; s < x.size(); ++s) {
            result[s] = arithmetic::add(x[s], arithmetic::mul(step, result[s]));
        }
        return result;
    }
    /// \f$ \phi^{[order]} \f$ at every s in `step`; nothing at a kink or outside the domain.
    /// @param order  at least 1
    [[nodiscard]] std::optional<vector> coefficient(double t, vector const& x, T const& step,
                                                    stage_set<T> const& stages, std::size_t order) {
        auto const k = stages_.expand(t, x, step, stages, order);
        if (!k) return std::nullopt;
        auto result = weighted((*k)[order]);
        auto const before = weighted((*k)[order - 1]);
        for (std::size_t s = 0; s < x.size(); ++s) {
            result[s] = arithmetic::add(arithmetic::mul(step, result[s]), before[s]);
        }
        return result;
    }
    /// The derivative of \f$ \phi(s) \f$ by x and the parameters, n x (n + parameters), by implicit
    /// differentiation: \f$ (1 - s A \otimes J) \partial k = (\partial_x f, \partial_p f) \f$.
    [[nodiscard]] interval_matrix<T> derivative(T const& step, stage_set<T> const& stages) const {
        auto const n = flow_->states();
        auto const columns = n + flow_->parameters();
        auto const entries = flow_->entries().size();
        interval_matrix<T> result(n, columns);
        for (std::size_t c = 0; c < columns; ++c) {
            vector right(b_.size() * n, arithmetic::point(0.0));
            for (std::size_t e = 0; e < entries; ++e) {
                auto const& entry = flow_->entries()[e];
                if (entry.column != c) continue;
                for (std::size_t i = 0; i < b_.size(); ++i) {
                    right[i * n + entry.row] = stages.jacobian[i * entries + e];
                }
            }
            auto const sum = weighted(stages_.solve(step, stages, right));
            for (std::size_t s = 0; s < n; ++s) {
                result(s, c) = arithmetic::add(arithmetic::point(s == c ? 1.0 : 0.0),
                                               arithmetic::mul(step, sum[s]));
            }
        }
        return result;
    }

    /// Value at the end of `step` and the coefficient over all of [0, step], for intervals.
    ///   The stages are proved on pieces of [0, step] that share their ends, where the solution of
    ///   one piece lies in the region of uniqueness of the next: so all are the same branch.
    /// @returns nothing when the stages could not be proved, or are not smooth
    template <class States>
    [[nodiscard]] std::optional<runge_kutta_formula<T>> formula(double t, States const& states,
                                                                T const& step) {
        static constexpr double smallest = 1.0 / 16; // piece of the step
        vector const x(states.begin(), states.end());
        double const end = arithmetic::upper(step);
        auto const at = [&](double s) { return s >= end ? step : arithmetic::point(s); };
        auto const first = stages_.apply(t, x, arithmetic::point(0.0),
                                         vector(b_.size() * x.size(), arithmetic::point(0.0)));
        if (!first) return std::nullopt;
        auto const last = stages_.prove(t, x, step);
        if (!last) return std::nullopt;
        runge_kutta_formula<T> result{value(x, step, *last), {}};
        auto here = *first; // the stages at the begin of the piece
        double from = 0;
        double to = end;
        while (from < end) {
            auto const range = arithmetic::bounds(from, to);
            auto const there = to >= end ? last : stages_.prove(t, x, at(to));
            bool const shortest = to - from < 1.5 * smallest * end;
            std::optional<vector> next;
            if (there) {
                auto const piece = stages_.prove(t, x, range, {here, there->value});
                bool const same = piece && piece->holds(here) && piece->holds(there->value);
                if (same && (shortest || piece->contracts(0.2))) {
                    next = coefficient(t, x, range, *piece, order_ + 1);
                }
            }
            if (!next) {
                if (shortest) return std::nullopt;
                to = from + 0.5 * (to - from);
                continue;
            }
            if (result.next.empty()) {
                result.next = std::move(*next);
            } else {
                for (std::size_t s = 0; s < x.size(); ++s) {
                    result.next[s] = arithmetic::hull(result.next[s], (*next)[s]);
                }
            }
            here = there->value;
            double const length = to - from;
            from = to;
            to = from + 2 * length < end ? from + length : end;
        }
        return result;
    }

private:
    /// \f$ \sum_i b_i k_i \f$
    [[nodiscard]] vector weighted(vector const& k) const {
        auto const n = flow_->states();
        vector result;
        for (std::size_t s = 0; s < n; ++s) {
            typename arithmetic::accumulator sum;
            for (std::size_t i = 0; i < b_.size(); ++i) sum.add_product(b_[i], k[i * n + s]);
            result.push_back(sum.result());
        }
        return result;
    }

    flow const* flow_;
    std::size_t order_;
    implicit_stages<T> stages_;
    vector b_;
};

} // namespace sivid

#endif
