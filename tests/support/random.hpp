// SPDX-License-Identifier: MIT
// Seeded draws that are the same on every machine (std::uniform_real_distribution is not).
#ifndef SIVID_TESTS_SUPPORT_RANDOM_HPP
#define SIVID_TESTS_SUPPORT_RANDOM_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace support {

class draws {
public:
    explicit draws(std::uint64_t seed) : random_{seed} {}

    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
    bool coin() { return below(2) == 1; }
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(random_() >> 11) * 0x1p-53);
    }
    /// A point of the interval; its ends with a chance of one in four each.
    double in(sivid::interval const& x) {
        switch (below(4)) {
        case 0:
            return x.lower();
        case 1:
            return x.upper();
        default:
            return std::fmin(std::fmax(uniform(x.lower(), x.upper()), x.lower()), x.upper());
        }
    }
    std::vector<double> in(sivid::box const& x) {
        std::vector<double> point(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) point[i] = in(x[i]);
        return point;
    }
    /// An interval around a centre in [lo, hi], of half-width up to `radius`, often a point.
    sivid::interval interval(double lo, double hi, double radius) {
        double const c = uniform(lo, hi);
        double const r = below(4) == 0 ? 0 : uniform(0, radius);
        return sivid::interval_traits<sivid::interval>::bounds(c - r, c + r);
    }
    Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index cols, double size = 1) {
        Eigen::MatrixXd m(rows, cols);
        for (Eigen::Index j = 0; j < cols; ++j) {
            for (Eigen::Index i = 0; i < rows; ++i) m(i, j) = uniform(-size, size);
        }
        return m;
    }

private:
    std::mt19937_64 random_;
};

/// A part of a box at a random place in it, each side `share` as wide.
inline sivid::box part_of(draws& d, sivid::box const& whole, double share) {
    sivid::box part(whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        double const w = share * width(whole[i]);
        double const lo = d.uniform(whole[i].lower(), whole[i].upper() - w);
        part[i] = intersect(
            whole[i], sivid::interval_traits<sivid::interval>::bounds(lo, std::fmax(lo, lo + w)));
    }
    return part;
}

} // namespace support

#endif
