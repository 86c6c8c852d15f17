// SPDX-License-Identifier: MIT
// What `describe` prints is read back and computed with: the lines are the model.
#include <sivid/model/describe.hpp>

#include "../../examples/hovercraft/model.hpp"
#include "support/catch.hpp"
#include "support/described_graph.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

using namespace sivid;

namespace {

struct all_operations {
    static constexpr auto name = "all operations";
    static constexpr auto states = sivid::states({{"a", "m", 3}, {"b", "m/s", 4.5, "motion"}});
    static constexpr auto inputs = sivid::inputs({{"w", "N"}});
    static constexpr auto channels = sivid::channels({{"first", "m"}, {"second", "rad"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1/s", 0.1_dec}, {"c", "kg", 2_dec}});
    }();
    template <class T>
    vec<T, 2> rate(T const& t, vec<T, 2> const& x, vec<T, 2> const& p, vec<T, 1> const& u) const {
        using namespace sivid::literals;
        return {exp(-x[0]) + log(2.5_dec + sqr(x[1])) * tan(p[0] / 4) - abs(x[0] - x[1]),
                atan(x[0]) * tanh(x[1]) + min(x[0], p[1]) - max(x[1], u[0]) + sqrt(2 + cos(t)) +
                    sign(x[0]) * interval(0.25, 0.75)};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 2> const& x, vec<T, 2> const& p, vec<T, 1> const&) const {
        return {pown(x[0], 5) * p[1], sin(x[1]) / (-p[0])};
    }
};

std::string line_with(std::string const& text, std::string const& part) {
    auto const at = text.find(part);
    REQUIRE(at != std::string::npos);
    auto const begin = text.rfind('\n', at) + 1;
    return text.substr(begin, text.find('\n', at) - begin);
}

} // namespace

TEST_CASE("names, units, ranges and nominal values are all there") {
    auto const text = describe(hovercraft{});
    CHECK(text.rfind("model hovercraft\n", 0) == 0);
    CHECK(line_with(text, "|r| <= 6").find("[rad/s]") != std::string::npos);
    CHECK(line_with(text, "|u| <= 8").find("'surge'") != std::string::npos);
    CHECK(line_with(text, "1.297").find("[kg]") != std::string::npos);
    CHECK(line_with(text, "0.0254").find("= 0.025447") != std::string::npos);
    CHECK(line_with(text, "0.0254").find("= 3.141592653589793 * D^2 / 4, rounded") !=
          std::string::npos);
    // Bound with D unknown, A is a function of it.
    sampled_signal const any({0, 1}, {0, 0}, interpolation::linear);
    auto const bound = describe(bind(record_model(hovercraft{}), {{"D"}, {}}, {any, any}));
    CHECK(line_with(bound, "3.14159").find("parameters only") != std::string::npos);
    CHECK(bound.find("0.025447") == std::string::npos);
    CHECK(line_with(text, "  delta  ").find("[rad]") != std::string::npos);
    CHECK(describe(all_operations{}).find("  k  = 0.1  [1/s]\n") != std::string::npos);
}

TEST_CASE("the lines compute what the model does") {
    support::draws d(31);
    all_operations const model;
    auto const text = describe(model);
    for (int round = 0; round < 50; ++round) {
        vec<double, 2> const x{d.uniform(-2, 2), d.uniform(-2, 2)},
            p{d.uniform(1, 2), d.uniform(1, 2)};
        vec<double, 1> const u{d.uniform(-2, 2)};
        double const t = d.uniform(0, 3);
        support::described_graph lines;
        lines.values = {{"a", x[0]}, {"b", x[1]}, {"k", p[0]}, {"c", p[1]}, {"w", u[0]}, {"t", t}};
        lines.compute(text);
        using std::abs, std::max, std::min;
        double const rate0 =
            std::exp(-x[0]) + std::log(2.5 + x[1] * x[1]) * std::tan(p[0] / 4) - abs(x[0] - x[1]);
        double const rate1 = std::atan(x[0]) * std::tanh(x[1]) + min(x[0], p[1]) - max(x[1], u[0]) +
                             std::sqrt(2 + std::cos(t)) + (x[0] > 0 ? 0.5 : -0.5);
        CHECK_THAT(lines.values.at("a'"), WithinRel(rate0, 1e-12));
        CHECK_THAT(lines.values.at("b'"), WithinRel(rate1, 1e-12));
        CHECK_THAT(lines.values.at("y.first"), WithinRel(std::pow(x[0], 5) * p[1], 1e-12));
        CHECK_THAT(lines.values.at("y.second"), WithinRel(-std::sin(x[1]) / p[0], 1e-12));
    }
}

TEST_CASE("the parts of a graph are marked, and what is shared") {
    auto const m = support::model_of(
        {2, 2, 1}, [](auto const& t, auto const& x, auto const& p, auto const& u) {
            auto const product = x[0] * x[1];
            return std::vector<expression>{product * exp(p[0]) + sqrt(u[0] + t),
                                           product - p[1] * log(u[0]) + cos(x[0])};
        });
    auto const text = describe(m);
    CHECK(line_with(text, "exp(p0)").find("parameters only") != std::string::npos);
    CHECK(line_with(text, "log(u0)").find("inputs only") != std::string::npos);
    CHECK(line_with(text, "u0 + t").find("inputs only") != std::string::npos);
    CHECK(line_with(text, "x0 * x1").find("used 2 times") != std::string::npos);
    CHECK(line_with(text, "sin(x0)").find("for series only") != std::string::npos);
    CHECK(line_with(text, "cos(x0)").find("for series only") == std::string::npos);
    CHECK(line_with(text, "graph:").find("1 parameters only") != std::string::npos);
}

TEST_CASE("a bound model shows its unknown parameters and folds the rest") {
    auto const m = record_model(all_operations{});
    auto const bound = bind(m, {{"c"}, {{"k", interval(1.5)}}},
                            {analytic_signal::from([](auto const& t) { return 3 * sin(t); })});
    auto const text = describe(bound);
    CHECK(text.rfind("model all operations, bound\n", 0) == 0);
    CHECK(text.find("unknown parameters\n  c  [kg]\n") != std::string::npos);
    CHECK(text.find(" tan(") == std::string::npos); // of a constant
    CHECK(text.find("rates by states         4 of 4 entries") != std::string::npos);
    CHECK(text.find("rates by parameters     1 of 2 entries") != std::string::npos);
    support::described_graph lines;
    lines.values = {{"a", 0.5}, {"b", -0.75}, {"c", 1.25}, {"t", 2}};
    lines.compute(text);
    CHECK_THAT(lines.values.at("a'"),
               WithinRel(std::exp(-0.5) + std::log(2.5 + 0.5625) * std::tan(0.375) - 1.25, 1e-12));
    CHECK_THAT(lines.values.at("b'"),
               WithinRel(std::atan(0.5) * std::tanh(-0.75) + 0.5 - 3 * std::sin(2.0) +
                             std::sqrt(2 + std::cos(2.0)) + 0.5,
                         1e-12));
    CHECK_THAT(lines.values.at("y.second"), WithinRel(-std::sin(-0.75) / 1.5, 1e-12));
}

TEST_CASE("states of effects, delays and plays are described") {
    auto m = record_model(all_operations{});
    m.input_memory.push_back({0, 0});
    m.channel_delays.push_back({1, 1});
    auto const text = describe(m);
    CHECK(text.find("input w         k\n") != std::string::npos);
    CHECK(text.find("channel second  c\n") != std::string::npos);
    CHECK(text.find("plays") == std::string::npos);
    m.input_memory[0].kind = memory_kind::play;
    auto const behind = describe(m);
    CHECK(behind.find("input w", behind.find("plays")) != std::string::npos);
    m.input_memory[0].kind = memory_kind::rate_limit;
    auto const slow = describe(m);
    CHECK(slow.find("plays") == std::string::npos);
    CHECK(slow.find("input w", slow.find("rate limits")) != std::string::npos);
    m.input_memory[0].kind = memory_kind::drift;
    CHECK(describe(m).find("input w         k (t - begin)") != std::string::npos);
}
