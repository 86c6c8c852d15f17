// SPDX-License-Identifier: MIT
// Models that are written of described robots: their equations, priors, effects, and what can be
// known of their constants.
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/urdf_texts.hpp"
#include "text/values.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/enclosure/enclose.hpp>
#include <sivid/importing/robot/robot_text.hpp>
#include <sivid/importing/urdf_reader.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/paving/identifiability.hpp>
#include <sivid/text/read_model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

using namespace sivid;

namespace {

described_robot read(std::string const& text) {
    io_support::temporary_folder const folder;
    folder.write("robot.urdf", text);
    return read_urdf(folder.path() / "robot.urdf");
}
text_model model_of(std::string const& urdf, double within = 0.2) {
    return model_from_text(text_of_robot(read(urdf), within).model, "robot.toml");
}
std::vector<sivid::signal> constant(std::vector<double> const& values) {
    std::vector<sivid::signal> result;
    for (double const v : values)
        result.push_back(sampled_signal({0.0}, {v}, interpolation::linear));
    return result;
}
/// What the same torques do where some constants have other values.
std::vector<double> rates_with(text_model const& m,
                               std::vector<std::pair<std::string, double>> const& changed,
                               std::vector<double> const& x, std::vector<double> const& tau) {
    auto model = m.model;
    for (auto const& [name, value] : changed)
        for (auto& c : model.about.constants)
            if (c.name == name) c.nominal = {interval(value), value};
    return texts::values(model, x, tau);
}

} // namespace

TEST_CASE("a plane arm is written as one writes it by hand") {
    auto const text = text_of_robot(read(urdf_texts::arm), 0.2);
    CHECK_THAT(text.about, ContainsSubstring("6 of 20 inertial constants or combinations"));
    for (auto const* line :
         {"mx_upper - 3.33333 Izz_upper\n", "my_upper\n", "m_fore + 11.1111 Izz_upper\n",
          "mx_fore\n", "my_fore\n", "Izz_fore\n"})
        CHECK_THAT(text.about, ContainsSubstring(line));
    auto const m = model_from_text(text.model, "robot.toml");
    // M11 w1' + M12 w2' = ...: the determinant is that of the double pendulum.
    double const a = 0.4, b = -0.7, v = 1.1, w = -2;
    auto const x = texts::values(m.model, {a, v, b, w}, {2, 1});
    double const pull = 0.3 * 0.096, m11 = 0.039 + 0.01752 + 0.8 * 0.09 + 2 * pull * std::cos(b),
                 m12 = 0.01752 + pull * std::cos(b), m22 = 0.01752;
    auto const friction = [](double most, double viscous, double speed) {
        return viscous * speed + most * speed / std::hypot(speed, 0.2);
    };
    double const s = pull * std::sin(b), g = 9.81;
    double const h1 = -s * w * (2 * v + w) +
                      g * ((0.18 + 0.8 * 0.3) * std::cos(a) + 0.096 * std::cos(a + b)),
                 h2 = s * v * v + g * 0.096 * std::cos(a + b);
    double const t1 = 2 - h1 - friction(0.2, 0.1, v), t2 = 1 - h2 - friction(0.1, 0.05, w);
    double const d = m11 * m22 - m12 * m12;
    CHECK_THAT(x[1], WithinRel((m22 * t1 - m12 * t2) / d, 1e-12));
    CHECK_THAT(x[3], WithinRel((m11 * t2 - m12 * t1) / d, 1e-12));
}

namespace {

/// The torques that a robot with these inertial constants takes in some motions, one after the
/// other.
std::vector<double> torques(described_robot const& robot, std::vector<double> const& constants) {
    urdf_texts::random_robot random(9);
    std::vector<double> result;
    for (int motions = 0; motions < 40; ++motions) {
        body_motion<double> motion;
        std::vector<body_inertia<double>> bodies;
        std::vector<double> rate;
        for (std::size_t i = 0; i < robot.joints.size(); ++i) {
            auto const& o = robot.joints[i].origin;
            motion.origin.push_back({sparse<double>(o[0]), {o[1]}, {o[2]}});
            motion.place.push_back(random.uniform(-3, 3));
            motion.speed.push_back(random.uniform(-3, 3));
            rate.push_back(random.uniform(-9, 9));
            std::array<sparse<double>, 10> c;
            for (std::size_t k = 0; k < 10; ++k) c[k] = constants[10 * i + k];
            bodies.push_back(body_of(c));
        }
        motion.gravity[2] = -9.81;
        rigid_bodies<double> of(robot.structure(), bodies, motion);
        auto const h = of.bias();
        auto const m = of.mass();
        for (std::size_t i = 0; i < h.size(); ++i) {
            result.push_back(h[i].value_or(0));
            for (std::size_t k = 0; k < h.size(); ++k)
                result.back() += m[i][k].value_or(0) * rate[k];
        }
    }
    return result;
}
double product(std::vector<double> const& a, std::vector<double> const& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

} // namespace

TEST_CASE("what cannot be told apart moves nothing, and what is said to be known is independent") {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        auto const robot = read(urdf_texts::random_robot(seed)(3 + seed % 3, seed % 2 == 0));
        auto const base = base_parameters_of(robot);
        auto const n = 10 * robot.joints.size();
        std::vector<bool> is_kept(n);
        for (auto const& c : base.known) is_kept[c.kept] = true;
        // A constant that is not kept acts as those do whose combinations it is in.
        for (std::size_t f = 0; f < n; ++f) {
            if (is_kept[f]) continue;
            std::vector<double> change(n);
            change[f] = 1;
            for (auto const& c : base.known)
                for (auto const& t : c.terms)
                    if (t.constant == f) change[c.kept] = -t.factor;
            auto const t = torques(robot, change);
            CHECK(product(t, t) < 1e-14);
        }
        // Gram and Schmidt: each column has a part that those before it have not.
        std::vector<std::vector<double>> columns;
        for (auto const& c : base.known) {
            std::vector<double> change(n);
            change[c.kept] = 1;
            auto column = torques(robot, change);
            auto const whole = product(column, column);
            for (auto const& q : columns) {
                auto const part = product(q, column);
                for (std::size_t k = 0; k < column.size(); ++k) column[k] -= part * q[k];
            }
            auto const left = std::sqrt(product(column, column));
            CHECK(left > 1e-4 * std::sqrt(whole));
            for (auto& x : column) x /= left;
            columns.push_back(std::move(column));
        }
    }
}

TEST_CASE("a robot within the stated share is in the priors, with the others as described") {
    auto const m = model_of(urdf_texts::arm, 0.2);
    // The upper arm has 20 % more inertia about its joint.
    std::vector<double> const x{0.3, 1, -0.8, 2}, tau{1, -1};
    auto const moved = rates_with(m, {{"Izz_upper", 0.0468}}, x, tau);
    std::vector<std::pair<std::string, double>> const instead{{"m_fore", 0.8 + 0.0078 / 0.09},
                                                              {"mx_upper", 0.18 - 0.0078 / 0.3}};
    auto const alike = rates_with(m, instead, x, tau);
    for (std::size_t k = 0; k < 4; ++k) CHECK_THAT(alike[k], WithinRel(moved[k], 1e-12));
    for (auto const& [name, value] : instead) {
        auto const at = std::find(m.unknown.begin(), m.unknown.end(), name);
        REQUIRE(at != m.unknown.end());
        auto const& prior = m.prior[static_cast<std::size_t>(at - m.unknown.begin())];
        CHECK(prior.lower() <= value);
        CHECK(value <= prior.upper());
    }
}

TEST_CASE("priors that hold inertias of no body are said") {
    // (1 - w)^2 I = (1 + w)^2 (m c)^2/m: w = 0.104 for the fore arm, 0.092 for the upper one.
    auto const about = [](double within) {
        return text_of_robot(read(urdf_texts::arm), within).about;
    };
    CHECK_THAT(about(0.09), !ContainsSubstring("no body has"));
    CHECK_THAT(about(0.1), ContainsSubstring("'upper' may have inertias that no body has") &&
                               ContainsSubstring("none within 9%") && !ContainsSubstring("'fore'"));
    CHECK_THAT(about(0.11), ContainsSubstring("'fore' may have inertias that no body has"));
}

TEST_CASE("each effect attaches to its joint by name") {
    auto const m = model_of(urdf_texts::arm);
    CHECK(m.effects.size() == 26);
    for (auto const* name : {"shoulder_stribeck", "elbow_coulomb", "elbow_load_friction",
                             "elbow_command_delay", "shoulder_late_speed", "elbow_armature"})
        CHECK(std::any_of(m.effects.begin(), m.effects.end(),
                          [&](auto const& e) { return e.name == name; }));
}

TEST_CASE("names with other letters, and twice the same, are made names of the model") {
    auto text = urdf_texts::arm;
    text = urdf_texts::with(text, "name=\"elbow\"", "name=\"elbow-joint/1\"");
    text = urdf_texts::with(text, "name=\"shoulder\"", "name=\"elbow joint.1\"");
    text = urdf_texts::with(text, "<robot name=\"arm\"", "<robot name=\"a&quot;b&#10;c = 1\"");
    auto const m = model_of(text);
    CHECK(m.model.about.name == "a_b_c___1");
    CHECK(m.model.about.inputs[0].name == "tau_elbow_joint_1");
    CHECK(m.model.about.inputs[1].name == "tau_elbow_joint_12");
}

TEST_CASE("enclosures of written robots contain what is simulated") {
    for (std::size_t joints = 1; joints <= 3; ++joints) {
        CAPTURE(joints);
        auto const m = model_of(urdf_texts::random_robot(unsigned(joints) + 20)(joints), 0);
        std::vector<double> start;
        std::vector<interval> around;
        for (std::size_t k = 0; k < 2 * joints; ++k) start.push_back(0.1 * double(k + 1));
        for (double const x : start) around.emplace_back(x);
        auto const tau = constant(std::vector<double>(joints, 2));
        std::vector<double> const times{0.1, 0.2, 0.3};
        auto const motion =
            enclose(m.model, {}, box(around), box(), 0, 0.3, carried_set::taylor_model, {}, tau);
        REQUIRE(motion.complete());
        auto const simulated =
            simulate(std::make_shared<approximate_model>(m.model, parameter_choice{}, tau), tau,
                     start, {}, 0, times);
        for (std::size_t k = 0; k < 3; ++k) {
            auto const proved = motion.at(times[k]);
            for (std::size_t i = 0; i < start.size(); ++i) {
                CHECK(proved[i].lower() - 1e-7 <= simulated.states[k][i]);
                CHECK(simulated.states[k][i] <= proved[i].upper() + 1e-7);
                CHECK(proved[i].upper() - proved[i].lower() < 1e-3);
            }
        }
    }
}

TEST_CASE("energy is kept by an arm without friction and torques") {
    auto text =
        urdf_texts::with(urdf_texts::arm, R"(damping="0.1" friction="0.2")", "damping=\"0\"");
    text = urdf_texts::with(text, R"(damping="0.05" friction="0.1")", "damping=\"0\"");
    auto const m = model_of(text);
    auto const none = constant({0, 0});
    std::vector<double> const start{0.5, 0, 0.3, 0};
    auto const run =
        simulate(std::make_shared<approximate_model>(m.model, parameter_choice{}, none), none,
                 start, {}, 0, {0.5, 1, 2}, {.tolerance = 1e-11});
    auto const energy = [](std::vector<double> const& x) {
        double const pull = 0.3 * 0.096 * std::cos(x[2]), g = 9.81;
        double const m11 = 0.039 + 0.01752 + 0.072 + 2 * pull, m12 = 0.01752 + pull;
        return 0.5 * (m11 * x[1] * x[1] + 2 * m12 * x[1] * x[3] + 0.01752 * x[3] * x[3]) +
               g * (0.42 * std::sin(x[0]) + 0.096 * std::sin(x[0] + x[2]));
    };
    for (auto const& x : run.states) CHECK_THAT(energy(x), WithinAbs(energy(start), 1e-7));
}

namespace {

/// The arm, swung for 0.8 s by torques that reach all of its motions.
identification_problem swung(text_model const& m, std::vector<std::string> const& unknown) {
    experiment e;
    e.name = "swing";
    std::vector<double> t, shoulder, elbow;
    for (int k = 0; k <= 150; ++k) {
        t.push_back(0.01 * k);
        shoulder.push_back(9 * std::sin(4.1 * t.back()) + 3 * std::sin(11 * t.back() + 1));
        elbow.push_back(2.4 * std::sin(5.3 * t.back() + 2) + std::sin(14 * t.back()));
    }
    e.initial = {interval(-1), interval(0), interval(0.5), interval(0)};
    e.inputs = {sampled_signal(t, shoulder, interpolation::linear),
                sampled_signal(t, elbow, interpolation::linear)};
    for (int k = 1; k <= 40; ++k)
        for (std::size_t c = 0; c < 4; ++c)
            e.measurements.push_back({0.02 * k, c, interval(-1, 1)});
    std::vector<interval> prior;
    for (auto const& name : unknown)
        for (auto const& c : m.model.about.constants)
            if (c.name == name)
                prior.push_back(interval_traits<interval>::bounds(0.8 * c.nominal.nearest,
                                                                  1.2 * c.nominal.nearest));
    return {m.model, {unknown, {}}, box(prior), {e}};
}
/// Measurements of a motion, within bounds around it.
void measure(identification_problem& plain, identification_problem const& truth,
             std::vector<double> const& parameters) {
    auto const& e = truth.experiments[0];
    std::vector<double> times;
    for (int k = 1; k <= 40; ++k) times.push_back(0.02 * k);
    auto const seen =
        simulate(std::make_shared<approximate_model>(truth.model, truth.choice, e.inputs), e.inputs,
                 mid(e.initial), parameters, 0, times)
            .outputs;
    for (auto& m : plain.experiments[0].measurements) {
        auto const k = static_cast<std::size_t>(std::lround(m.time / 0.02)) - 1;
        double const error = m.channel % 2 == 0 ? 0.002 : 0.05, y = seen[k][m.channel];
        m.bound = interval_traits<interval>::bounds(y - error, y + error);
    }
}

} // namespace

TEST_CASE("each effect at a joint of an arm is found again where it was planted") {
    auto const m = model_of(urdf_texts::arm);
    for (auto const& e : m.effects) {
        CAPTURE(e.name);
        auto plain = swung(m, {"Izz_fore"});
        std::vector<double> planted{0.0175};
        for (auto const& p : e.parameters) {
            auto const neutral = nearest(p.neutral), most = nearest(p.upper);
            planted.push_back(neutral + 0.4 * (most - neutral));
        }
        measure(plain, affected(plain, {e}), planted);
        CHECK(fit(plain).inflation > 1.5);
        CHECK(fit(affected(plain, {e})).inflation < 1);
    }
}

TEST_CASE("measurements tell the constants apart that are said to be known") {
    auto const m = model_of(urdf_texts::arm);
    std::vector<std::string> const known{"mx_upper", "m_fore", "mx_fore", "Izz_fore"};
    auto const told = [&](std::vector<std::string> const& unknown) {
        auto p = swung(m, unknown);
        std::vector<interval> at;
        for (auto const& side : p.prior) at.emplace_back(mid(side));
        return identifiability_of(p, box(at));
    };
    CHECK(told(known).tells_all_apart());
    auto with_more = known;
    with_more.emplace_back("Izz_upper");
    CHECK(told(with_more).approximate_rank == 4);
}
