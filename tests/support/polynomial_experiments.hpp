// SPDX-License-Identifier: MIT
// Experiments whose outputs are random polynomials, with measurements around a planted truth.
#ifndef SIVID_TESTS_SUPPORT_POLYNOMIAL_EXPERIMENTS_HPP
#define SIVID_TESTS_SUPPORT_POLYNOMIAL_EXPERIMENTS_HPP

#include "support/models.hpp"
#include "support/random.hpp"

#include <sivid/paving/response/response.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace support {

/// Two parameters that all experiments share and a start of their own for some.
struct polynomial_experiments {
    box prior{between(0.5, 2), between(-1, 3)};
    std::vector<std::shared_ptr<sivid::response const>> known;

    /// @param q  outliers of each experiment, planted and allowed
    polynomial_experiments(draws& d, std::size_t experiments, std::size_t outputs, double curvature,
                           double radius, std::size_t q) {
        auto const truth = d.in(prior);
        for (std::size_t s = 0; s < experiments; ++s) {
            box const start{d.coin() ? between(-1, 1) : interval(1.0)};
            sivid::response r{
                sivid::normalised_unknowns(start, prior), nullptr, {}, {}, {}, {}, outputs, q};
            auto const used = r.unknowns.variables;
            r.table = std::make_shared<sivid::monomial_table const>(
                sivid::monomial_table::of(sivid::monomial_space::of(3, 3), used));
            for (auto const& e : r.table->exponents) {
                std::size_t degree = 0;
                for (auto const k : e) degree += k;
                for (std::size_t y = 0; y < outputs; ++y) {
                    r.coefficients.push_back(d.uniform(-1, 1) * (degree > 1 ? curvature : 1));
                }
            }
            r.radius.assign(outputs, radius);
            r.bounds.assign(outputs, interval(0.0));
            auto const y = values(r, truth, d.uniform(-1, 1));
            for (std::size_t k = 0; k < outputs; ++k) {
                double const e = std::pow(10, d.uniform(-1.5, 0));
                double const wrong = k < q ? d.uniform(-5, 5) : d.uniform(-0.9, 0.9);
                r.bounds[k] = around(y[k] + wrong * e, e);
            }
            known.push_back(std::make_shared<sivid::response const>(std::move(r)));
        }
    }

    [[nodiscard]] static std::vector<double> values(sivid::response const& r,
                                                    std::vector<double> const& p, double start) {
        std::vector<double> q(r.unknowns.variables);
        for (std::size_t j = 0; j < p.size(); ++j) {
            auto const& side = r.unknowns.parameters[j];
            q[side.variable] = (p[j] - side.centre) / side.radius;
        }
        if (r.unknowns.initial[0].radius > 0) q[r.unknowns.initial[0].variable] = start;
        std::vector<double> result(r.outputs(), 0.0);
        for (std::size_t m = 0; m < r.table->size(); ++m) {
            double factor = 1;
            for (std::size_t v = 0; v < q.size(); ++v) {
                factor *= std::pow(q[v], r.table->exponents[m][v]);
            }
            for (std::size_t y = 0; y < result.size(); ++y) {
                result[y] += factor * r.coefficients[m * r.outputs() + y];
            }
        }
        return result;
    }
    /// Whether remainders exist for which at most q measurements of each experiment are violated.
    [[nodiscard]] bool feasible(std::vector<double> const& p,
                                std::vector<double> const& starts) const {
        for (std::size_t s = 0; s < known.size(); ++s) {
            auto const& r = *known[s];
            auto const y = values(r, p, starts[s]);
            std::size_t violated = 0;
            for (std::size_t k = 0; k < y.size(); ++k) {
                double const off = std::abs(y[k] - mid(r.bounds[k])) - r.radius[k];
                violated += off > rad(r.bounds[k]) * (1 - 1e-9) ? 1 : 0;
            }
            if (violated > r.allowed) return false;
        }
        return true;
    }
    [[nodiscard]] std::vector<double> draw_starts(draws& d) const {
        std::vector<double> starts;
        for (std::size_t s = 0; s < known.size(); ++s) starts.push_back(d.uniform(-1, 1));
        return starts;
    }
    /// Of about half of the measurements, of either sign.
    [[nodiscard]] std::vector<sivid::measurement_weight> draw_weights(draws& d) const {
        std::vector<sivid::measurement_weight> weights;
        for (std::size_t s = 0; s < known.size(); ++s) {
            for (std::size_t y = 0; y < known[s]->bounds.size(); ++y) {
                if (d.coin()) weights.push_back({s, y, d.uniform(-2, 2)});
            }
        }
        return weights;
    }
    /// A part of the prior.
    [[nodiscard]] box part(draws& d) const {
        auto result = prior;
        for (std::size_t j = 0; j < result.size(); ++j) {
            double const share = std::pow(10, -d.uniform(0, 1.5));
            double const lo = prior[j].lower() + d.uniform(0, 1 - share) * width(prior[j]);
            result[j] = between(lo, std::min(lo + share * width(prior[j]), prior[j].upper()));
        }
        return result;
    }
};

} // namespace support

#endif
