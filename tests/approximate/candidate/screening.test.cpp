// SPDX-License-Identifier: MIT
#include <sivid/approximate/candidate/screening.hpp>

#include <sivid/approximate/fit/detail/thinned.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

using namespace sivid;
using namespace sivid::literals;

namespace {

screening screened_campaign(small_campaign::truth const& real, screening_options options = {}) {
    screening s(small_campaign::problem(real), small_campaign::catalogue(), std::move(options));
    s.run();
    // What is ranked by its score has one, also where no descent beat the grid it started from.
    for (auto const& f : s.figures()) CHECK(std::isfinite(f.score(s.measurements())));
    return s;
}
std::vector<std::size_t> answer(screening const& s) {
    auto const figures = s.figures();
    auto const c = choose(figures, s.measurements());
    REQUIRE(c.explained);
    return figures[c.best].effects;
}

} // namespace

TEST_CASE("screening finds the effect that is missing, and its size") {
    auto const drag = screened_campaign(small_campaign::with_drag(0.3));
    CHECK(drag.candidates()[0].figures.inflation > 1.5);
    CHECK(answer(drag) == std::vector<std::size_t>{0});
    auto const* found = drag.find({0});
    REQUIRE(found != nullptr);
    CHECK(found->problem.choice.unknown[1] == "quadratic.k");
    CHECK(std::abs(found->fit.parameters[1] - 0.3) < 0.05);

    CHECK(answer(screened_campaign(small_campaign::with_slope(0.2))) ==
          std::vector<std::size_t>{1});
    CHECK(answer(screened_campaign(small_campaign::with_scale(0.15))) ==
          std::vector<std::size_t>{2});
    auto const late = screened_campaign(small_campaign::with_delay(0.2));
    CHECK(answer(late) == std::vector<std::size_t>{3});
    CHECK(std::abs(late.find({3})->fit.parameters[1] - 0.2) < 0.02);
}

TEST_CASE("without anything missing the model itself is the answer") {
    CHECK(answer(screened_campaign({})).empty());
}

TEST_CASE("two effects are found as a pair") {
    auto real = small_campaign::with_drag(0.3);
    real.seen_position = small_campaign::with_scale(0.15).seen_position;
    CHECK(answer(screened_campaign(real)) == std::vector<std::size_t>{0, 2});
}

TEST_CASE("an effect that shows in one of many measurements is not silent") {
    auto real = small_campaign::with_drag(0.3);
    real.every = 1; // ms: 24000 measurements
    auto problem = small_campaign::problem(real);
    auto const kept = thinned_indices(problem, many_measurements)[0];
    auto const all = sorted(problem.experiments[0].measurements);
    std::size_t odd = kept[kept.size() / 2] + 1;
    while (all[odd].channel != 0 || std::find(kept.begin(), kept.end(), odd) != kept.end()) ++odd;
    double const at = all[odd].time;
    auto glitch =
        effects::detail::one("glitch", "k", "m", {0.1_dec, 1_dec}, "a sample that is off");
    glitch.on_channels = [at](effect_scope& m) {
        m.channel("p") += m.parameter() * max(1 - 4000 * abs(m.time() - at), 0.0);
    };
    auto never = effects::detail::one("never", "k", "m", {0.1_dec, 1_dec}, "what nobody sees");
    never.on_channels = [at](effect_scope& m) {
        m.channel("p") += m.parameter() * max(1 - 4000 * abs(m.time() - at - 5e-4), 0.0);
    };
    screening_options options;
    options.most_effects = 1;
    screening s(std::move(problem), {glitch, never}, options);
    s.run();
    REQUIRE(s.find({0}) != nullptr);
    REQUIRE(s.find({1}) != nullptr);
    CHECK_FALSE(s.find({0})->silent);
    CHECK(s.find({1})->silent);
}

TEST_CASE("an effect that the channels cannot show is silent") {
    auto problem = small_campaign::problem(small_campaign::with_drag(0.3));
    for (auto& e : problem.experiments) {
        std::erase_if(e.measurements, [](measurement const& m) { return m.channel == 0; });
    }
    screening s(problem, small_campaign::catalogue());
    s.run();
    CHECK(s.find({2})->silent); // the scale of a sensor that was not recorded
    CHECK_FALSE(s.find({0})->silent);
    CHECK_FALSE(s.find({3})->silent);
}

TEST_CASE("a saturation is found though its prior is mostly never reached") {
    using namespace sivid::literals;
    for (double const limit : {0.9, 1.2, 1.6}) {
        INFO("limit " << limit);
        small_campaign::truth real;
        real.missing = [limit](double, double, double u) {
            return std::clamp(u, -limit, limit) - u;
        };
        screening s(small_campaign::problem(real),
                    {effects::input_saturation("limit", "u", "N", {0.5_dec, 10_dec})});
        s.run();
        auto const& found = s.find({0})->fit;
        CHECK(found.inflation < 1);
        CHECK(std::abs(found.parameters[1] - limit) < 0.01);
    }
}

TEST_CASE("screening can be stopped and keeps what it has") {
    int calls = 0;
    screening_options options;
    options.progress = [&calls](std::string const& what) {
        CHECK_FALSE(what.empty());
        return ++calls < 3;
    };
    auto s = screened_campaign(small_campaign::with_drag(0.3), options);
    CHECK_FALSE(s.counts().complete());
    CHECK(s.candidates().size() == 2);
    CHECK(s.counts().singles.tried == 1);
    CHECK(s.counts().pairs.planned == 6);
    // Called again it goes on, and comes to what an uninterrupted one does.
    calls = -1000;
    s.run();
    CHECK(s.counts().complete());
    auto const whole = screened_campaign(small_campaign::with_drag(0.3));
    REQUIRE(s.candidates().size() == whole.candidates().size());
    for (std::size_t k = 0; k < whole.candidates().size(); ++k) {
        CHECK(s.candidates()[k].figures.effects == whole.candidates()[k].figures.effects);
        CHECK(s.candidates()[k].figures.inflation == whole.candidates()[k].figures.inflation);
    }
    CHECK(screened_campaign({}, {.seconds = 0}).candidates().empty());
}

TEST_CASE("a third effect joins the likeliest pair when it is asked for") {
    auto real = small_campaign::with_drag(0.3);
    real.missing = [](double, double v, double) { return 0.2 - 0.3 * std::abs(v) * v; };
    real.seen_position = small_campaign::with_scale(0.15).seen_position;
    auto pairs = screened_campaign(real);
    CHECK_FALSE(choose(pairs.figures(), pairs.measurements()).explained);
    CHECK(pairs.find({0, 1, 2}) == nullptr);
    CHECK(pairs.counts().larger.tried == 0);
    CHECK(pairs.try_threes());
    CHECK(pairs.counts().larger.tried > 0);
    CHECK(pairs.counts().complete());
    CHECK(answer(pairs) == std::vector<std::size_t>{0, 1, 2});
    screening_options options;
    options.most_effects = 3;
    auto const all = screened_campaign(real, options);
    CHECK(answer(all) == std::vector<std::size_t>{0, 1, 2});
    CHECK(all.find({0, 1}) != nullptr); // the answer does not do without any of its effects
    CHECK(all.find({1, 2}) != nullptr);
}
