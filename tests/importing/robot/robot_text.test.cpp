// SPDX-License-Identifier: MIT
// Models that are written of described robots: their equations, priors, effects, and what can be
// known of their constants.
#include "support/catch.hpp"
#include "support/urdf_texts.hpp"
#include "text/values.hpp"

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/enclosure/enclose.hpp>
#include <sivid/importing/robot/robot_text.hpp>
#include <sivid/importing/urdf_reader.hpp>
#include <sivid/text/read_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

using namespace sivid;

namespace {

described_robot read(std::string const& text) {
    auto const file = std::filesystem::temp_directory_path() / "sivid_robot_text.urdf";
    std::ofstream(file, std::ios::binary) << text;
    return read_urdf(file);
}
text_model model_of(std::string const& urdf, double within = 0.2) {
    return model_from_text(text_of_robot(read(urdf), within).model, "robot.toml");
}
std::vector<signal> constant(std::vector<double> const& values) {
    std::vector<signal> result;
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
    for (auto const* line : {"mx_upper + 0.3 m_fore\n", "my_upper\n", "Izz_upper + 0.09 m_fore\n",
                             "mx_fore\n", "my_fore\n", "Izz_fore\n"})
        CHECK_THAT(text.about, ContainsSubstring(line));
    auto const m = model_from_text(text.model, "robot.toml");
    // M11 w1' + M12 w2' = ...: the determinant is that of the double pendulum.
    double const a = 0.4, b = -0.7, v = 1.1, w = -2;
    auto const x = texts::values(m.model, {a, v, b, w}, {2, 1});
    double const pull = 0.3 * 0.096, m11 = 0.039 + 0.01752 + 0.8 * 0.09 + 2 * pull * std::cos(b),
                 m12 = 0.01752 + pull * std::cos(b), m22 = 0.01752;
    auto const friction = [](double most, double viscous, double speed) {
        return viscous * speed + most * speed / std::hypot(speed, 0.033);
    };
    double const s = pull * std::sin(b), g = 9.81;
    double const h1 = -s * w * (2 * v + w) +
                      g * ((0.18 + 0.8 * 0.3) * std::cos(a) + 0.096 * std::cos(a + b)),
                 h2 = s * v * v + g * 0.096 * std::cos(a + b);
    double const t1 = 2 - h1 - friction(0.2, 0.1, v), t2 = 1 - h2 - friction(0.1, 0.05, w);
    double const d = m11 * m22 - m12 * m12;
    CHECK(x[1] == Approx((m22 * t1 - m12 * t2) / d));
    CHECK(x[3] == Approx((m11 * t2 - m12 * t1) / d));
}

TEST_CASE("constants that cannot be told apart move nothing, all others do") {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        auto const robot = read(urdf_texts::random_robot(seed)(3, seed % 2 == 0));
        auto const base = base_parameters_of(robot);
        auto const n = 10 * robot.joints.size();
        // Each constant that is no combination's own moves those of its combinations: with these
        // moved back, all torques are what they were.
        auto const torques = [&](std::vector<double> const& change, unsigned draw) {
            urdf_texts::random_robot random(draw);
            body_motion<double> motion;
            std::vector<body_inertia<double>> bodies;
            std::vector<double> rate;
            for (std::size_t i = 0; i < robot.joints.size(); ++i) {
                auto const& j = robot.joints[i];
                motion.origin.push_back(
                    {sparse<double>(j.origin[0]), {j.origin[1]}, {j.origin[2]}});
                motion.place.push_back(random.uniform(-3, 3));
                motion.speed.push_back(random.uniform(-3, 3));
                rate.push_back(random.uniform(-9, 9));
                std::array<sparse<double>, 10> c;
                for (std::size_t k = 0; k < 10; ++k) c[k] = change[10 * i + k];
                bodies.push_back(body_of(c));
            }
            motion.gravity[2] = -9.81;
            rigid_bodies<double> of(robot.structure(), bodies, motion);
            auto const h = of.bias();
            auto const m = of.mass();
            double sum = 0;
            for (std::size_t i = 0; i < h.size(); ++i) {
                double t = h[i].value_or(0);
                for (std::size_t k = 0; k < h.size(); ++k) t += m[i][k].value_or(0) * rate[k];
                sum = std::max(sum, std::abs(t));
            }
            return sum;
        };
        std::vector<bool> is_kept(n);
        for (auto const& c : base.known) is_kept[c.kept] = true;
        for (std::size_t f = 0; f < n; ++f) {
            if (is_kept[f]) continue;
            std::vector<double> change(n);
            change[f] = 1;
            for (auto const& c : base.known)
                for (auto const& t : c.terms)
                    if (t.constant == f) change[c.kept] = -t.factor;
            for (unsigned draw = 1; draw <= 5; ++draw) CHECK(torques(change, draw) < 1e-12);
        }
        for (auto const& c : base.known) {
            std::vector<double> change(n);
            change[c.kept] = 1;
            CHECK(torques(change, 1) + torques(change, 2) > 1e-6);
        }
    }
}

TEST_CASE("a robot within the stated share is in the priors, with the others as described") {
    auto const m = model_of(urdf_texts::arm, 0.2);
    // fore heavier by 20 %, and its centre of mass where it was: m, mx, Izz by 20 %.
    std::vector<double> const x{0.3, 1, -0.8, 2}, tau{1, -1};
    auto const moved =
        rates_with(m, {{"m_fore", 0.96}, {"mx_fore", 0.1152}, {"Izz_fore", 0.021024}}, x, tau);
    std::vector<std::pair<std::string, double>> const instead{{"mx_fore", 0.1152},
                                                              {"Izz_fore", 0.021024},
                                                              {"mx_upper", 0.18 + 0.3 * 0.16},
                                                              {"Izz_upper", 0.039 + 0.09 * 0.16}};
    auto const alike = rates_with(m, instead, x, tau);
    for (std::size_t k = 0; k < 4; ++k) CHECK(alike[k] == Approx(moved[k]));
    for (auto const& [name, value] : instead) {
        auto const at = std::find(m.unknown.begin(), m.unknown.end(), name);
        REQUIRE(at != m.unknown.end());
        auto const& prior = m.prior[static_cast<std::size_t>(at - m.unknown.begin())];
        CHECK(prior.lower() <= value);
        CHECK(value <= prior.upper());
    }
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
        auto const motion = enclose(m.model, {}, box(around), box(), 0, 0.3, tau);
        REQUIRE(motion.complete());
        auto const simulated =
            simulate(std::make_shared<approximate_model>(m.model, parameter_choice{}, tau), tau,
                     start, {}, 0, {0.1, 0.2, 0.3});
        for (std::size_t k = 0; k < 3; ++k) {
            auto const proved = motion.at(0.1 * double(k + 1));
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
    for (auto const& x : run.states) CHECK(energy(x) == Approx(energy(start)).margin(1e-7));
}
