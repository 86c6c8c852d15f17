// SPDX-License-Identifier: MIT
// Records of systems in which sums of states are conserved, or whose states keep to one side, with
// priors over which no trajectory can be followed.
#ifndef SIVID_TESTS_PAVING_RELATION_PLANTED_BALANCES_HPP
#define SIVID_TESTS_PAVING_RELATION_PLANTED_BALANCES_HPP

#include "diagnosis/planted_records.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace relation_support {

using namespace diagnosis_support;
using terms = std::vector<expression>;

/// Equations with constants, the wide prior that is given and the part of it that truths are in.
struct balanced {
    diagnosis_support::planted system; ///< its prior is the wide one
    box truths;
    std::size_t sums; ///< that are found
};

/// Substrate, enzyme, complex, product.
inline terms michaelis(expression const&, terms const& x, terms const& p, terms const&) {
    auto const bound = p[0] * x[0] * x[1];
    return {p[1] * x[2] - bound, (p[1] + p[2]) * x[2] - bound, bound - (p[1] + p[2]) * x[2],
            p[2] * x[2]};
}
/// Biomass, substrate, product: a rate law that they share.
inline terms growth(expression const&, terms const& x, terms const& p, terms const&) {
    auto const g = p[0] * x[0] * x[1] / (p[1] + x[1]);
    return {g, -g / p[2], p[3] * g};
}
inline terms epidemic(expression const&, terms const& x, terms const& p, terms const&) {
    auto const infections = p[0] * x[0] * x[1];
    return {-infections, infections - p[1] * x[1]};
}
/// Two tanks in a row and a vessel that collects what leaves them.
inline terms tanks(expression const&, terms const& x, terms const& p, terms const& u) {
    auto const between = p[0] * sqrt(max(x[0], 0));
    auto const out = p[1] * sqrt(max(x[1], 0));
    return {(sqr(u[0]) - between) / p[2], between - out, out};
}
inline terms compartments(expression const&, terms const& x, terms const& p, terms const& u) {
    return {p[1] * x[1] - p[0] * x[0] + u[0], p[0] * x[0] - (p[1] + p[2]) * x[1], p[2] * x[1]};
}
inline terms prey_and_hunter(expression const&, terms const& x, terms const& p, terms const&) {
    return {p[0] * x[0] - p[1] * x[0] * x[1], p[2] * x[0] * x[1] - p[3] * x[1]};
}
inline terms swing(expression const&, terms const& x, terms const& p, terms const& u) {
    return {x[1], p[2] * u[0] - p[0] * sin(x[0]) - p[1] * x[1]};
}

inline std::vector<balanced> all_balanced() {
    auto const up_to = [](double most) { return between(0, most); };
    auto const one = between(0.2, 2);
    return {{{"enzyme",
              {4, 3, 1},
              michaelis,
              {up_to(1e5), up_to(1e4), up_to(1e4)},
              {0, 3},
              {between(1, 2), between(0.2, 0.5), interval(0.0), interval(0.0)}},
             {one, one, one},
             5},
            {{"growth",
              {3, 4, 1},
              growth,
              {up_to(50), between(0.2, 50), between(0.05, 2), up_to(5)},
              {0, 1, 2},
              {between(0.1, 0.3), between(1, 3), between(0, 0.1)}},
             {one, between(0.5, 2), between(0.2, 0.9), one},
             3},
            {{"epidemic",
              {2, 2, 1, 1},
              epidemic,
              {up_to(1e7), up_to(10)},
              {1},
              {between(0.9, 1), between(1e-3, 1e-2)}},
             {between(0.5, 3), between(0.1, 1)},
             1},
            {{"tanks",
              {3, 3, 1},
              tanks,
              {up_to(1e3), up_to(1e3), between(0.1, 10)},
              {0, 2},
              {between(0.5, 2), between(0.5, 1), between(0, 0.5)}},
             {between(0.1, 0.4), between(0.1, 0.4), between(0.5, 2)},
             1},
            {{"compartments",
              {3, 3, 1},
              compartments,
              {up_to(1e6), up_to(1e6), up_to(1e6)},
              {1, 2},
              {between(1, 2), between(0, 1), between(0, 0.1)}},
             {one, one, one},
             1},
            {{"prey and hunter",
              {2, 4, 1},
              prey_and_hunter,
              {up_to(1e4), up_to(1e4), up_to(1e4), up_to(1e4)},
              {1},
              {between(0.5, 2), between(0.5, 2)}},
             {one, one, one, one},
             1},
            {{"pendulum",
              {2, 3, 1, 20},
              swing,
              {up_to(1e3), up_to(1e3), between(-1e3, 1e3)},
              {0},
              {between(-1, 1), between(-1, 1)}},
             {one, one, one},
             0}};
}

/// A record, its truth, and where the record does not say so a reading far off that is allowed.
inline drawn_record record_of(draws& d, balanced const& what, recorded_model const& m) {
    auto planted = what.system;
    planted.prior = what.truths;
    auto result = diagnosis_support::record_of(d, planted, m);
    result.problem.prior = what.system.prior;
    if (d.below(4) > 0) return result;
    auto& e = result.problem.experiments.back();
    e.outliers = 1;
    auto& bound = e.measurements[d.below(e.measurements.size())].bound;
    bound = bound + interval(d.uniform(1, 9));
    return result;
}

/// A part of a box that contains a point, each side anything between all of it and the point.
inline box part_about(draws& d, box const& whole, std::vector<double> const& point) {
    auto part = whole;
    for (std::size_t j = 0; j < part.size(); ++j) {
        double const a = std::pow(d.uniform(0, 1), 4), b = std::pow(d.uniform(0, 1), 4);
        double const lo = point[j] - a * (point[j] - whole[j].lower());
        double const hi = point[j] + b * (whole[j].upper() - point[j]);
        part[j] = between(std::fmin(lo, point[j]), std::fmax(hi, point[j]));
    }
    return part;
}

} // namespace relation_support

#endif
