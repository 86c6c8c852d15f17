// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_TABLEAU_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_TABLEAU_HPP

#include <sivid/number/interval_traits.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// The number \f$ (n + f \sqrt{r}) / d \f$ of four integers, so that a tableau is exact: neither
/// 1/6 nor \f$ \sqrt 3 \f$ is a double.
struct surd {
    int numerator = 0;
    int denominator = 1;
    int factor = 0;
    int radicand = 0;

    /// The tightest product of one root, one product, one sum and one division.
    template <class I>
    [[nodiscard]] I enclose() const {
        using traits = interval_traits<I>;
        typename traits::mask never{};
        I value = traits::point(numerator);
        if (factor != 0) {
            I const root = traits::sqrt(traits::point(radicand), never);
            value = traits::add(value, traits::mul(traits::point(factor), root));
        }
        return traits::div(value, traits::point(denominator), never);
    }
};

/// Makes what steps by a method need: `step_method_maker` (step/step_method.hpp), for some types of
/// intervals.
struct any_step_method_maker {
    virtual ~any_step_method_maker() = default;
};

/// A Runge-Kutta method: \f$ k_i = f(t + c_i h, x + h \sum_j a_{ij} k_j) \f$,
/// \f$ x^+ = x + h \sum_i b_i k_i \f$.
///   Row i of `a` has i entries in an explicit method, and as many as there are stages in an
///   implicit one.
/// @given the method has the stated order. `require_order` (runge_kutta.hpp) refuses statements
///        that interval arithmetic disproves; the tests check the shipped ones in 50 digits.
struct tableau {
    std::string name;
    std::size_t order = 1;
    std::vector<std::vector<surd>> a;
    std::vector<surd> b;
    std::vector<surd> c;
    /// Null: coefficients alone. Methods that options name have it (`for_steps` of methods.hpp).
    any_step_method_maker const* steps = nullptr;

    [[nodiscard]] std::size_t stages() const { return b.size(); }

    [[nodiscard]] bool is_explicit() const {
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (a[i].size() != i) return false;
        }
        return true;
    }

    /// @throws std::invalid_argument when the shape is not that of an explicit method
    void require_explicit() const {
        if (has_sizes() && is_explicit()) return;
        throw std::invalid_argument("tableau '" + name +
                                    "': an explicit method needs s rows of "
                                    "0, 1, ..., s-1 coefficients, s weights and s nodes");
    }
    /// @throws std::invalid_argument when the shape is not that of an implicit method
    void require_implicit() const {
        bool good = has_sizes();
        for (auto const& row : a) good = good && row.size() == b.size();
        if (good) return;
        throw std::invalid_argument("tableau '" + name +
                                    "': an implicit method needs s rows of s coefficients, "
                                    "s weights and s nodes");
    }

private:
    [[nodiscard]] bool has_sizes() const {
        return !b.empty() && a.size() == b.size() && c.size() == b.size() && order >= 1;
    }
};

} // namespace sivid

#endif
