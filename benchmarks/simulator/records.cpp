// SPDX-License-Identifier: MIT
#include "records.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>

namespace simulator {
namespace {

struct ends {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
};

/// A file that MuJoCo reads from memory.
std::unique_ptr<mjModel, ends> load(std::string const& text) {
    auto const files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    auto const at = mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(text.size()));
    if (at < 0) throw std::runtime_error("MuJoCo takes no file");
    std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[at]));
    char error[1000] = "";
    std::unique_ptr<mjModel, ends> m{mj_loadXML("robot.xml", files.get(), error, sizeof error)};
    mj_deleteVFS(files.get());
    if (!m) throw std::runtime_error(std::string(error) + "\n" + text);
    return m;
}

/// A rubber stop in the way of the first joint: what no part of a file in MuJoCo 2.2 is.
struct {
    double stiffness = 0, at = 0;
} stop;
void press(mjModel const*, mjData* d) {
    d->qfrc_passive[0] -= stop.stiffness * std::max(0.0, d->qpos[0] - stop.at);
}

/// One run: the positions of the channels every half millisecond.
/// @param commands  one row a sample; made by `law` where it has too few
std::vector<values> run(drawn_case const& c, mjModel& m, double step, double duration, double start,
                        values const& drawn, std::vector<values>& commands) {
    m.opt.timestep = step;
    std::unique_ptr<mjData, ends> const d{mj_makeData(&m)};
    d->qpos[0] = start;
    auto const fine = std::lround(0.0005 / step), all = std::lround(duration / 0.0005);
    auto const each = std::lround(sample / 0.0005), by = std::lround(c.truth.size / 0.0005);
    std::vector<values> path;
    for (long k = 0; k <= all; ++k) {
        path.emplace_back(d->qpos, d->qpos + c.robot.channels.size());
        if (k % each == 0 && commands.size() <= static_cast<std::size_t>(k / each)) {
            auto u = c.robot.law(0.0005 * static_cast<double>(k), {d->qpos, d->qpos + m.nq},
                                 {d->qvel, d->qvel + m.nv}, drawn);
            for (double& x : u) x = std::round(x * 1e4) / 1e4;
            commands.push_back(u);
        }
        for (std::size_t i = 0; i < c.robot.inputs.size(); ++i) {
            bool const late = c.truth.by == way::by_input && c.truth.where == i;
            long const from = late ? std::max(0L, k - by) : k;
            d->ctrl[i] = commands[static_cast<std::size_t>(from / each)][i];
        }
        if (k < all)
            for (long s = 0; s < fine; ++s) mj_step(&m, d.get());
    }
    return path;
}

double farthest(std::vector<values> const& a, std::vector<values> const& b, std::size_t i) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k][i] - b[k][i]));
    return most;
}

} // namespace

record simulate(drawn_case const& c, std::mt19937_64& random, double duration) {
    auto const m = load(c.robot.mjcf(c.constants, c.truth));
    stop = {c.truth.by == way::by_rubber ? c.truth.size : 0, c.robot.stop};
    mjcb_passive = press;
    values const drawn{uniform(random, 0.4, 0.8), uniform(random, 1.5, 3),
                       uniform(random, 0.2, 0.5), uniform(random, 3.5, 6)};
    record r;
    r.start = std::round(uniform(random, c.robot.start[0], c.robot.start[1]) * 1e4) / 1e4;
    auto const coarse = run(c, *m, 5e-4, duration, r.start, drawn, r.commands);
    auto const path = run(c, *m, 2.5e-4, duration, r.start, drawn, r.commands);
    for (int k = 0; k < m->nv; ++k) m->dof_solref[k * mjNREF] *= 2;
    auto const softer = run(c, *m, 2.5e-4, duration, r.start, drawn, r.commands);
    for (std::size_t i = 0; i < c.robot.channels.size(); ++i)
        r.bounds.push_back(c.robot.noise[i] + c.robot.step[i] / 2 + 2 * farthest(coarse, path, i) +
                           2 * farthest(softer, path, i) + 1e-9);
    auto const each = std::lround(sample / 0.0005), by = std::lround(c.truth.size / 0.0005);
    for (long k = 0; k < static_cast<long>(path.size()); k += each) {
        r.times.push_back(0.0005 * static_cast<double>(k));
        values row;
        for (std::size_t i = 0; i < c.robot.channels.size(); ++i) {
            bool const late = c.truth.by == way::by_channel && c.truth.where == i;
            long const at = late ? std::max(0L, k - by) : k;
            double const seen = path[static_cast<std::size_t>(at)][i] +
                                uniform(random, -c.robot.noise[i], c.robot.noise[i]);
            row.push_back(std::round(seen / c.robot.step[i]) * c.robot.step[i]);
        }
        r.readings.push_back(row);
    }
    return r;
}

} // namespace simulator
