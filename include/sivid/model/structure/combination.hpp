// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_COMBINATION_HPP
#define SIVID_MODEL_STRUCTURE_COMBINATION_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

namespace sivid {

/// A product of powers of parameters, \f$ \prod_j p_j^{e_j} \f$, or a sum, \f$ \sum_j \pm p_j \f$.
struct combination {
    std::vector<int> exponents; ///< one per unknown parameter; of a sum all are 0
    std::string formula;        ///< for instance "L*Sg"
    std::string unit;
    std::vector<int> signs{}; ///< of a sum one per parameter: 1, -1, or 0: not in it

    [[nodiscard]] bool is_sum() const { return !signs.empty(); }
    /// Whether a parameter is a factor or a term.
    [[nodiscard]] bool has(std::size_t j) const {
        return exponents[j] != 0 || (is_sum() && signs[j] != 0);
    }
    /// Whether both are the same function of the parameters.
    [[nodiscard]] bool same_as(combination const& other) const {
        return exponents == other.exponents && signs == other.signs;
    }
    /// Its terms but one, as they stand in a sum.
    [[nodiscard]] interval others_than(std::size_t j, box const& p) const {
        using traits = interval_traits<interval>;
        auto sum = traits::point(0.0);
        for (std::size_t l = 0; l < signs.size(); ++l) {
            if (l == j || signs[l] == 0) continue;
            sum = signs[l] > 0 ? traits::add(sum, p[l]) : traits::sub(sum, p[l]);
        }
        return sum;
    }

    /// Encloses its range over a box of parameters.
    [[nodiscard]] interval over(box const& p) const {
        using traits = interval_traits<interval>;
        if (is_sum()) return others_than(signs.size(), p);
        bool undefined = false;
        auto above = traits::point(1.0);
        auto below = traits::point(1.0);
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            if (exponents[j] == 0) continue;
            auto const power = traits::pown(p[j], std::abs(exponents[j]), undefined);
            auto& side = exponents[j] > 0 ? above : below;
            side = traits::mul(side, power);
        }
        auto const value = traits::div(above, below, undefined);
        return undefined ? traits::entire() : value;
    }
};

/// In how many of these a parameter is a factor or a term.
[[nodiscard]] inline std::size_t users_of(std::vector<combination> const& all, std::size_t j) {
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [j](combination const& c) { return c.has(j); }));
}

/// A combination of parameters with what the data allow it.
struct combination_hull {
    combination what;
    interval hull;
};

/// The range of a combination over a box of parameters, of which products are known besides.
[[nodiscard]] inline interval range_of(combination const& c, box const& p,
                                       std::vector<combination_hull> const& known) {
    auto range = c.over(p);
    for (auto const& k : known) {
        if (k.what.same_as(c)) {
            range = interval_traits<interval>::intersect(range, k.hull);
        }
    }
    return range;
}

/// Through which products of parameters a model's outputs depend on them.
struct dependence_structure {
    /// All products that the equations contain.
    std::vector<combination> products;
    /// Parameters that no output determines alone, because they enter only through `combinations`:
    /// changing them with all combinations fixed changes no trajectory and no output. Proved from
    /// the structure of the equations, whatever the data.
    std::vector<std::size_t> entangled;
    /// Independent products of the entangled parameters alone, which replace them.
    std::vector<combination> combinations;
};

} // namespace sivid

#endif
