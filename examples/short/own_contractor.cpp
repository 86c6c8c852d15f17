// SPDX-License-Identifier: MIT
// A contractor of one's own, by a balance of momentum: drag only brakes, so v <= a t from rest.
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/strategy/contains_truth.hpp>
#include <sivid/paving/strategy/prior_contractor.hpp>

#include <cmath>
#include <iostream>
using namespace sivid;
struct cart { // whose drag is missing
    static constexpr auto name = "cart";
    static constexpr auto states = sivid::states({{"v", "m/s", 10, "force balance"}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"v", "m/s"}});
    static constexpr auto constants = sivid::constants({{"a", "m/s^2", 2_dec}});
    auto rate(auto const&, auto const&, auto const& a, auto const&) const { return a; }
    auto observe(auto const&, auto const& v, auto const&, auto const&) const { return v; }
};
auto const by_momentum = [](auto const& p, auto const&) {
    auto left = p.prior; // of a, and of what effects add
    for (auto const& m : p.experiments[0].measurements)
        left[0] = {std::max(left[0].lower(), (m.bound / m.time).lower()), left[0].upper()};
    return left;
};
int main() {
    identification_problem posed{
        record_model<cart>(), {{"a"}, {}}, {{1, 3}}, {{"run", {}, 0, {0}, {}}}};
    for (double t = 0.1; t < 3; t += 0.1) { // v' = 2 - v^2/2, within +-0.02
        double const v = 2 * std::tanh(t);
        posed.experiments[0].measurements.push_back({t, 0, {v - 0.02, v + 0.02}});
    }
    auto const drag = effects::quadratic_damping("drag", "v", "1/m", {0_dec, 1_dec});
    auto const momentum = std::make_shared<prior_contractor>("momentum", by_momentum);
    if (!contains_truth(*momentum, posed, {2})) return 1;
    auto const tell = [](auto const& r) { std::cout << r.by << ": " << r.left << " left\n"; };
    tell(identify(posed, {.strategy = {{{{momentum}}}}}).journal[0]);
    tell(diagnose(posed, {drag}, {.strategy = {{{{momentum}}}}}).result.journal[0]);
}
