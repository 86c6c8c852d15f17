// SPDX-License-Identifier: MIT
// The units of time, of states and of inputs are the user's: predictions, requirements and the
// effects of parameters are the same, and take as many runs.
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/rank.hpp>
#include <sivid/decision/verification.hpp>

#include "support/catch.hpp"
#include "support/oscillator_in_units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sivid;
using support::in_units::scalings;
using support::in_units::units;
using support::in_units::units_of_time;

namespace {

box around_truth(units const& in, double spread) {
    std::vector<interval> sides;
    for (double const c : support::in_units::true_constants(in))
        sides.emplace_back(c * (1 - spread), c * (1 + spread));
    return box(sides);
}

prediction_problem motion_in(units const& in, double seconds) {
    auto const p = support::in_units::problem_in(in);
    auto const& e = p.experiments.front();
    return {p.model, p.choice, {around_truth(in, 0.1)}, e.inputs, e.initial, seconds * in.time};
}

/// The clock decides nothing.
prediction_options by_parts(std::size_t parts) {
    prediction_options options;
    options.seconds = 1e9;
    options.parts = parts;
    options.cells = 60;
    return options;
}

bool close(double a, double b, double share) {
    return std::abs(a - b) <= share * std::max(std::abs(a), std::abs(b));
}
/// Counts of a search, of which a few may hang on roundings.
bool alike(std::size_t a, std::size_t b) {
    return close(static_cast<double>(a), static_cast<double>(b), 0.1) ||
           std::max(a, b) - std::min(a, b) <= 2;
}

struct foreseen {
    std::size_t integrations;
    bool complete;
    std::array<double, 2> widest;
};
foreseen predicted(units const& in) {
    auto const p = predict(motion_in(in, 4), by_parts(300));
    foreseen result{p.integrations, p.complete, {}};
    std::array<double, 2> const unit{in.state, in.speed()};
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < p.states[i].low.size(); ++k)
            result.widest[i] =
                std::max(result.widest[i], (p.states[i].high[k] - p.states[i].low[k]) / unit[i]);
    }
    return result;
}

verification checked(units const& in, double most) {
    auto p = motion_in(in, 4);
    std::array<char, 64> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), most * in.state).ptr;
    auto const what =
        parse_requirement("always(abs(x) < " + std::string(text.data(), end) + ")", p.model, p.end);
    return verify(p, what, {}, by_parts(100));
}

ranking ranked(units const& in) {
    auto p = support::in_units::problem_in(in, {}, {4, 20});
    p.prior = around_truth(in, 0.1);
    rank_options options;
    options.seconds = 1e9;
    options.parts = 200;
    return rank(p, options);
}

void compare(std::vector<units> const& all) {
    auto const base = predicted({});
    auto const base_ranks = ranked({});
    std::array const limits{3.0, 1.2};
    std::vector<verification> base_checks;
    for (double const most : limits) base_checks.push_back(checked({}, most));
    CHECK(base.complete);
    CHECK(base_checks[0].answer == requirement_answer::proved);
    for (auto const& in : all) {
        CAPTURE(in.name, in.state, in.input);
        auto const found = predicted(in);
        CHECK(found.complete == base.complete);
        CHECK(alike(found.integrations, base.integrations));
        for (std::size_t i = 0; i < 2; ++i) CHECK(close(found.widest[i], base.widest[i], 0.01));
        for (std::size_t k = 0; k < limits.size(); ++k) {
            auto const says = checked(in, limits[k]);
            CHECK(says.answer == base_checks[k].answer);
            CHECK(alike(says.parts, base_checks[k].parts));
            CHECK(alike(says.integrations, base_checks[k].integrations));
            CHECK(close(says.found.low / in.state, base_checks[k].found.low, 0.01));
            CHECK(close(says.found.high / in.state, base_checks[k].found.high, 0.01));
        }
        auto const ranks = ranked(in);
        CHECK(ranks.complete == base_ranks.complete);
        CHECK(alike(ranks.parts, base_ranks.parts));
        CHECK(alike(ranks.integrations, base_ranks.integrations));
        for (std::size_t c = 0; c < base_ranks.channels.size(); ++c) {
            CHECK(ranks.channels[c].order() == base_ranks.channels[c].order());
            for (std::size_t j = 0; j < base_ranks.channels[c].effects.size(); ++j) {
                auto const& a = ranks.channels[c].effects[j];
                auto const& b = base_ranks.channels[c].effects[j];
                CHECK(close(a.low, b.low, 0.01));
                CHECK(close(a.high, b.high, 0.01));
            }
        }
    }
}

} // namespace

TEST_CASE("what is foreseen of a motion does not hang on its units") {
    compare({{0x1p-12, 1, 1, "2^12 s"},
             {1e3, 1, 1, "ms"},
             {1, 1e-6, 1, "s"},
             {1.0 / 3600, 1e6, 1e-3, "h"}});
}

TEST_CASE("what is foreseen of a motion is the same in all units", "[.long]") {
    std::vector<units> all(units_of_time.begin(), units_of_time.end());
    for (double const size : scalings) {
        all.push_back({1, size, 1, "s"});
        all.push_back({1, 1, size, "s"});
        all.push_back({1e6, size, size, "us"});
        all.push_back({1.0 / 86400, size, 1 / size, "d"});
    }
    compare(all);
}
