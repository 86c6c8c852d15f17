// SPDX-License-Identifier: MIT
// What an unexplained gap ends with: how large a disturbance of one equation explains it.
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/diagnosis_reader.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/model/disturbance.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/text/read_model.hpp>
#include <sivid/verifier/diagnosis_check.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace needed_disturbance_test {

using namespace sivid;
using namespace sivid::literals;

namespace {

/// A sledge that is pushed and rubs.
recorded_model sledge() {
    return model_from_text("format = \"sivid-model-1\"\nname = \"sledge\"\n"
                           "states = { x = \"100 m\", v = \"10 m/s\" }\n"
                           "inputs = { u = \"m/s^2\" }\nconstants = { c = \"1 1/s\" }\n"
                           "outputs = { x = \"x\" }\n"
                           "equations = { x = \"v\", v = \"u - c*v\" }\n",
                           "sledge.toml")
        .model;
}

/// Readings of x within 2 mm from a sledge that is braked by `size` from 1 to 1.6 s.
identification_problem braked(double size) {
    support::draws draw(5);
    identification_problem p;
    p.model = sledge();
    p.choice.unknown = {"c"};
    p.prior = box{interval(0.5, 1.5)};
    experiment e;
    e.name = "run";
    e.initial = box{interval(0.0), interval(1.0)};
    e.inputs = {sampled_signal({0.0}, {0.5}, interpolation::hold)};
    double x = 0, v = 1;
    constexpr int steps = 3000;
    double const dt = 3.0 / steps;
    for (int k = 0; k <= steps; ++k) {
        double const t = k * dt;
        if (k % 100 == 0 && k > 0) {
            double const y = x + draw.uniform(-0.0019, 0.0019);
            e.measurements.push_back({t, 0, interval(y - 0.002, y + 0.002)});
        }
        double const d = t >= 1 && t < 1.6 ? -size : 0;
        auto const f = [&](double w) { return 0.5 - w + d; };
        double const k1 = f(v), k2 = f(v + dt / 2 * k1);
        x += dt * (v + dt / 2 * k1);
        v += dt * k2;
    }
    p.experiments = {e};
    return p;
}

diagnosis_run unexplained(identification_problem base) {
    diagnosis_run run;
    run.base = std::move(base);
    run.result.answer = answer_kind::unexplained;
    run.result.inflation = interval_traits<interval>::bounds(1.5, HUGE_VAL);
    run.result.gap = gap_verdict::certified;
    run.result.assumptions = {input_assumption(run.base.experiments)};
    return run;
}

} // namespace

TEST_CASE("equations on which something acts are disturbed, definitions are not") {
    auto const model = sledge();
    CHECK(driven_equations(model) == std::vector<std::size_t>{1});
}

TEST_CASE("an unexplained gap ends with the disturbance that it needs") {
    constexpr double planted = 0.8;
    auto run = unexplained(braked(planted));
    bound_disturbances(run, 10);
    REQUIRE(run.result.remainder);
    auto const& all = run.result.remainder->disturbances;
    REQUIRE(all.size() == 1);
    auto const& n = all.front();
    CHECK(n.equation == "v");
    CHECK(n.unit == "m/s^2");
    CHECK(n.size.lower() <= planted);
    CHECK(n.size.lower() > 0.2 * planted);
    REQUIRE(std::isfinite(n.size.upper()));
    REQUIRE(n.reached.size() == 1);
    CHECK(n.reached.front().from < 1.6);
    CHECK(n.reached.front().to > 1);
    CHECK_FALSE(n.strongest.empty());
    auto const words = report::disturbance_clause(n, "s");
    CHECK_THAT(words, Catch::Contains("m/s\u00b2 of unknown disturbance of v") &&
                          Catch::Contains("explains everything (proved)") &&
                          Catch::Contains("somewhere in run"));

    // What is stored is bounded again; what is forged is refuted or at least not verified.
    auto const checked = [&](diagnosis const& d) {
        io_support::temporary_folder const folder;
        folder.write("diagnosis.json",
                     diagnosis_json(d, "data", {"", "", problem_digest(run.base)}));
        for (auto const& f : check_diagnosis(run.base, {}, read_diagnosis(folder.path()), {}))
            if (f.what == "disturbances") return f.found;
        return check_finding::outcome::nothing;
    };
    CHECK(checked(run.result) == check_finding::outcome::verified);
    auto forged = run.result;
    auto& f = forged.remainder->disturbances.front();
    f.size = interval(2 * n.size.upper(), 3 * n.size.upper());
    CHECK(checked(forged) == check_finding::outcome::refuted);
    f.size = interval(0.0, 0.5 * n.size.lower());
    CHECK(checked(forged) == check_finding::outcome::refuted);
    f.size = interval(n.size.lower(), 0.5 * (n.size.lower() + n.size.upper()));
    CHECK(checked(forged) != check_finding::outcome::verified);
    f = n;
    f.reached.front().to = f.reached.front().from;
    CHECK(checked(forged) != check_finding::outcome::verified);
    f = n;
    f.equation = "w";
    CHECK(checked(forged) == check_finding::outcome::refuted);
    f = n;
    f.unit = "m/s";
    CHECK(checked(forged) == check_finding::outcome::refuted);
}

TEST_CASE("answers that explain, and what is not covered, get no disturbance") {
    for (auto const kind : {answer_kind::none, answer_kind::effects, answer_kind::open}) {
        auto run = unexplained(braked(0.8));
        run.result.answer = kind;
        bound_disturbances(run, 5);
        CHECK_FALSE(run.result.remainder);
    }
    auto run = unexplained(braked(0.8));
    run.base.experiments.front().outliers = 1;
    bound_disturbances(run, 5);
    CHECK_FALSE(run.result.remainder);
}

} // namespace needed_disturbance_test
