// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/proposed_faults.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using names = std::vector<std::string>;

namespace {

names proposed(identification_problem const& problem, names const& places, names const& explain,
               names const& alone) {
    place_estimate estimate;
    for (auto const& name : places) {
        estimated_place p;
        p.kind = place_kind::sensor;
        p.name = name;
        estimate.places.push_back(std::move(p));
    }
    tried_places tried;
    for (auto const& name : explain) tried.names.push_back("sensor " + name);
    tried.inflation = 0.5;
    if (!explain.empty()) estimate.tried.push_back(tried);
    tried.names = {"sensor v", "surge"}; // not sensors alone
    estimate.tried.push_back(tried);
    std::vector<confined_gap> confined;
    for (auto const& name : alone) confined.push_back({.channel = name});
    names result;
    for (auto const& e : proposed_faults(problem, estimate, confined)) result.push_back(e.name);
    return result;
}
/// A sledge that moves freely in the plane.
struct sledge {
    static constexpr auto name = "sledge";
    static constexpr auto states = sivid::states({{"u", "m/s", 5},
                                                  {"v", "m/s", 5},
                                                  {"r", "rad/s", 5},
                                                  {"x", "m", 50},
                                                  {"y", "m", 50},
                                                  {"psi", "rad", 10}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels(
        {{"u", "m/s"}, {"v", "m/s"}, {"r", "rad/s"}, {"x", "m"}, {"y", "m"}, {"psi", "rad"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"c", "1/kg", 1_dec}});
    }();
    template <class T>
    states_of<sledge, T> rate(T const&, states_of<sledge, T> const& s,
                              constants_of<sledge, T> const& c,
                              inputs_of<sledge, T> const& f) const {
        using std::cos, std::sin;
        T const a = cos(s[5]), b = sin(s[5]);
        return {c[0] * f[0] + s[1] * s[2], -s[0] * s[2] - c[0] * s[1], -c[0] * s[2],
                s[0] * a - s[1] * b,       s[0] * b + s[1] * a,        s[2]};
    }
    template <class T>
    channels_of<sledge, T> observe(T const&, states_of<sledge, T> const& s,
                                   constants_of<sledge, T> const&,
                                   inputs_of<sledge, T> const&) const {
        return {s[0], s[1], s[2], s[3], s[4], s[5]};
    }
};

/// The sledge, whose channels were seen at two times.
identification_problem moved(std::vector<std::size_t> const& measured) {
    identification_problem p;
    p.model = record_model(sledge{});
    experiment e;
    e.name = "S";
    for (auto const y : measured) {
        e.measurements.push_back({1, y, interval(0.0, 0.1)});
        e.measurements.push_back({8, y, interval(2.9, 3.0)});
    }
    p.experiments.push_back(std::move(e));
    return p;
}

} // namespace

TEST_CASE("faults are proposed of instruments that may be wrong, as large as the data reach") {
    auto cart = small_campaign::problem();
    cart.experiments.resize(1);
    cart.experiments[0].measurements = {
        {0.5, 1, interval(-1.5, -1.4)}, {3.9, 1, interval(0.4, 0.5)}, {3.9, 0, interval(0.4, 0.5)}};
    auto const v = names{"sensor_latency(v)~0.5", "sensor_lag(v)~0.5", "sensor_scale(v)~2.2",
                         "sensor_bias(v)~2",      "sensor_drift(v)~1", "sensor_saturation(v)~2"};
    CHECK(proposed(cart, {"v"}, {}, {}) == v);
    CHECK(proposed(cart, {}, {"v"}, {}) == v);
    CHECK(proposed(cart, {}, {}, {"v"}) == v);
    CHECK(proposed(cart, {}, {}, {}).empty());
    CHECK(proposed(cart, {}, {}, {""}).empty()); // all channels of some experiments
}

TEST_CASE("what is measured in one unit may be one instrument, beside the point that moves") {
    auto const all = moved({0, 1, 2, 3, 4, 5});
    auto const has = [](names const& in, std::string const& name) {
        return std::find(in.begin(), in.end(), name) != in.end();
    };
    auto const u = proposed(all, {"u"}, {}, {});
    CHECK(has(u, "sensor_latency(u:v)~1"));
    CHECK(has(u, "sensor_rotation(u:v)~0.5"));
    CHECK(has(u, "sensor_swap(u:v)~1.2"));
    CHECK(has(u, "sensor_velocity_arm(u:v:r)~1"));
    CHECK(has(u, "sensor_drift(u:v)~0.5"));
    CHECK(has(u, "sensor_drift(u)~0.5"));
    CHECK_FALSE(has(u, "sensor_drift(v)~0.5"));
    CHECK_FALSE(has(u, "sensor_drift(r)~0.5"));
    auto const xy = proposed(all, {}, {"x"}, {});
    CHECK(has(xy, "sensor_lever_arm(x:y:psi)~2"));
    CHECK(has(xy, "sensor_latency(x:y)~1"));
    CHECK_FALSE(has(xy, "sensor_saturation(x:y)~5"));
    auto const alone = proposed(moved({0, 2}), {"u"}, {}, {});
    CHECK(has(alone, "sensor_lag(u)~1"));
    CHECK_FALSE(has(alone, "sensor_rotation(u:v)~0.5"));
}
