// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_RESPONSE_HPP
#define SIVID_PAVING_RESPONSE_RESPONSE_HPP

#include <sivid/enclosure/normalised_unknowns.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/polynomial/monomial_space.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// An output of a family of trajectories at one time as a polynomial in the family's normalised
/// unknowns, \f$ y \in \sum_\alpha c_\alpha q^\alpha \pm radius \f$, by the monomials of a table.
struct output_polynomial {
    std::vector<double> coefficients;
    double radius = 0;

    /// The size of all that is not constant.
    [[nodiscard]] double spread() const {
        double sum = 0;
        for (std::size_t m = 1; m < coefficients.size(); ++m) sum += std::abs(coefficients[m]);
        return sum;
    }
};

/// The monomials of a response, by degree as those of a `monomial_space`.
struct monomial_table {
    std::size_t variables = 0;
    std::size_t degree = 0;
    std::vector<std::vector<std::uint8_t>> exponents; ///< in graded order
    /// lines[v]: chains of monomials in which only the power of variable v grows, from 0 on.
    std::vector<std::vector<std::vector<std::size_t>>> lines;

    /// The monomials of a space that use only its first `used` variables.
    /// @param place  gets where each of them stands in the space, if given
    [[nodiscard]] static monomial_table of(monomial_space const& space, std::size_t used,
                                           std::vector<std::size_t>* place = nullptr) {
        monomial_table t;
        t.variables = used;
        t.degree = space.degree();
        for (std::size_t m = 0; m < space.terms(); ++m) {
            auto const* const e = space.exponents(m);
            auto const* const end = e + space.variables();
            auto const* const first_unused = e + std::min(used, space.variables());
            if (std::any_of(first_unused, end, [](std::uint8_t x) { return x != 0; })) continue;
            t.exponents.emplace_back(e, first_unused);
            if (place != nullptr) place->push_back(m);
        }
        t.find_lines();
        return t;
    }
    [[nodiscard]] std::size_t size() const { return exponents.size(); }

    /// Moves the origin of a variable, by Horner's scheme: calls add(m, k) wherever the coefficient
    /// of m has to grow by that of k, times the shift.
    template <class Add>
    void shift(std::size_t variable, Add const& add) const {
        for (auto const& line : lines[variable]) {
            for (std::size_t low = 0; low + 1 < line.size(); ++low) {
                for (std::size_t k = line.size() - 1; k-- > low;) add(line[k], line[k + 1]);
            }
        }
    }

    [[nodiscard]] std::vector<unsigned> powers(std::size_t m) const {
        return {exponents[m].begin(), exponents[m].end()};
    }
    /// Fills `lines`.
    void find_lines() {
        std::map<std::vector<unsigned>, std::size_t> place;
        for (std::size_t m = 0; m < size(); ++m) place[powers(m)] = m;
        lines.resize(variables);
        for (std::size_t v = 0; v < variables; ++v) {
            for (std::size_t m = 0; m < size(); ++m) {
                if (exponents[m][v] != 0) continue;
                auto& line = lines[v].emplace_back();
                auto e = powers(m);
                for (auto next = place.find(e); next != place.end(); next = place.find(e)) {
                    line.push_back(next->second);
                    ++e[v];
                }
            }
        }
    }
};

/// What one experiment answers for all parameters in a box: each measured output that was reached
/// as a polynomial in the normalised unknowns, \f$ y \in \sum_\alpha c_\alpha q^\alpha \pm radius
/// \f$. It stays valid, and gets sharper, on every part of the box.
struct response {
    normalised_unknowns unknowns;
    std::shared_ptr<monomial_table const> table;
    /// coefficients[m * outputs + y]: one row a monomial, so that all outputs are processed
    /// together.
    std::vector<double> coefficients;
    std::vector<double> radius;
    /// About how much of the radii is due to uncertain inputs and stays however small the box;
    /// empty: nothing. A preference, no proof rests on it.
    std::vector<double> lasting;
    std::vector<interval> bounds; ///< the measurements that were reached, in their order
    std::size_t measurements = 0; ///< all of the experiment
    std::size_t allowed = 0;      ///< outliers

    [[nodiscard]] std::size_t outputs() const { return bounds.size(); }
    /// What a smaller box may take from an output's radius.
    [[nodiscard]] double shrinking_radius(std::size_t y) const {
        return y < lasting.size() ? std::max(0.0, radius[y] - lasting[y]) : radius[y];
    }
    /// The largest radius of an output, but for what lasts, against the half-width of its
    /// measurement; infinite where outputs are missing.
    [[nodiscard]] double blur() const {
        if (outputs() < measurements) return std::numeric_limits<double>::infinity();
        double most = 0;
        for (std::size_t y = 0; y < outputs(); ++y) {
            most = std::max(most, 2 * shrinking_radius(y) / width(bounds[y]));
        }
        return most;
    }
    /// Memory that it takes; its table is shared.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(response) +
               sizeof(normalised_unknowns::side) *
                   (unknowns.initial.size() + unknowns.parameters.size()) +
               sizeof(double) * (coefficients.capacity() + radius.capacity() + lasting.capacity()) +
               sizeof(interval) * bounds.capacity();
    }
};

/// The responses of several experiments to boxes of the same parameters.
using response_list = std::vector<std::shared_ptr<response const>>;

/// Collects the outputs of a run, one by one, and lays them out for a response.
class response_builder {
public:
    explicit response_builder(std::size_t terms) : rows_(terms) {}

    template <class Coefficients>
    void add(Coefficients const& c, double radius, interval const& bound) {
        for (std::size_t m = 0; m < rows_.size(); ++m) rows_[m].push_back(c(m));
        radius_.push_back(radius);
        bounds_.push_back(bound);
    }
    void finish(response& r) && {
        r.coefficients.clear();
        for (auto const& row : rows_)
            r.coefficients.insert(r.coefficients.end(), row.begin(), row.end());
        r.radius = std::move(radius_);
        r.bounds = std::move(bounds_);
    }

private:
    std::vector<std::vector<double>> rows_;
    std::vector<double> radius_;
    std::vector<interval> bounds_;
};

} // namespace sivid

#endif
