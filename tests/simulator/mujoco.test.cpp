// SPDX-License-Identifier: MIT
// MuJoCo as the machine: what is withheld from the user's file is identified from a record, written
// back, and MuJoCo with the new file follows the record.
#include "simulator/pendulum.hpp"
#include "support/catch.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace simulator_test;

struct ends_model {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
};

/// The joint every 0.05 s for 2 s, released at 0.8 rad.
/// @param step  0: that of the file
std::vector<double> motion(std::string const& xml, double step = 0) {
    char error[500] = "";
    std::unique_ptr<mjModel, ends_model> const m{
        mj_loadXML(xml.c_str(), nullptr, error, sizeof error)};
    INFO(error);
    REQUIRE(m != nullptr);
    if (step > 0) m->opt.timestep = step;
    std::unique_ptr<mjData, ends_model> const d{mj_makeData(m.get())};
    d->qpos[0] = 0.8;
    auto const steps = std::lround(0.05 / m->opt.timestep);
    std::vector<double> result{d->qpos[0]};
    for (int k = 1; k <= 40; ++k) {
        for (long s = 0; s < steps; ++s) mj_step(m.get(), d.get());
        result.push_back(d->qpos[0]);
    }
    return result;
}

double farthest(std::vector<double> const& a, std::vector<double> const& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

/// How far the integrator of MuJoCo may be from the motion of its own equations: RK4 with half the
/// step differs by at most 1/16 of its error, so that the error of the finer run is less than the
/// difference. A further halving shows that both steps are small enough for that.
double integrator_error(std::string const& xml) {
    auto const coarse = motion(xml, 1e-3), fine = motion(xml, 5e-4), finer = motion(xml, 2.5e-4);
    double const first = farthest(coarse, fine), second = farthest(fine, finer);
    CHECK(second <= std::max(first / 8, 1e-13));
    return first;
}

/// The file of the machine: the user's with what nobody told him.
void build_machine(bench const& b, std::string const& attributes) {
    std::string text{file};
    text.replace(text.find("damping='0'"), 11, attributes);
    b.folder.write("machine.xml", text);
}

constexpr double noise = 0.002; ///< [rad]

/// A record of the machine, its bounds those of the noise and of the integrator.
/// @returns the bound
double record(bench const& b, std::vector<double>& readings, std::string const& parameters) {
    double const error = noise + integrator_error(b.at("machine.xml"));
    readings = motion(b.at("machine.xml"));
    for (std::size_t k = 0; k < readings.size(); ++k)
        readings[k] += noise * std::sin(7.0 * static_cast<double>(k));
    b.record(readings, error, parameters);
    return error;
}

} // namespace

TEST_CASE("what an identification says of damping and armature lets MuJoCo follow the record") {
    bench const b;
    build_machine(b, "damping='0.012' armature='0.004'");
    std::vector<double> readings;
    double const error = record(b, readings, R"("Fv": {"prior": [0, 0.05], "unit": "N m s"},
        "rotor": {"prior": [0, 0.0002], "unit": "kg m^2"})");
    auto const found =
        b.run({"identify", b.at("data"), "--out", b.at("out"), "--quiet", "--budget", "4"});
    CAPTURE(found.out, found.err);
    REQUIRE(found.code == 0);
    auto const written = b.write();
    CAPTURE(written.out, written.err);
    REQUIRE(written.code == 0);
    CHECK(farthest(motion(b.at("arm.xml")), readings) > 20 * error);
    CHECK(farthest(motion(b.at("new.xml")), readings) <= error);
}

TEST_CASE("what a diagnosis says of friction lets MuJoCo follow the record") {
    bench const b(incomplete);
    build_machine(b, "damping='0.012'");
    std::vector<double> readings;
    double const error = record(b, readings, R"("weight": {"prior": [0.97, 0.99], "unit": "N m"})");
    auto const found = b.run({"diagnose", b.at("data"), "--out", b.at("out"), "--quiet", "--budget",
                              "6", "--threads", "1"});
    CAPTURE(found.out, found.err);
    REQUIRE(found.code == 0);
    b.folder.write("map.json", R"json({"format": "sivid-export-1", "attributes": [
      {"joint": "elbow", "attribute": "damping", "value": "viscous.k"},
      {"body": "link", "attribute": "mass", "value": "weight/(9.81*0.2)", "unit": "kg"}]})json");
    for (std::string const result : {"out", "out/model"}) {
        auto const written = b.write(result);
        CAPTURE(result, written.out, written.err);
        REQUIRE(written.code == 0);
        CHECK(farthest(motion(b.at("arm.xml")), readings) > 20 * error);
        CHECK(farthest(motion(b.at("new.xml")), readings) <= error);
    }
}
