// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_LIFTED_BLOCK_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_LIFTED_BLOCK_HPP

#include <sivid/paving/response/combined_polynomial.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/linear_program/constraint_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// Two unknowns, the lesser first.
using product = std::pair<std::size_t, std::size_t>;

/// The outputs of a response as polynomials in unknowns \f$ d \in [-1,1]^n \f$, and half the width
/// of each measurement. Doubles, for programs that propose weights.
struct scaled_polynomials {
    response const* of;
    std::vector<combined_polynomial::place> const* places;
    std::vector<double> coefficients; ///< as the response's
    std::vector<double> scale;        ///< 1 / e; 0 where bounds are infinite

    scaled_polynomials(response const& r, std::vector<combined_polynomial::place> const& where)
        : of(&r), places(&where), coefficients(r.coefficients) {
        auto const& table = *r.table;
        auto const count = r.outputs();
        auto& c = coefficients;
        for (std::size_t v = 0; v < table.variables; ++v) {
            shift(c, table, count, v, mid(where[v].middle));
        }
        for (std::size_t m = 0; m < table.size(); ++m) {
            double factor = 1;
            for (std::size_t v = 0; v < table.variables; ++v) {
                for (std::size_t k = 0; k < table.exponents[m][v]; ++k) {
                    factor *= mid(where[v].reach);
                }
            }
            for (std::size_t y = 0; y < count; ++y) c[m * count + y] *= factor;
        }
        for (auto const& b : r.bounds) {
            double const e = 0.5 * width(b);
            scale.push_back(std::isfinite(e) ? 1 / std::max(e, 1e-100) : 0);
        }
    }

    /// Notes how far products of two unknowns move a measurement, in its bounds.
    void find_moves(std::map<product, double>& moves) const {
        for (std::size_t m = 0; m < of->table->size(); ++m) {
            auto const [degree, u, v] = factors(m);
            if (degree != 2) continue;
            auto& most = moves[{u, v}];
            for (std::size_t y = 0; y < scale.size(); ++y) {
                most = std::max(most, std::abs(at(m, y)) * scale[y]);
            }
        }
    }

    /// The misfits (y - m) / e over the unknowns and the products that have a column.
    [[nodiscard]] minimax_block block(std::map<product, std::size_t> const& columns) const {
        auto const count = of->outputs();
        minimax_block b;
        std::map<std::size_t, std::size_t> place; // in the block, by column
        auto const row = [&](std::size_t column) {
            auto const [known, fresh] = place.try_emplace(column, b.variable.size());
            if (fresh) {
                b.variable.push_back(column);
                b.slope.resize(b.slope.size() + count, 0.0);
            }
            return b.slope.data() + known->second * count;
        };
        b.offset.assign(count, 0.0);
        b.margin.assign(count, 0.0);
        for (std::size_t m = 0; m < of->table->size(); ++m) {
            auto const [column, factor, constant, rest] = term(m, columns);
            double* const slope = factor != 0 ? row(column) : nullptr;
            for (std::size_t y = 0; y < count; ++y) {
                if (slope != nullptr) slope[y] += factor * at(m, y);
                b.offset[y] += constant * at(m, y);
                b.margin[y] += rest * std::abs(at(m, y));
            }
        }
        for (std::size_t y = 0; y < count; ++y) {
            double const margin = 1 + (b.margin[y] + of->radius[y]) * scale[y];
            bool const of_use = scale[y] > 0 && std::isfinite(margin);
            b.margin[y] = of_use ? margin : std::numeric_limits<double>::infinity();
            b.offset[y] = of_use ? (b.offset[y] - mid(of->bounds[y])) * scale[y] : 0;
            for (std::size_t v = 0; v < b.variable.size(); ++v) {
                b.slope[v * count + y] *= of_use ? scale[y] : 0;
            }
        }
        return b;
    }

    /// The slopes of an output over all columns.
    [[nodiscard]] std::vector<double>
    row(std::size_t y, std::map<product, std::size_t> const& columns, std::size_t count) const {
        std::vector<double> result(count, 0.0);
        for (std::size_t m = 0; m < of->table->size(); ++m) {
            auto const t = term(m, columns);
            if (t.factor != 0) result[t.column] += t.factor * at(m, y);
        }
        return result;
    }

private:
    [[nodiscard]] double at(std::size_t m, std::size_t y) const {
        return coefficients[m * of->outputs() + y];
    }
    struct powers {
        std::size_t degree, u, v; ///< unknowns of the first two factors, in their order
    };
    [[nodiscard]] powers factors(std::size_t m) const {
        powers p{0, 0, 0};
        auto const& e = of->table->exponents[m];
        for (std::size_t v = 0; v < of->table->variables; ++v) {
            for (std::size_t k = 0; k < e[v]; ++k) {
                (p.degree == 0 ? p.u : p.v) = (*places)[v].unknown;
                ++p.degree;
            }
        }
        if (p.degree >= 2 && p.v < p.u) std::swap(p.u, p.v);
        return p;
    }
    /// A monomial is factor * column + constant +- rest.
    struct share {
        std::size_t column;
        double factor, constant, rest;
    };
    [[nodiscard]] share term(std::size_t m, std::map<product, std::size_t> const& columns) const {
        auto const [degree, u, v] = factors(m);
        if (degree == 0) return {0, 0, 1, 0};
        if (degree == 1) return {u, 1, 0, 0};
        if (degree > 2) return {0, 0, 0, 1};
        bool const square = u == v; // (1 + s) / 2, where s in [-1, 1]
        auto const found = columns.find({u, v});
        if (found == columns.end()) return {0, 0, square ? 0.5 : 0.0, square ? 0.5 : 1.0};
        return {found->second, square ? 0.5 : 1.0, square ? 0.5 : 0.0, 0};
    }
};

} // namespace sivid::paving_detail

#endif
