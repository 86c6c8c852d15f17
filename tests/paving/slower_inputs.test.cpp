// SPDX-License-Identifier: MIT
// Identification of records whose inputs are sampled far more often than the motion needs: what is
// found with slower inputs first never loses the truth.
#include <sivid/model/change/detail/slower_inputs.hpp>

#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

/// A driven pendulum; its angle is measured.
struct pendulum {
    static constexpr auto name = "pendulum";
    static constexpr auto states = sivid::states({{"q", "rad", 30}, {"w", "rad/s", 60}});
    static constexpr auto inputs = sivid::inputs({{"T", "N m"}});
    static constexpr auto channels = sivid::channels({{"q", "rad"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants(
            {{"J", "kg m^2", 0.5_dec}, {"d", "N m s", 0.2_dec}, {"g", "N m", 4_dec}});
    }();
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 3> const& c, vec<T, 1> const& u) const {
        using std::sin;
        return {x[1], (u[0] - c[1] * x[1] - c[2] * sin(x[0])) / c[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 3> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

struct planted_record {
    identification_problem problem;
    std::vector<double> truth;
};

/// Eight seconds at 1 kHz, the angle at 50 Hz; some errors lie at their bounds, some readings are
/// outliers.
planted_record record_with(draws& d, bool known_start, std::size_t outliers) {
    pendulum const model;
    double const share = 0.35, bound = 0.004, h = 0.001;
    std::vector<double> truth;
    std::vector<interval> prior;
    for (double const nominal : {0.5, 0.2, 4.0}) {
        double const low = nominal * d.uniform(0.6, 1);
        prior.push_back(interval(low, low + nominal * share * 2));
        truth.push_back(d.uniform(prior.back().lower(), prior.back().upper()));
    }
    vec<double, 3> const c{truth[0], truth[1], truth[2]};
    double const a = d.uniform(1, 2), b = d.uniform(3, 5), rough = d.uniform(0, 0.2),
                 phase = d.uniform(0, 6), jump = d.uniform(1, 7);
    vec<double, 2> x{d.uniform(-0.3, 0.3), d.uniform(-0.5, 0.5)};
    box start{interval(x[0]), interval(x[1])};
    if (!known_start)
        start = box{between(x[0] - 0.02, x[0] + 0.01), between(x[1] - 0.1, x[1] + 0.1)};
    experiment e{"E", {}, 0, start, {}, outliers};
    std::vector<double> times, torque;
    for (int k = 0; k <= 8000; ++k) {
        double const t = k * h;
        times.push_back(t);
        torque.push_back(2 * std::sin(a * t + phase) + std::sin(b * t) + rough * d.uniform(-1, 1) +
                         (t > jump ? 0.5 : 0));
        if (k > 0 && k % 20 == 0) {
            double const error =
                d.below(4) == 0 ? (d.coin() ? 1 : -1) * 0.9999 * bound : d.uniform(-bound, bound);
            bool const wrong = outliers > 0 && k % 2000 == 20;
            double const seen = x[0] + error + (wrong ? 0.1 : 0);
            e.measurements.push_back({t, 0, between(seen - bound, seen + bound)});
        }
        auto const f = [&](vec<double, 2> const& y) {
            return model.rate<double>(t, y, c, {torque.back()});
        };
        auto const at = [&](vec<double, 2> const& k1, double by) {
            return vec<double, 2>{x[0] + by * k1[0], x[1] + by * k1[1]};
        };
        auto const k1 = f(x), k2 = f(at(k1, h / 2)), k3 = f(at(k2, h / 2)), k4 = f(at(k3, h));
        for (std::size_t i = 0; i < 2; ++i) {
            x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        }
    }
    e.inputs.emplace_back(sampled_signal(times, torque, interpolation::hold));
    identification_problem p{record_model(model), {{"J", "d", "g"}, {}}, box(prior), {e}};
    return {std::move(p), truth};
}

} // namespace

TEST_CASE("slower inputs keep the truth") {
    int used = 0;
    auto const seeds = support::swept(2, 5);
    for (int seed = 1; seed <= seeds; ++seed) {
        draws d(static_cast<std::uint64_t>(seed));
        auto const planted = record_with(d, seed % 3 == 0, seed % 4 == 0 ? 4 : 0);
        CAPTURE(seed);
        identify_options options;
        options.search.seconds = 5; // all of them are spent: what is looked at comes first
        // Equations tell as much by themselves.
        std::erase_if(options.strategy.steps,
                      [](auto const& s) { return s.by[0]->name() != "slower inputs"; });
        options.only_hulls = true;
        auto const found = identify(planted.problem, options);
        REQUIRE(found.verdict != verdict::inconsistent);
        REQUIRE(contains(found.hull, planted.truth));
        REQUIRE(found.journal.size() == 1);
        auto const& said = found.journal[0];
        if (!(said.figure("input period") > 0)) continue;
        ++used;
        CHECK(std::fabs(said.figure("input period") - 0.01) < 1e-5);
        CHECK(said.left < 1);
        CHECK(relative_volume(found.hull, planted.problem.prior).lower() <= said.left);
    }
    CHECK(2 * used >= seeds);
}

TEST_CASE("what nothing explains is refuted with slower inputs as well") {
    draws d(3);
    auto planted = record_with(d, true, 0);
    auto& m = planted.problem.experiments[0].measurements;
    for (std::size_t k = 40; k < m.size(); ++k) { // from here the angle runs away
        double const off = 0.002 * static_cast<double>(k - 40);
        m[k].bound = between(m[k].bound.lower() + off, m[k].bound.upper() + off);
    }
    identify_options options;
    options.search.seconds = 6;
    auto const found = identify(planted.problem, options);
    CHECK(found.verdict == verdict::inconsistent);
}
