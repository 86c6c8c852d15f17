// SPDX-License-Identifier: MIT
// An interval type of one's own, middle +- radius: model, integration, comparison, bisection.
#include <sivid/number/traits_by_bounds.hpp>
#include <sivid/paving/bisection_test.hpp>

#include <iostream>
using namespace sivid;
struct measured { // the empty set is NaN +- NaN
    double middle = 0, radius = 0;
};
template <>
struct sivid::interval_traits<measured> : traits_by_bounds<measured> {
    static measured bounds(double lo, double hi) { // contains [lo, hi]
        interval const x = interval_traits<interval>::bounds(lo, hi);
        return {sivid::mid(x), sivid::rad(x)};
    }
    static measured empty() { return bounds(1, 0); }
    static double lower(measured const& a, std::size_t = 0) { return set(a).lower(); }
    static double upper(measured const& a, std::size_t = 0) { return set(a).upper(); }
    static interval set(measured const& a) { return a.middle + interval(-a.radius, a.radius); }
};
struct tank { // level' = -k level
    static constexpr auto name = "tank";
    static constexpr auto states = sivid::states({{"level", "m", 5}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"level", "m"}});
    static constexpr auto constants = sivid::constants({{"k", "1/s", 1_dec}});
    auto rate(auto const&, auto const& x, auto const& k, auto const&) const {
        return std::array{-k[0] * x[0]};
    }
    auto observe(auto const&, auto const& x, auto const&, auto const&) const { return x; }
};
int main() {
    experiment const run{"run", {}, 0, {interval(2)}, {{1, 0, {1.2, 1.3}}}};
    auto const found = identify_by_bisection<measured>(
        {record_model<tank>(), {{"k"}, {}}, {interval(0.1, 1)}, {run}});
    auto const left = found.paving.outer_hull()[0];
    auto const k = interval_traits<measured>::bounds(left.lower(), left.upper());
    std::cout << "k = " << k.middle << " +- " << k.radius << " 1/s\n";
}
