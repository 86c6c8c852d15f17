// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/simulation_mesh.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;

TEST_CASE("the mesh follows an unknown delay of input and channel") {
    auto model =
        support::model_of({1, 2, 1}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[0] * u[0] + p[1] * x[0]};
        });
    model.input_memory = {{0, 0}};
    model.channel_delays = {{0, 1}};
    parameter_choice choice;
    choice.unknown = {"p0", "p1"};
    sampled_signal const u({0, 1, 2}, {0, 2, 2}, interpolation::linear);
    approximate_model const plain(model, choice, {u});
    simulation_mesh mesh(plain, {u}, 0, {{0.5, 0}, {2, 0}}, {1.5});
    mesh.place({0.25, 0.75});
    std::vector<double> times;
    for (std::size_t k = 0; k <= mesh.pieces(); ++k) times.push_back(mesh.time(k));
    CHECK(times == std::vector<double>{0, 0.25, 1.25, 1.5, 2});
    CHECK(mesh.observed(0) == std::vector<std::size_t>{0}); // before the begin: the begin
    CHECK(mesh.observed(2) == std::vector<std::size_t>{1});
    CHECK_THAT(mesh.input(1, 0, 0.75), WithinAbs(1, 1e-9));
    CHECK_THAT(mesh.slope(1, 0), WithinAbs(2, 1e-9));
    CHECK(mesh.slope(0, 0) == 0);
    CHECK_FALSE(mesh.jumps());
    mesh.place({0.25, 0.75});
    CHECK(mesh.slope_by(memory_kind::delay, 1, 0, mesh.time(1)) == -mesh.slope(1, 0));
    mesh.place({0, 0});
    CHECK(mesh.time(1) == 0.5);
    CHECK(mesh.observed(1) == std::vector<std::size_t>{0});
}

TEST_CASE("the mesh follows an unknown play, of a record and of a formula, late or not") {
    auto model =
        support::model_of({1, 2, 1}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[0] * u[0] + p[1] * x[0]};
        });
    model.input_memory = {{0, 0, memory_kind::play}, {0, 1}};
    parameter_choice choice;
    choice.unknown = {"p0", "p1"};
    sampled_signal const u({0, 1, 2}, {0, 1, 0}, interpolation::linear);
    approximate_model const plain(model, choice, {u});
    simulation_mesh mesh(plain, {u}, 0, {{2, 0}}, {});
    mesh.place({0.25, 0});
    std::vector<double> times, slopes;
    for (std::size_t k = 0; k <= mesh.pieces(); ++k) times.push_back(mesh.time(k));
    for (std::size_t k = 0; k < mesh.pieces(); ++k)
        slopes.push_back(mesh.slope_by(memory_kind::play, k, 0, mesh.time(k)));
    CHECK(times == std::vector<double>{0, 0.25, 1, 1.5, 2});
    CHECK(slopes == std::vector<double>{0, -1, -1, 1});
    CHECK_THAT(mesh.input(2, 0, 1.25), WithinAbs(0.75, 1e-12));
    mesh.place({0.25, 0.5}); // late as well
    CHECK_THAT(mesh.input(mesh.pieces(), 0, 2), WithinAbs(0.75, 1e-12));
    mesh.place({0.5, 0}); // from the record again, not from what was behind the other play
    CHECK_THAT(mesh.input(mesh.pieces(), 0, 2), WithinAbs(0.5, 1e-12));
    signal const wave = analytic_signal::from([](auto const& t) { return sin(t); });
    approximate_model const of_wave(model, choice, {wave});
    simulation_mesh fine(of_wave, {wave}, 0, {{2, 0}}, {});
    fine.place({0.25, 0});
    CHECK_THAT(fine.input(fine.pieces(), 0, 2), WithinAbs(0.75, 1e-4));
    fine.place({0.125, 0});
    CHECK_THAT(fine.input(fine.pieces(), 0, 2), WithinAbs(0.875, 1e-4));
}
