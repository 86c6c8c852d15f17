// SPDX-License-Identifier: MIT
// What the bundled set h3 says of the report's scenarios: the tubes hold 100000 simulations, and
// its requirements are decided.
#include "commands.hpp"
#include "scenario.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/stored_prediction.hpp>
#include <sivid/paving/identify.hpp>

#include "io/support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace hovercraft_example;
using answer = sivid::requirement_answer;

namespace {

/// The identification of h3, as its files say it.
struct identified {
    sivid::recorded_model model = sivid::record_model(hovercraft{});
    sivid::identification_problem problem;
    sivid::stored_identification stored;

    identified() {
        auto const data = sivid::read_dataset(SIVID_SOURCE_DIR "/examples/hovercraft/data/h3",
                                              sivid::names_of(model.about));
        problem = sivid::problem_from_dataset(data, model);
        auto const found = sivid::identify(problem);
        io_support::temporary_folder const folder;
        folder.write("result.json", sivid::identification_json(problem, found, {.dataset = "h3"}));
        folder.write("boxes.csv", sivid::boxes_csv(problem, found));
        folder.write("products.csv", sivid::products_csv(found));
        stored = sivid::read_identification(folder.path());
    }

    [[nodiscard]] std::unique_ptr<sivid::stored_prediction>
    predicted(std::string const& scenario, sivid::recorded_model const& with,
              std::vector<sivid::node_id> const& margins,
              std::map<std::string, sivid::interval> const& set = {}) const {
        auto const s = find_scenarios(scenario, sivid::names_of(model.about)).front();
        sivid::prediction_request r;
        r.end = s.duration;
        r.initial = sivid::box(s.initial.size());
        for (std::size_t i = 0; i < s.initial.size(); ++i) r.initial[i] = s.initial[i].enclosure;
        for (auto const& u : s.inputs) r.inputs.push_back(sivid::exact_signal(u, s.duration));
        r.set = set;
        return sivid::predict_from(problem, stored, with, margins, r, "result.json");
    }
    [[nodiscard]] sivid::verification
    verified(std::string const& scenario, std::string const& text,
             std::map<std::string, sivid::interval> const& set = {}) const {
        auto with = model;
        double const end = find_scenarios(scenario, sivid::names_of(model.about)).front().duration;
        auto const what = sivid::parse_requirement(text, with, end);
        auto const p = predicted(scenario, with, what.margins, set);
        return sivid::verify(p->problem, what, p->feasible);
    }
};

identified const& h3() {
    static identified const once;
    return once;
}

sivid::interval range(char const* low, char const* high) {
    return *sivid::enclose(*sivid::exact_decimal::parse(low), *sivid::exact_decimal::parse(high));
}

/// Simulates from parameters that explain the data, and compares with the tubes.
void compare_with_simulations(std::size_t wanted) {
    auto const& t = h3();
    auto const p = t.predicted("S3", t.model, {});
    auto const tube = sivid::predict(p->problem, {.cells = 60});
    REQUIRE(tube.complete);
    auto const& data = t.problem.experiments[0];
    auto const samples = sivid::sorted(data.measurements);
    std::vector<double> sample_times;
    for (auto const& m : samples)
        if (sample_times.empty() || m.time > sample_times.back()) sample_times.push_back(m.time);
    auto const recorded =
        std::make_shared<sivid::approximate_model const>(t.model, t.problem.choice, data.inputs);
    auto const scenario = std::make_shared<sivid::approximate_model const>(
        t.model, t.problem.choice, p->direct.inputs);
    auto const start = mid(data.initial), begin = mid(p->direct.initial);
    support::draws d{17};
    auto const m = tube.channels.size();
    std::vector<double> low(tube.times.size() * m, HUGE_VAL), high(low.size(), -HUGE_VAL);
    auto const around = p->problem.around(); // L Sg, Sv
    std::size_t feasible = 0;
    while (feasible < wanted) {
        double const product = d.uniform(around[0].lower(), around[0].upper());
        double const side = d.uniform(around[1].lower(), around[1].upper());
        double const length = d.uniform(0.25, 0.35);
        std::vector<double> const point{side, product / length, length};
        auto const seen =
            sivid::simulate(recorded, data.inputs, start, point, 0, sample_times, {1e-8});
        bool explains = true;
        for (auto const& sample : samples) {
            auto const k = static_cast<std::size_t>(
                std::lower_bound(sample_times.begin(), sample_times.end(), sample.time) -
                sample_times.begin());
            explains = explains && contains(sample.bound, seen.outputs[k][sample.channel]);
        }
        if (!explains) continue;
        ++feasible;
        auto const run =
            sivid::simulate(scenario, p->direct.inputs, begin, point, 0, tube.times, {1e-8});
        for (std::size_t k = 0; k < tube.times.size(); ++k) {
            for (std::size_t c = 0; c < m; ++c) {
                double const y = run.outputs[k][c];
                // The simulations are accurate to some 1e-7.
                if (!(tube.channels[c].low[2 * k] <= y + 1e-6 &&
                      y - 1e-6 <= tube.channels[c].high[2 * k])) {
                    CAPTURE(tube.times[k], c, y);
                    FAIL("a simulation leaves its tube");
                }
                low[k * m + c] = std::min(low[k * m + c], y);
                high[k * m + c] = std::max(high[k * m + c], y);
            }
        }
    }
    double widest = 0, own_there = 0;
    std::string where;
    for (std::size_t k = 0; k < tube.times.size(); ++k) {
        for (std::size_t c = 0; c < m; ++c) {
            double const own = tube.channels[c].high[2 * k] - tube.channels[c].low[2 * k];
            double const theirs = high[k * m + c] - low[k * m + c];
            if (!(own > 1e-4) || own / theirs <= widest) continue;
            widest = own / theirs;
            own_there = own;
            where = tube.channels[c].name + " at " + std::to_string(tube.times[k]) + " s";
        }
    }
    CAPTURE(wanted, where, own_there);
    CHECK(widest < (wanted < 1000 ? 1.5 : 1.1));
    WARN("widest ratio " << widest << ", of " << where << ", where the tube is " << own_there);
}

} // namespace

TEST_CASE("tubes over h3 hold what it allows") { compare_with_simulations(300); }
TEST_CASE("tubes over h3 hold 100000 simulations and are little wider", "[.long]") {
    compare_with_simulations(100'000);
}

TEST_CASE("S1 and S2 over the set of h3") {
    auto const& t = h3();
    std::string const s1 = "eventually[0, 1](u >= 2)";
    std::string const s2 = "eventually(abs(u) < 0.01) and x at end in [3, 7]";
    CHECK(t.verified("S1", s1).answer == answer::proved);
    CHECK(t.verified("S2", s2).answer == answer::proved);
    std::map<std::string, sivid::interval> const narrow{{"Ff", range("0.286", "0.777")}};
    CHECK(t.verified("S1", s1, narrow).answer == answer::proved);
    auto const close = t.verified("S2", s2, narrow); // its ends nearly violate
    CHECK(close.answer == answer::proved);
    CHECK(close.parts < 300);
    CHECK(close.integrations < 400);
    std::map<std::string, sivid::interval> const wide{{"Ff", range("0.25", "0.8")}};
    CHECK(t.verified("S1", s1, wide).answer == answer::proved);
    auto const fails = t.verified("S2", s2, wide);
    REQUIRE(fails.answer == answer::refuted);
    double const friction = fails.witness->parameters.back();
    CHECK((friction < 0.286 || friction > 0.777));
    CHECK(friction >= 0.25);
    CHECK(friction <= 0.8);
}
