// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TABLEAU_HPP
#define SIVID_ENCLOSURE_TABLEAU_HPP

#include <sivid/number/interval_traits.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// A rational number, so that a tableau is exact: 1/6 is no double.
struct ratio {
    int numerator = 0;
    int denominator = 1;

    template <class I>
    [[nodiscard]] I enclose() const {
        using traits = interval_traits<I>;
        typename traits::mask undefined{};
        return traits::div(traits::point(numerator), traits::point(denominator), undefined);
    }
};

/// An explicit Runge-Kutta method: \f$ k_i = f(t + c_i h, x + h \sum_{j<i} a_{ij} k_j) \f$,
/// \f$ x^+ = x + h \sum_i b_i k_i \f$.
/// @given the method has the stated order (trusted: it follows from the order conditions, which the
///        tests check for the shipped tableaux; a user's own is his claim).
struct tableau {
    std::string name;
    std::size_t order = 1;
    std::vector<std::vector<ratio>> a; ///< row i has i entries
    std::vector<ratio> b;
    std::vector<ratio> c;

    [[nodiscard]] std::size_t stages() const { return b.size(); }

    /// @throws std::invalid_argument when the shape is not that of an explicit method
    void require_explicit() const {
        bool good = !b.empty() && a.size() == b.size() && c.size() == b.size() && order >= 1;
        for (std::size_t i = 0; good && i < a.size(); ++i) good = a[i].size() == i;
        if (!good) {
            throw std::invalid_argument("tableau '" + name +
                                        "': an explicit method needs s rows of "
                                        "0, 1, ..., s-1 coefficients, s weights and s nodes");
        }
    }
};

/// Heun's method of order 2.
[[nodiscard]] inline tableau heun() {
    return {"heun", 2, {{}, {{1, 1}}}, {{1, 2}, {1, 2}}, {{0, 1}, {1, 1}}};
}

/// The classical method of order 4.
[[nodiscard]] inline tableau rk4() {
    return {"rk4",
            4,
            {{}, {{1, 2}}, {{0, 1}, {1, 2}}, {{0, 1}, {0, 1}, {1, 1}}},
            {{1, 6}, {1, 3}, {1, 3}, {1, 6}},
            {{0, 1}, {1, 2}, {1, 2}, {1, 1}}};
}

} // namespace sivid

#endif
