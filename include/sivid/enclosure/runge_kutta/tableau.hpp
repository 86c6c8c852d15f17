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

/// A Runge-Kutta method: \f$ k_i = f(t + c_i h, x + h \sum_j a_{ij} k_j) \f$,
/// \f$ x^+ = x + h \sum_i b_i k_i \f$.
///   Row i of `a` has i entries in an explicit method, and as many as there are stages in an
///   implicit one.
/// @given the method has the stated order. `require_order` of `order_conditions.hpp` refuses
///        statements that interval arithmetic disproves; the tests check the shipped ones in 50
///        digits.
struct tableau {
    std::string name;
    std::size_t order = 1;
    std::vector<std::vector<surd>> a;
    std::vector<surd> b;
    std::vector<surd> c;

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

/// Runge's method of order 2.
[[nodiscard]] inline tableau explicit_midpoint() {
    return {"explicit midpoint", 2, {{}, {{1, 2}}}, {{0, 1}, {1, 1}}, {{0, 1}, {1, 2}}};
}

/// Heun's method of order 2.
[[nodiscard]] inline tableau heun() {
    return {"heun", 2, {{}, {{1, 1}}}, {{1, 2}, {1, 2}}, {{0, 1}, {1, 1}}};
}

/// Kutta's method of order 3.
[[nodiscard]] inline tableau kutta3() {
    return {"kutta3",
            3,
            {{}, {{1, 2}}, {{-1, 1}, {2, 1}}},
            {{1, 6}, {2, 3}, {1, 6}},
            {{0, 1}, {1, 2}, {1, 1}}};
}

/// The classical method of order 4.
[[nodiscard]] inline tableau rk4() {
    return {"rk4",
            4,
            {{}, {{1, 2}}, {{0, 1}, {1, 2}}, {{0, 1}, {0, 1}, {1, 1}}},
            {{1, 6}, {1, 3}, {1, 3}, {1, 6}},
            {{0, 1}, {1, 2}, {1, 2}, {1, 1}}};
}

/// The method of order 5 in the pair of Dormand and Prince, six stages.
/// @ref  Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), table II.5.2
[[nodiscard]] inline tableau dormand_prince5() {
    return {"dormand-prince5",
            5,
            {{},
             {{1, 5}},
             {{3, 40}, {9, 40}},
             {{44, 45}, {-56, 15}, {32, 9}},
             {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
             {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
            {{35, 384}, {0, 1}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}},
            {{0, 1}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1, 1}}};
}

/// Butcher's method of order 6, seven stages.
/// @ref  Butcher, J. Austral. Math. Soc. 4 (1964)
[[nodiscard]] inline tableau butcher6() {
    return {"butcher6",
            6,
            {{},
             {{1, 3}},
             {{0, 1}, {2, 3}},
             {{1, 12}, {1, 3}, {-1, 12}},
             {{-1, 16}, {9, 8}, {-3, 16}, {-3, 8}},
             {{0, 1}, {9, 8}, {-3, 8}, {-3, 4}, {1, 2}},
             {{9, 44}, {-9, 11}, {63, 44}, {18, 11}, {0, 1}, {-16, 11}}},
            {{11, 120}, {0, 1}, {27, 40}, {27, 40}, {-4, 15}, {-4, 15}, {11, 120}},
            {{0, 1}, {1, 3}, {2, 3}, {1, 3}, {1, 2}, {1, 2}, {1, 1}}};
}

} // namespace sivid

#endif
