// SPDX-License-Identifier: MIT
#include <sivid/io/decision_json.hpp>
#include <sivid/verifier/predict_from.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <sivid/io/text/json_document.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace {

struct decided {
    sivid::identification_problem problem = io_support::two_rates_problem();
    sivid::recorded_model model = problem.model;
    sivid::requirement what;
    std::unique_ptr<sivid::stored_prediction> about;

    explicit decided(std::string const& text) {
        what = sivid::parse_requirement(text, model, 1);
        sivid::prediction_request r;
        r.initial = {sivid::interval(2.0)};
        r.end = 1;
        about = sivid::predict_from(problem, io_support::stored_result(problem).read(), model,
                                    what.margins, r, "result.json");
    }
    [[nodiscard]] sivid::json_value answer() const {
        auto const found = sivid::verify(about->problem, what, about->feasible, {.seconds = 2});
        return sivid::parse_json("verification.json",
                                 sivid::verification_json(*about, what, found, {.scenario = "S"}));
    }
};

double number(sivid::json_value const& v) { return *sivid::nearest(v.number()); }

} // namespace

TEST_CASE("a verification is written as it was found") {
    auto const proved = decided("always(x > 1.1)").answer();
    CHECK(proved.at("format").string() == "sivid-verification-1");
    CHECK(proved.at("answer").string() == "proved");
    CHECK(proved.at("requirement").string() == "always(x > 1.1)");
    CHECK(proved.at("coordinates").elements()[0].string() == "a*b");
    CHECK(proved.at("witness").type() == sivid::json_value::kind::null);
    CHECK(proved.at("open").elements().empty());
    CHECK_FALSE(proved.at("assumptions").elements().empty());
    CHECK(number(proved.at("robustness").elements()[0]) > 0);

    auto const refuted = decided("x at 1 > 1.22").answer();
    CHECK(refuted.at("answer").string() == "refuted");
    auto const& w = refuted.at("witness");
    CHECK(number(w.at("parameters").at("a")) * number(w.at("parameters").at("b")) > 0.49);
    CHECK(number(w.at("initial").at("x")) == 2);
    CHECK(number(w.at("robustness").elements()[1]) < 0);
}

TEST_CASE("a prediction is written with its bounds outward") {
    decided const d("x > 0");
    auto const found = sivid::predict(d.about->problem, {.cells = 4});
    auto const json = sivid::parse_json(
        "prediction.json",
        sivid::prediction_json(*d.about, found,
                               {.dataset = "small", .set = {{"c", sivid::interval(1.0)}}}));
    CHECK(json.at("format").string() == "sivid-prediction-1");
    auto const& end = json.at("at_end").at("x").elements();
    CHECK(number(end[0]) <= found.channels[0].low.back());
    CHECK(number(end[1]) >= found.channels[0].high.back());
    auto const table = sivid::tubes_csv(found);
    CHECK(table.starts_with("from,to,x_lower,x_upper\n0,0,"));
    CHECK(std::count(table.begin(), table.end(), '\n') ==
          static_cast<std::ptrdiff_t>(2 * found.times.size()));
}

TEST_CASE("what is not known is no number") {
    decided const d("x > 0");
    sivid::prediction empty;
    empty.times = {0, 1};
    empty.channels = {{"x", "m", {-HUGE_VAL, 0, -HUGE_VAL}, {HUGE_VAL, 1, HUGE_VAL}}};
    auto const json = sivid::parse_json("p", sivid::prediction_json(*d.about, empty, {}));
    CHECK(json.at("excess").type() == sivid::json_value::kind::null);
    CHECK(json.at("at_end").at("x").elements()[0].type() == sivid::json_value::kind::null);
    CHECK(sivid::tubes_csv(empty) == "from,to,x_lower,x_upper\n0,0,,\n0,1,0,1\n1,1,,\n");
}

TEST_CASE("a ranking is written with its bounds outward and its witnesses") {
    auto const problem = io_support::two_rates_problem();
    auto const found = sivid::rank(problem, {.seconds = 5});
    sivid::decision_json_options options;
    options.dataset = "d";
    auto const json =
        sivid::parse_json("ranking.json", sivid::ranking_json(problem, found, options));
    CHECK(json.at("format").string() == "sivid-ranking-1");
    CHECK(json.at("dataset").string() == "d");
    REQUIRE(json.at("channels").elements().size() == found.channels.size());
    auto const& c = found.channels.front();
    auto const& effects = json.at("channels").elements()[0].at("effects").elements();
    auto const order = c.order();
    REQUIRE(effects.size() == order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        auto const& e = c.effects[order[k]];
        CHECK(effects[k].at("parameter").string() == problem.choice.unknown[order[k]]);
        CHECK(number(effects[k].at("effect").elements()[0]) <= e.low);
        CHECK(number(effects[k].at("effect").elements()[1]) >= e.high);
        REQUIRE(e.low > 0);
        CHECK(number(effects[k].at("from")) == e.from);
        CHECK(number(effects[k].at("to")) == e.to);
    }
    // The rates act as a product.
    CHECK(json.at("only_in_products").elements().size() == 2);
    CHECK(json.at("products").elements()[0].string() == "a*b");
}

TEST_CASE("a ranking writes what measurements are worth, where it was asked") {
    auto const problem = io_support::two_rates_problem();
    auto const found = sivid::rank(problem, {.keep_going = [] { return false; }});
    sivid::measurement_ranking worth;
    worth.explained = sivid::verdict::consistent;
    worth.volume = {0.125, 0.25};
    worth.coordinates = {"a*b"};
    worth.groups = {
        {.what = {.experiment = {}, .channel = 0}, .measurements = 6, .growth = {1.5, 2.1}},
        {.what = {.experiment = 0, .channel = {}, .from = 1.25}, .measurements = 4}};
    auto const json =
        sivid::parse_json("ranking.json", sivid::ranking_json(problem, found, {}, &worth));
    auto const& told = json.at("measurements");
    CHECK(told.at("explained").string() == "consistent");
    CHECK(told.at("coordinates").elements()[0].string() == "a*b");
    auto const& groups = told.at("without").elements();
    REQUIRE(groups.size() == 2);
    CHECK(groups[0].at("channel").string() == problem.model.about.channels[0].name);
    CHECK(number(groups[0].at("growth").elements()[0]) == 1.5);
    CHECK(number(groups[0].at("growth").elements()[1]) >= 2.1);
    CHECK(groups[1].at("experiment").string() == "run");
    CHECK(number(groups[1].at("from")) == 1.25);
    CHECK(groups[1].find("to") == nullptr);
    CHECK(groups[1].at("growth").elements()[1].type() == sivid::json_value::kind::null);
    auto const silent = sivid::parse_json("ranking.json", sivid::ranking_json(problem, found, {}));
    CHECK(silent.find("measurements") == nullptr);
}

TEST_CASE("gains are written with their shares, their proof and what speaks against others") {
    decided const d("x at 1 in [1.15, 1.3]");
    // The second product's range stands in for a gain.
    auto& p = d.about->problem;
    auto& q = d.about->direct;
    for (auto* const each : {&p, &q}) {
        each->model.about.constants.push_back({"K", "1", {}});
        each->choice.unknown.push_back("K");
        for (auto& set : each->sets) {
            std::vector<sivid::interval> sides(set.begin(), set.end());
            sides.push_back(sivid::interval_traits<sivid::interval>::bounds(0, 2));
            set = sivid::box(std::move(sides));
        }
    }
    d.about->sides.push_back("K");
    auto const found =
        sivid::find_gains(p, {"K"}, d.what, {}, {.motions = {.seconds = 2}, .accuracy = 0.1});
    auto const json = sivid::parse_json(
        "control.json",
        sivid::control_json(*d.about, d.what, found, nullptr,
                            {.scenario = "S", .law = "W = K", .sensors = {{"x", 0.5}}}));
    CHECK(json.at("format").string() == "sivid-control-1");
    CHECK(json.at("law").string() == "W = K");
    CHECK(number(json.at("sensors").at("x")) == 0.5);
    CHECK(json.at("gains").elements()[0].string() == "K");
    CHECK(number(json.at("proved_share")) >= 0);
    CHECK(number(json.at("left_share")) <= 1);
    CHECK(sivid::gains_csv(found).starts_with("verdict,K_lower,K_upper\n"));
}

TEST_CASE("an experiment is written with what it promises, or with what hides it") {
    sivid::design_answer answer;
    decided d("x > 0");
    answer.goals = {{"a * b", 0}};
    answer.plan = {{0.5, 1}, std::vector<double>(d.model.about.channels.size(), 0.1)};
    answer.limits = "x > 0";
    sivid::tried_manoeuvre m;
    m.name = "ramp";
    m.about = {{"begin of u", "N", 0, 2}};
    m.settings = {0.5};
    m.estimate = 0.3;
    answer.found.tried = {m};
    auto const read = [&] {
        return sivid::parse_json("design.json", sivid::design_json(*d.about, answer, {}));
    };
    CHECK(read().at("answer").string() == "open");
    CHECK(read().at("tried").elements()[0].at("share").type() == sivid::json_value::kind::null);

    answer.found.tried[0].promised = sivid::promise{{{0.5, 0.5, 0.1}}};
    CHECK(read().at("answer").string() == "met");
    auto const goal = read().at("goals").elements()[0];
    CHECK(goal.at("goal").string() == "a * b");
    CHECK(number(goal.at("after")) >= 0.1);
    CHECK(number(goal.at("share")) >= 0.2);
    CHECK(number(read().at("tried").elements()[0].at("settings").at("begin of u")) == 0.5);
    answer.target = 0.1;
    CHECK(read().at("answer").string() == "less");
    answer.found.tried[0].limits = sivid::requirement_answer::open;
    CHECK(read().at("answer").string() == "open");
    answer.found.tried[0].limits.reset();
    answer.goals.clear();
    answer.first = "wind";
    CHECK(read().at("answer").string() == "open");
    CHECK(read().at("first").string() == "wind");
    answer.found.tried[0].promised->told_apart = true;
    CHECK(read().at("answer").string() == "met");
    answer.hidden = "a";
    answer.instead = {"a*b"};
    CHECK(read().at("answer").string() == "met");
    answer.impossible = true;
    CHECK(read().at("answer").string() == "hidden");
    CHECK(read().at("instead").elements()[0].string() == "a*b");
}
