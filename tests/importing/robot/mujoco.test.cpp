// SPDX-License-Identifier: MIT
// The equations of described robots against MuJoCo, which has an implementation of its own.
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/urdf_texts.hpp"
#include "text/values.hpp"

#include <sivid/importing/robot/robot_text.hpp>
#include <sivid/importing/urdf_reader.hpp>
#include <sivid/text/read_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

namespace {

/// A robot in MuJoCo, without contacts and limits.
class other_robot {
public:
    explicit other_robot(std::string const& urdf) {
        auto const files = std::make_unique<mjVFS>();
        mj_defaultVFS(files.get());
        auto const k =
            mj_makeEmptyFileVFS(files.get(), "robot.urdf", static_cast<int>(urdf.size()));
        REQUIRE(k >= 0);
        std::memcpy(files->filedata[k], urdf.data(), urdf.size());
        char error[500] = "";
        model_.reset(mj_loadXML("robot.urdf", files.get(), error, sizeof error));
        mj_deleteVFS(files.get());
        INFO(error);
        REQUIRE(model_ != nullptr);
        model_->opt.disableflags |= mjDSBL_CONSTRAINT;
        data_.reset(mj_makeData(model_.get()));
    }
    /// Accelerations of joints by their names.
    std::vector<double> operator()(std::vector<std::string> const& joints,
                                   std::vector<double> const& q, std::vector<double> const& w,
                                   std::vector<double> const& tau) {
        std::vector<std::size_t> at;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            auto const id = mj_name2id(model_.get(), mjOBJ_JOINT, joints[i].c_str());
            REQUIRE(id >= 0);
            at.push_back(static_cast<std::size_t>(model_->jnt_dofadr[id]));
            data_->qpos[model_->jnt_qposadr[id]] = q[i];
            data_->qvel[at[i]] = w[i];
            data_->qfrc_applied[at[i]] = tau[i];
        }
        mj_forward(model_.get(), data_.get());
        std::vector<double> result;
        for (auto const k : at) result.push_back(data_->qacc[k]);
        return result;
    }

private:
    struct frees {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    std::unique_ptr<mjModel, frees> model_;
    std::unique_ptr<mjData, frees> data_;
};

sivid::described_robot read(std::string const& text) {
    io_support::temporary_folder const folder;
    folder.write("robot.urdf", text);
    return sivid::read_urdf(folder.path() / "robot.urdf");
}

/// The largest difference of accelerations over the largest acceleration, at 1000 states.
double difference(std::string const& urdf, unsigned seed) {
    auto const robot = read(urdf);
    auto const model = sivid::model_from_text(sivid::text_of_robot(robot, 0).model, "robot.toml");
    other_robot other(urdf);
    urdf_texts::random_robot random(seed);
    std::vector<std::string> joints;
    for (auto const& j : robot.joints) joints.push_back(j.name);
    auto const n = joints.size();
    double worst = 0;
    for (int state = 0; state < 1000; ++state) {
        std::vector<double> q(n), w(n), tau(n), x(2 * n);
        for (std::size_t i = 0; i < n; ++i) {
            x[2 * i] = q[i] = random.uniform(-3, 3);
            x[2 * i + 1] = w[i] = random.uniform(-3, 3);
            tau[i] = random.uniform(-20, 20);
        }
        auto const ours = texts::values(model.model, x, tau);
        auto const theirs = other(joints, q, w, tau);
        double off = 0, most = 0;
        for (std::size_t i = 0; i < n; ++i) {
            off = std::max(off, std::abs(ours[2 * i + 1] - theirs[i]));
            most = std::max(most, std::abs(theirs[i]));
        }
        worst = std::max(worst, off / most);
    }
    return worst;
}

} // namespace

TEST_CASE("accelerations of described chains are those of MuJoCo", "[importing][mujoco]") {
    for (std::size_t joints = 1; joints <= 7; ++joints) {
        CAPTURE(joints);
        CHECK(difference(urdf_texts::random_robot(unsigned(joints))(joints), 5) < 1e-9);
    }
}

TEST_CASE("and of trees", "[importing][mujoco]") {
    CHECK(difference(urdf_texts::random_robot(11)(7, true), 5) < 1e-9);
    CHECK(difference(urdf_texts::random_robot(12)(5, true), 6) < 1e-9);
}

TEST_CASE("products of inertia have the sign that MuJoCo gives them", "[importing][mujoco]") {
    // It turns them to principal axes, to about 1e-7.
    CHECK(difference(urdf_texts::random_robot(4, true)(3), 5) < 1e-6);
}

TEST_CASE("a changed mass is seen by the comparison with MuJoCo", "[importing][mujoco]") {
    auto const text = urdf_texts::random_robot(3)(3);
    auto const robot = read(text);
    REQUIRE(difference(text, 5) < 1e-9);
    CHECK(robot.joints[0].inertial[0] > 0.5);
    auto const at = text.find("mass value=\"") + 12;
    auto const other = std::string(text).replace(at, 1, text[at] == '1' ? "2" : "1");
    other_robot theirs(other);
    auto const model = sivid::model_from_text(sivid::text_of_robot(robot, 0).model, "robot.toml");
    auto const ours = texts::values(model.model, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {1, 2, 3});
    auto const a = theirs({robot.joints[0].name, robot.joints[1].name, robot.joints[2].name},
                          {0.1, 0.3, 0.5}, {0.2, 0.4, 0.6}, {1, 2, 3});
    CHECK(std::abs(ours[1] - a[0]) > 1e-6);
}
