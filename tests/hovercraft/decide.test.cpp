// SPDX-License-Identifier: MIT
// What the bundled set h3 says of the report's scenarios: the tubes hold 100000 simulations, and
// its requirements are decided.
#include "craft.hpp"
#include "model.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/app/generate.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/verifier/predict_from.hpp>

#include "io/support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Dense>

using sivid::app::generate;
using sivid::app::generate_options;

using answer = sivid::requirement_answer;

namespace {

sivid::app::robot const& craft() {
    static auto const once = hovercraft_example::craft();
    return once;
}

/// An identification, as its files say it.
struct identified {
    sivid::recorded_model model = sivid::record_model(hovercraft{});
    sivid::identification_problem problem;
    sivid::stored_identification stored;

    explicit identified(sivid::dataset const& data, sivid::identify_options const& options = {}) {
        problem = sivid::problem_from_dataset(data, model);
        auto const found = sivid::identify(problem, options);
        io_support::temporary_folder const folder;
        folder.write("result.json",
                     sivid::identification_json(problem, found, {.dataset = data.id}));
        folder.write("boxes.csv", sivid::boxes_csv(problem, found));
        folder.write("products.csv", sivid::products_csv(found));
        stored = sivid::read_identification(folder.path());
    }

    [[nodiscard]] std::unique_ptr<sivid::stored_prediction>
    predicted(std::string const& scenario, sivid::recorded_model const& with,
              std::vector<sivid::node_id> const& margins,
              std::map<std::string, sivid::interval> const& set = {}) const {
        auto const s = sivid::app::find_scenario(craft(), scenario);
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
        double const end = sivid::app::find_scenario(craft(), scenario).duration;
        auto const what = sivid::parse_requirement(text, with, end);
        auto const p = predicted(scenario, with, what.margins, set);
        return sivid::verify(p->problem, what, p->feasible);
    }
};

identified const& h3() {
    static identified const once(
        sivid::read_dataset(SIVID_SOURCE_DIR "/examples/hovercraft/data/h3",
                            sivid::names_of(sivid::record_model(hovercraft{}).about)));
    return once;
}

/// Four manoeuvres and nine unknown constants, of which the data tell seven combinations.
identified const& nine() {
    auto const number = [](char const* text) { return *sivid::exact_decimal::parse(text); };
    static identified const once = [&] {
        auto const model = sivid::record_model(hovercraft{});
        auto scenarios = sivid::app::find_scenarios(craft(), "all");
        scenarios.push_back(sivid::app::find_scenario(craft(), "S4"));
        generate_options o;
        for (auto const* bound : {"0.02", "0.02", "0.05", "0.02", "0.02", "0.03"})
            o.absolute.push_back(number(bound));
        for (auto const& [name, lower, upper] : {std::tuple{"Sv", "0.2", "0.25"},
                                                 {"Sg", "0.0042", "0.0754"},
                                                 {"m", "1.2", "1.4"},
                                                 {"Iz", "0.052", "0.064"},
                                                 {"D22", "0.15", "0.25"},
                                                 {"D33", "0.08", "0.12"},
                                                 {"Ff", "0.4", "0.6"},
                                                 {"Su", "0.11", "0.15"},
                                                 {"L", "0.25", "0.35"}})
            o.unknown.push_back({name, number(lower), number(upper)});
        sivid::identify_options how;
        how.search.boxes = 1000; // what it takes does not depend on the machine
        return identified(generate(model, scenarios, o).data, how);
    }();
    return once;
}

sivid::interval range(char const* low, char const* high) {
    return *sivid::enclose(*sivid::exact_decimal::parse(low), *sivid::exact_decimal::parse(high));
}

/// What measurements say of single points, by simulations.
class plain_data {
public:
    explicit plain_data(identified const& t) : t_(t) {
        for (auto const& e : t.problem.experiments) {
            auto& run = runs_.emplace_back();
            run.samples = sivid::sorted(e.measurements);
            for (auto const& m : run.samples)
                if (run.times.empty() || m.time > run.times.back()) run.times.push_back(m.time);
            run.model = std::make_shared<sivid::approximate_model const>(t.model, t.problem.choice,
                                                                         e.inputs);
        }
    }
    /// How far each output is from the middle of its bound, in half widths.
    [[nodiscard]] Eigen::VectorXd operator()(std::vector<double> const& point) const {
        std::vector<double> all;
        for (std::size_t e = 0; e < runs_.size(); ++e) {
            auto const& run = runs_[e];
            auto const& experiment = t_.problem.experiments[e];
            auto const seen = sivid::simulate(run.model, experiment.inputs, mid(experiment.initial),
                                              point, 0, run.times, {1e-8});
            for (auto const& m : run.samples) {
                auto const k = static_cast<std::size_t>(
                    std::lower_bound(run.times.begin(), run.times.end(), m.time) -
                    run.times.begin());
                all.push_back(2 * (seen.outputs[k][m.channel] - mid(m.bound)) / width(m.bound));
            }
        }
        return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
    }
    [[nodiscard]] bool explained_by(std::vector<double> const& point) const {
        return (*this)(point).cwiseAbs().maxCoeff() <= 1;
    }

private:
    struct recorded_run {
        sivid::record samples;
        std::vector<double> times;
        std::shared_ptr<sivid::approximate_model const> model;
    };
    identified const& t_;
    std::vector<recorded_run> runs_;
};

/// Tubes of S3 against simulations from points that explain the data.
class tubes_of_s3 {
public:
    /// @param counted  narrower tubes are not compared
    explicit tubes_of_s3(identified const& t, double counted)
        : counted_(counted),
          p_(t.predicted("S3", t.model, {})),
          tube_(sivid::predict(p_->problem, {.seconds = 200, .cells = 60})),
          scenario_(std::make_shared<sivid::approximate_model const>(t.model, t.problem.choice,
                                                                     p_->direct.inputs)) {
        REQUIRE(tube_.complete);
        low_.assign(tube_.times.size() * tube_.channels.size(), HUGE_VAL);
        high_.assign(low_.size(), -HUGE_VAL);
    }
    [[nodiscard]] sivid::box around() const { return p_->problem.around(); }

    /// Outputs [time and channel] at a point.
    [[nodiscard]] std::vector<double> outputs(std::vector<double> const& point) const {
        auto const run = sivid::simulate(scenario_, p_->direct.inputs, mid(p_->direct.initial),
                                         point, 0, tube_.times, {1e-8});
        std::vector<double> all;
        for (auto const& y : run.outputs) all.insert(all.end(), y.begin(), y.end());
        return all;
    }
    void hold(std::vector<double> const& point) {
        auto const y = outputs(point);
        auto const m = tube_.channels.size();
        for (std::size_t i = 0; i < y.size(); ++i) {
            auto const k = i / m, c = i % m;
            // The simulations are accurate to some 1e-7.
            if (!(tube_.channels[c].low[2 * k] <= y[i] + 1e-6 &&
                  y[i] - 1e-6 <= tube_.channels[c].high[2 * k])) {
                CAPTURE(tube_.times[k], c, y[i]);
                FAIL("a simulation leaves its tube");
            }
            low_[i] = std::min(low_[i], y[i]);
            high_[i] = std::max(high_[i], y[i]);
        }
    }
    [[nodiscard]] double ratio(std::size_t i) const {
        auto const& tube = tube_.channels[i % tube_.channels.size()];
        auto const k = 2 * (i / tube_.channels.size());
        double const own = tube.high[k] - tube.low[k];
        return own > counted_ ? own / (high_[i] - low_[i]) : 0;
    }
    /// @param most  the largest ratio of a tube's width to that of the simulations
    void check_widths(double most) const {
        double widest = 0, own_there = 0;
        std::string where;
        auto const m = tube_.channels.size();
        for (std::size_t i = 0; i < low_.size(); ++i) {
            auto const k = i / m, c = i % m;
            if (ratio(i) <= widest) continue;
            widest = ratio(i);
            own_there = tube_.channels[c].high[2 * k] - tube_.channels[c].low[2 * k];
            where = tube_.channels[c].name + " at " + std::to_string(tube_.times[k]) + " s";
        }
        CAPTURE(where, own_there, tube_.excess, tube_.parts, tube_.seconds);
        CHECK(widest < most);
        WARN("widest ratio " << widest << ", of " << where << ", where the tube is " << own_there);
    }

private:
    double counted_;
    std::unique_ptr<sivid::stored_prediction> p_;
    sivid::prediction tube_;
    std::shared_ptr<sivid::approximate_model const> scenario_;
    std::vector<double> low_, high_;
};

void compare_h3(std::size_t wanted) {
    tubes_of_s3 tubes(h3(), 1e-4);
    plain_data const data(h3());
    support::draws d{17};
    auto const around = tubes.around(); // L Sg, Sv
    for (std::size_t feasible = 0; feasible < wanted;) {
        double const product = d.uniform(around[0].lower(), around[0].upper());
        double const side = d.uniform(around[1].lower(), around[1].upper());
        double const length = d.uniform(0.25, 0.35);
        std::vector<double> const point{side, product / length, length};
        if (!data.explained_by(point)) continue;
        ++feasible;
        tubes.hold(point);
    }
    tubes.check_widths(wanted < 1000 ? 1.5 : 1.1);
}

/// Slopes of a function.
template <class F>
Eigen::MatrixXd slopes(Eigen::VectorXd const& at, F const& f) {
    Eigen::MatrixXd all;
    for (Eigen::Index j = 0; j < at.size(); ++j) {
        Eigen::VectorXd const step = 0.5 * Eigen::VectorXd::Unit(at.size(), j);
        Eigen::VectorXd const up = f(at + step), down = f(at - step);
        if (j == 0) all.resize(up.size(), at.size());
        all.col(j) = up - down;
    }
    return all;
}

/// The largest g z over |r + A z| <= 1, from z = 0 inside, by affine scaling; a little inside.
Eigen::VectorXd extreme(Eigen::VectorXd const& g, Eigen::VectorXd const& r,
                        Eigen::MatrixXd const& a) {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(g.size());
    for (int k = 0; k < 15; ++k) {
        Eigen::ArrayXd const at = (r + a * z).array();
        Eigen::ArrayXd const weight = (1 - at).square().inverse() + (1 + at).square().inverse();
        Eigen::MatrixXd const h = a.transpose() * weight.matrix().asDiagonal() * a;
        Eigen::VectorXd const step = h.ldlt().solve(g);
        Eigen::ArrayXd const moves = (a * step).array();
        double furthest = HUGE_VAL;
        for (Eigen::Index i = 0; i < moves.size(); ++i) {
            if (moves[i] == 0) continue;
            furthest = std::min(furthest, (moves[i] > 0 ? 1 - at[i] : -1 - at[i]) / moves[i]);
        }
        z += 0.8 * furthest * step;
    }
    return z;
}

/// Points that explain the data and lie where they move S3 most, and mixtures of them. Iz and L
/// stay: outputs see them in products with others alone.
void compare_nine(std::size_t wanted) {
    tubes_of_s3 tubes(nine(), 1e-3); // a twentieth of the error bounds
    plain_data const data(nine());
    auto const& unknown = nine().problem.choice.unknown;
    std::vector<std::size_t> varied; // which of them
    std::vector<double> truth;
    for (std::size_t j = 0; j < unknown.size(); ++j) {
        auto const& all = nine().model.about.constants;
        truth.push_back(all[sivid::index_of(all, unknown[j], "constant")].nominal.nearest);
        if (unknown[j] != "Iz" && unknown[j] != "L") varied.push_back(j);
    }
    auto const n = static_cast<Eigen::Index>(varied.size());
    auto const point = [&](Eigen::VectorXd const& z) { // in thousandths of the truth
        auto p = truth;
        for (Eigen::Index j = 0; j < n; ++j)
            p[varied[static_cast<std::size_t>(j)]] *= 1 + 1e-3 * z[j];
        return p;
    };
    auto const outputs = [&](Eigen::VectorXd const& z) {
        auto const all = tubes.outputs(point(z));
        return Eigen::VectorXd(
            Eigen::Map<Eigen::VectorXd const>(all.data(), static_cast<Eigen::Index>(all.size())));
    };
    // What bounds points: data and prior.
    auto const misfits = [&](Eigen::VectorXd const& z) {
        auto const p = point(z);
        auto const of_data = data(p);
        Eigen::VectorXd all(of_data.size() + n);
        all.head(of_data.size()) = of_data;
        for (Eigen::Index j = 0; j < n; ++j) {
            auto const k = varied[static_cast<std::size_t>(j)];
            auto const& side = nine().problem.prior[k];
            all[of_data.size() + j] = 2 * (p[k] - mid(side)) / width(side);
        }
        return all;
    };
    Eigen::VectorXd const zero = Eigen::VectorXd::Zero(n);
    auto const moved = slopes(zero, outputs), a = slopes(zero, misfits);
    auto const r = misfits(zero);
    REQUIRE(r.cwiseAbs().maxCoeff() < 1);
    std::vector<Eigen::VectorXd> ends;
    std::size_t feasible = 0;
    // From a point that explains the data on, as far as it does: outputs are not quite linear.
    auto const hold = [&](Eigen::VectorXd const& from, Eigen::VectorXd way) {
        for (int k = 0; k < 400; ++k, way *= 0.9995) {
            if (misfits(from + way).cwiseAbs().maxCoeff() > 1) continue;
            tubes.hold(point(from + way));
            ends.push_back(from + way);
            ++feasible;
            return true;
        }
        return false;
    };
    for (Eigen::Index i = 0; i < moved.rows(); ++i) {
        if (moved.row(i).cwiseAbs().maxCoeff() < 1e-9) continue;
        for (double const sign : {-1.0, 1.0}) {
            if (!hold(zero, extreme(sign * moved.row(i).transpose(), r, a))) continue;
            for (int again = 0; again < 5 && tubes.ratio(static_cast<std::size_t>(i)) > 1.07;
                 ++again) {
                Eigen::VectorXd const at = 0.9998 * ends.back();
                auto const slope = slopes(at, outputs);
                if (!hold(at, extreme(sign * slope.row(i).transpose(), misfits(at),
                                      slopes(at, misfits))))
                    break;
            }
        }
    }
    CAPTURE(ends.size());
    REQUIRE(ends.size() > 600);
    support::draws d{18};
    while (feasible < wanted) {
        double const s = d.uniform(0, 1), t = d.uniform(0, 1 - s);
        auto const any = [&] { return ends[d.below(600)]; };
        (void)hold(zero, s * any() + t * any() + (1 - s - t) * any());
    }
    CAPTURE(wanted);
    tubes.check_widths(1.1);
}

} // namespace

TEST_CASE("tubes over h3 hold what it allows") { compare_h3(300); }
TEST_CASE("tubes over h3 hold 100000 simulations and are little wider", "[.long]") {
    compare_h3(100'000);
}
TEST_CASE("tubes over nine parameters hold 100000 simulations and are little wider", "[.long]") {
    compare_nine(100'000);
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
