// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/relation_contraction.hpp>

#include "diagnosis/planted_records.hpp"
#include "paving/relation/two_links.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/paving/identify.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>

#include <algorithm>

using namespace diagnosis_support;

TEST_CASE("no parameter that explains the data is removed") {
    draws d(710);
    auto const count = support::swept(std::size_t{5}, std::size_t{400});
    for (auto const& what : all_planted()) {
        auto const m = model_of(what.shape, what.rate);
        for (std::size_t n = 0; n < count; ++n) {
            auto const r = record_of(d, what, m);
            auto const once = contract_by_relations(r.problem);
            INFO(what.name << " " << n);
            REQUIRE_FALSE(is_empty(once));
            // By its parts, too, with fewer rounds and cells.
            relation_test const test(r.problem, {.rounds = 2, .cells_per_gap = 2});
            auto const paving = invert(test, once, {.boxes = d.coin() ? 1u : 8u}).paving;
            REQUIRE(paving.has_outer());
            auto const rest = paving.outer_hull();
            for (std::size_t j = 0; j < rest.size(); ++j) {
                CHECK(rest[j].lower() <= r.truth[j]);
                CHECK(r.truth[j] <= rest[j].upper());
            }
        }
    }
}

TEST_CASE("short records of wide priors tell much without any trajectory") {
    draws d(711);
    std::vector<double> shares;
    for (int n = 0; n < 6; ++n) {
        std::vector<double> const truth{1.2, 1.5, 0.3};
        auto const problem = two_records(d, truth);
        auto const rest = contract_by_relations(problem);
        REQUIRE(contains(rest, truth));
        for (std::size_t j = 0; j < 3; ++j)
            shares.push_back(width(rest[j]) / width(problem.prior[j]));
    }
    std::sort(shares.begin(), shares.end());
    CHECK(shares[shares.size() / 2] < 0.25);
}

TEST_CASE("a constant inside a root is told by halves of its prior") {
    draws d(712);
    std::vector<double> const truth{0.8, -0.6, 0.4};
    auto const problem = windy_record(d, truth);
    relation_test const test(problem, {});
    // What blurs the equations most is split first: here the wind, though it is no factor of them.
    auto const whole = test(problem.prior);
    CHECK(std::max(whole.smear[1], whole.smear[2]) > whole.smear[0]);
    auto const once = contract_by_relations(problem);
    auto const halved = invert(test, once, {.boxes = 64}).paving.outer_hull();
    CHECK(contains(once, truth));
    CHECK(contains(halved, truth));
    CHECK(subset(halved, once));
    CHECK(width(halved[1]) < 0.7 * width(problem.prior[1]));
    CHECK(width(halved[2]) < 0.7 * width(problem.prior[2]));
}

TEST_CASE("rates that no channel shows are told by what changes at them") {
    draws d(715);
    auto const m = support::model_of(
        {2, 2, 1}, [](expression const&, std::vector<expression> const& x,
                      std::vector<expression> const& p, std::vector<expression> const& u) {
            return std::vector<expression>{p[0] * u[0] - p[1] * x[0], x[0]};
        });
    std::vector<double> const truth{1.2, 1.5};
    identification_problem problem{
        m, {support::all_constants(2), {}}, box{between(0.8, 2), between(1, 2)}, {}};
    for (int k = 0; k < 2; ++k) {
        std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
        auto const motion = simulate(m, truth, inputs, {0.5, 0}, 3, 0.0025);
        problem.experiments.push_back(measured(d, support::numbered('S', std::size_t(k)), motion,
                                               inputs, {1}, 0.002, noise::uniform));
    }
    auto const rest = contract_by_relations(problem);
    CHECK(contains(rest, truth));
    CHECK(width(rest[0]) < 0.9 * width(problem.prior[0]));
}

TEST_CASE("positions alone tell friction from known starts, without any trajectory") {
    draws d(717);
    auto const what = all_planted()[7];
    REQUIRE(what.name == "friction seen by positions");
    auto const m = model_of(what.shape, what.rate);
    std::vector<double> const truth{1.5, 0.8, 0.4, 0.2, -0.1};
    identification_problem problem{m, {support::all_constants(5), {}}, what.prior, {}};
    for (std::size_t k = 0; k < 12; ++k) {
        std::vector<sampled_signal> const inputs{drawn_input(d, 1, interpolation::linear)};
        std::vector<double> const start{d.uniform(-1, 1), 0};
        auto const motion = simulate(m, truth, inputs, start, 1, what.step);
        problem.experiments.push_back(measured(d, support::numbered('S', k), motion, inputs,
                                               what.shown, 0.002, noise::uniform));
        problem.experiments.back().initial[0] = around(start[0], 0.002);
    }
    auto const rest = contract_by_relations(problem);
    REQUIRE(contains(rest, truth));
    for (std::size_t j = 0; j < 5; ++j) {
        INFO(j);
        CHECK(width(rest[j]) < 0.6 * width(problem.prior[j]));
    }
}

TEST_CASE("angles alone tell the masses of two links, without any trajectory") {
    using namespace relation_support;
    draws d(719);
    auto const m = record_model(two_links());
    std::vector<double> const truth{0.6, 0.12, 0.15, 0.3, 0.2};
    identification_problem problem{m, {{"a1", "a2", "a3", "f", "d"}, {}}, prior_of_links(0.15), {}};
    for (std::size_t k = 0; k < 4; ++k) {
        problem.experiments.push_back(
            record_of_links(d, m, truth, 4, 0.001, noise::uniform, support::numbered('S', k)));
    }
    auto const rest = contract_by_relations(problem);
    REQUIRE(contains(rest, truth));
    for (std::size_t j = 0; j < 3; ++j) {
        INFO(j);
        CHECK(width(rest[j]) < 0.2 * width(problem.prior[j]));
    }
}

TEST_CASE("two encoders on one shaft tell what one tells") {
    // The speed is the rate of both: it stands once in what is told by parts.
    auto const m = support::model_of(
        {3, 2, 1}, [](expression const&, std::vector<expression> const& x,
                      std::vector<expression> const& p, std::vector<expression> const& u) {
            return std::vector<expression>{p[0] * u[0] - p[1] * x[0], x[0], x[0]};
        });
    std::vector<double> const truth{1.2, 1.5};
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        std::vector<box> rests;
        for (std::vector<std::size_t> const& shown :
             {std::vector<std::size_t>{1}, std::vector<std::size_t>{1, 2}}) {
            draws d(seed);
            identification_problem problem{
                m, {support::all_constants(2), {}}, box{between(0.8, 2), between(1, 2)}, {}};
            for (std::size_t k = 0; k < 2; ++k) {
                std::vector<sampled_signal> const inputs{sine_input(1.5, 3, 3)};
                auto const motion = simulate(m, truth, inputs, {0.5, 0, 0.3}, 3, 0.0025);
                problem.experiments.push_back(measured(d, support::numbered('S', k), motion, inputs,
                                                       shown, 0.002, noise::uniform));
            }
            rests.push_back(contract_by_relations(problem));
            INFO("seed " << seed << ", " << shown.size());
            CHECK(contains(rests.back(), truth));
            CHECK(width(rests.back()[0]) < 0.1 * width(problem.prior[0]));
        }
    }
}

TEST_CASE("a speed, precise or not, beside two encoders of its shaft") {
    // Another equation sees the speed, whose channel is off by about half of its bound: by parts
    // the encoders speak for it, one of them or both.
    auto const m = support::model_of(
        {4, 2, 2}, [](expression const&, std::vector<expression> const& x,
                      std::vector<expression> const& p, std::vector<expression> const& u) {
            return std::vector<expression>{u[1] - x[0], x[0], x[0], p[0] * u[0] - p[1] * x[0]};
        });
    std::vector<double> const truth{1.2, 1.5};
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        for (std::vector<std::size_t> const& shown :
             {std::vector<std::size_t>{1, 3}, std::vector<std::size_t>{1, 2, 3}}) {
            draws d(seed);
            identification_problem problem{
                m, {support::all_constants(2), {}}, box{between(0.8, 2), between(1, 2)}, {}};
            for (std::size_t k = 0; k < 2; ++k) {
                std::vector<sampled_signal> const inputs{sine_input(1.5, 3, 4),
                                                         sine_input(1.5, 3, 4)};
                auto const motion = simulate(m, truth, inputs, {0.5, 0, 0.3, 0}, 4, 0.0025);
                auto e = measured(d, support::numbered('S', k), motion, inputs, shown, 0.002,
                                  noise::uniform);
                e.inputs[1] =
                    sampled_signal(inputs[1].times(), inputs[1].values(), interpolation::linear,
                                   std::vector<double>(inputs[1].values().size(), 6.0));
                for (int q = 1; q <= 40; ++q) {
                    double const speed = motion.at(q * 0.1)[0];
                    e.measurements.push_back({q * 0.1, 0, around(speed + 0.045, 0.1)});
                }
                e.initial[0] = around(0.5, 0.1);
                problem.experiments.push_back(std::move(e));
            }
            INFO("seed " << seed << ", " << shown.size());
            auto const rest = contract_by_relations(problem);
            CHECK(contains(rest, truth));
            // Nor is any equation refuted under what holds of its variations.
            for (auto& e : problem.experiments) {
                auto& u = std::get<sampled_signal>(e.inputs[1]);
                u = u.nominal();
            }
            for (auto const& f : examine_relations(problem)) {
                INFO(f.name << " " << f.margin);
                CHECK_FALSE(f.proved);
            }
        }
    }
}

TEST_CASE("a position that only some records show, or for a while, takes nothing away") {
    draws d(718);
    auto const what = all_planted().back();
    REQUIRE(what.name == "two masses seen by positions");
    auto const m = model_of(what.shape, what.rate);
    for (int n = 0; n < 4; ++n) {
        auto r = record_of(d, what, m);
        auto const& first = r.problem.experiments[0];
        auto some = first, begun = first;
        std::erase_if(some.measurements, [](auto const& x) { return x.channel == 1; });
        std::erase_if(begun.measurements,
                      [](auto const& x) { return x.channel == 1 && x.time > 1; });
        r.problem.experiments = {first, some, begun};
        CHECK(contains(contract_by_relations(r.problem), r.truth));
        r.problem.experiments = {some};
        CHECK(contains(contract_by_relations(r.problem), r.truth));
    }
}

TEST_CASE("data that no parameter explains leave nothing") {
    draws d(713);
    auto const what = all_planted()[0];
    auto const m = model_of(what.shape, what.rate);
    std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
    auto const motion = simulate(m, {6, 1.5, 0.3}, inputs, {0.5, 0}, 3, what.step);
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    problem.experiments.push_back(
        measured(d, "S", motion, inputs, what.shown, 0.01, noise::uniform));
    CHECK(is_empty(contract_by_relations(problem)));
    SECTION("unless samples may be outliers") {
        problem.experiments[0].outliers = 1;
        CHECK(equal(contract_by_relations(problem)[0], what.prior[0]));
    }
    SECTION("or there was no time") {
        auto const rest = contract_by_relations(problem, {.keep_going = [] { return false; }});
        CHECK(equal(rest[0], what.prior[0]));
    }
}

TEST_CASE("nothing is known of a state that nobody sees, from a start that nobody knows") {
    draws d(714);
    auto const what = all_planted()[4];
    auto const m = model_of(what.shape, what.rate);
    std::vector<sampled_signal> const inputs{drawn_input(d, 3, interpolation::linear)};
    auto const motion = simulate(m, {1, 1, 0.2}, inputs, {0.5, 0}, 3, what.step);
    identification_problem problem{m, {support::all_constants(3), {}}, what.prior, {}};
    problem.experiments.push_back(
        measured(d, "S", motion, inputs, what.shown, 0.01, noise::uniform));
    CHECK(width(contract_by_relations(problem)[0]) < 0.9 * width(what.prior[0]));
    problem.experiments[0].initial[1] = between(-1e6, 1e6);
    CHECK(contains(contract_by_relations(problem), std::vector<double>{1, 1, 0.2}));
}

TEST_CASE("identify begins with it where runs over the prior end early") {
    draws d(716);
    std::vector<double> const truth{1.2, 1.5, 0.3};
    auto problem = two_records(d, truth);
    for (auto& x : problem.experiments) x.initial[0] = between(0.45, 0.54);
    identify_options options;
    options.search.boxes = 1;
    auto const found = identify(problem, options);
    auto const by = [&found](std::string const& name) {
        return std::ranges::find(found.journal, name, &contraction_record::by)->left;
    };
    CHECK(by("state equations") < 1);
    CHECK(by("state equations") * by("interval observers") < 0.1);
    CHECK(contains(found.hull, truth));
    CHECK(subset(found.hull, rounded_within(contract_by_relations(problem), problem.prior)));
    options.strategy = {};
    auto const without = identify(problem, options);
    CHECK(without.journal.empty());
    CHECK(contains(without.hull, truth));
}

TEST_CASE("slow and fast processes are told as well as those of seconds") {
    // x0' = p0 - p1 x0, of which the integral is read 40 times, in other units of time.
    auto const m = support::model_of({2, 2, 0, 1e9},
                                     [](auto const&, auto const& x, auto const& p, auto const&) {
                                         return std::vector{p[0] - p[1] * x[0], x[0]};
                                     });
    for (double const unit : {1.0, 1e-5, 1e-2, 300.0, 1e6}) {
        std::vector<double> const truth{1.2 / unit / unit, 1.5 / unit};
        double const rest = truth[0] / truth[1], start = 0.5 / unit;
        identification_problem problem{
            m,
            {support::all_constants(2), {}},
            box{between(0.8 / unit / unit, 2 / unit / unit), between(1 / unit, 2 / unit)},
            {}};
        experiment e{"S", {}, 0, box{around(start, 0.1 / unit), around(0, 0.001)}, {}, 0};
        for (int k = 1; k <= 40; ++k) {
            double const t = 0.1 * k * unit;
            double const q = rest * t + (start - rest) * (1 - std::exp(-truth[1] * t)) / truth[1];
            e.measurements.push_back({t, 1, around(q, 0.002)});
        }
        problem.experiments.push_back(e);
        std::size_t asked = 0;
        relation_contraction_options how;
        how.rounds = 1;
        how.keep_going = [&asked] { return ++asked > 0; };
        auto const left = contract_by_relations(problem, how);
        INFO(unit);
        CHECK(contains(left, truth));
        CHECK(asked < 2000);
        for (std::size_t j = 0; j < 2; ++j) CHECK(width(left[j]) < 0.9 * width(problem.prior[j]));
    }
}
