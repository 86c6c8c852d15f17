// SPDX-License-Identifier: MIT
// Random numbers that are the same with every standard library: the engine is fixed by the
// standard, the distributions are not, so they are written out here.
#ifndef WITHHELD_RANDOM_HPP
#define WITHHELD_RANDOM_HPP

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace withheld {

/// A seed for one purpose, made from another (splitmix64), so that a campaign does not depend on
/// how many campaigns are drawn before it.
inline std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t purpose) {
    std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL * (purpose + 1);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
}

class random_source {
public:
    explicit random_source(std::uint64_t seed) : engine_{seed} {}

    double uniform(double lo, double hi) {
        double const unit = static_cast<double>(engine_() >> 11U) * 0x1p-53;
        return lo + (hi - lo) * unit;
    }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
    bool coin(double probability = 0.5) { return uniform(0, 1) < probability; }
    double sign() { return coin() ? 1.0 : -1.0; }
    double normal() {
        double const radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
        return radius * std::cos(2 * std::numbers::pi * uniform(0, 1));
    }
    template <class T>
    void shuffle(std::vector<T>& all) {
        for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[below(i)]);
    }

private:
    std::mt19937_64 engine_;
};

} // namespace withheld

#endif
