// SPDX-License-Identifier: MIT
// Descriptions of robots: what is read, and what is refused by its name.
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/urdf_texts.hpp"

#include <sivid/importing/robot/robot_text.hpp>
#include <sivid/importing/urdf_reader.hpp>
#include <sivid/io/input_error.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using urdf_texts::arm;
using urdf_texts::with;

namespace {

described_robot read(std::string const& text, urdf_options const& options = {}) {
    io_support::temporary_folder const folder;
    folder.write("robot.urdf", text);
    return read_urdf(folder.path() / "robot.urdf", options);
}
/// What is said of a text that cannot be read.
std::string refused(std::string const& text, urdf_options const& options = {}) {
    try {
        (void)read(text, options);
    } catch (input_error const& e) {
        return e.what();
    }
    return "it was read";
}

std::string const elbow_limit = R"(<limit lower="-3" upper="3" effort="8" velocity="10"/>)";
std::string const fore_mass = R"(<mass value="0.8"/>)";
std::string const fore_inertia = R"(ixx="0.0005" iyy="0.006" izz="0.006")";

/// The arm with links behind its last.
std::string with_more(std::string const& more) { return with(arm, "</robot>", more + "</robot>"); }

} // namespace

TEST_CASE("an arm's bodies, joints and numbers are those of its description") {
    auto const r = read(arm);
    CHECK(r.name == "arm");
    REQUIRE(r.joints.size() == 2);
    auto const &a = r.joints[0], &b = r.joints[1];
    CHECK(a.joint.parent == body_joint::base);
    CHECK(a.joint.turn == std::array<std::array<double, 3>, 3>{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}});
    CHECK(b.joint.parent == 0);
    CHECK(b.origin == std::array<double, 3>{0.3, 0, 0});
    CHECK(b.damping == 0.05);
    CHECK(b.friction == 0.1);
    CHECK(b.range->second == 3);
    CHECK(b.inertial ==
          std::array<double, 10>{0.8, 0.096, 0, 0, 0.0005, 0.01752, 0.01752, 0, 0, 0});
}

TEST_CASE("links that are fixed together are one body") {
    auto const tool = R"(<link name="tool"><inertial><origin xyz="0 0 0.1"/><mass value="0.2"/>
        <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
        <joint name="flange" type="TYPE"><origin xyz="0.25 0 0" rpy="0 1.5708 0"/>
        <parent link="fore"/><child link="tool"/><axis xyz="1 0 0"/></joint>)";
    auto const fixed = read(with_more(with(tool, "TYPE", "fixed")));
    REQUIRE(fixed.joints.size() == 2);
    auto const& c = fixed.joints[1].inertial;
    CHECK(c[0] == 1);
    CHECK(c[1] == 0.166);
    CHECK_THAT(c[6], WithinRel(0.01752 + 1e-4 + 0.2 * 0.35 * 0.35, 1e-12));
    // The same where a joint that moves is taken as fixed.
    auto const held = read(with_more(with(tool, "TYPE", "continuous")), {.fixed = {"flange"}});
    CHECK(held.joints[1].inertial == c);
    CHECK(read(with_more(with(tool, "TYPE", "continuous"))).joints.size() == 3);
    CHECK_THAT(refused(arm, {.fixed = {"wrist"}}), ContainsSubstring("no joint 'wrist'"));
}

TEST_CASE("what has no place in an open chain of rigid bodies is refused by its name") {
    auto const joint = [](std::string const& more) {
        return with(arm, elbow_limit, elbow_limit + more);
    };
    auto const type = [](std::string const& other) {
        return with(arm, R"(name="elbow" type="revolute")",
                    "name=\"elbow\" type=\"" + other + "\"");
    };
    std::vector<std::pair<std::string, std::string>> const bad{
        {with_more("<spring k=\"1\"/>"), "line 15: an unknown element <spring> in <robot 'arm'>"},
        {with_more("<xacro:macro/>"), "expand the file first"},
        {joint("<spring/>"), "an unknown element <spring> in <joint 'elbow'>"},
        {joint(elbow_limit), "a second <limit> in <joint 'elbow'>"},
        {with(arm, "friction=\"0.1\"", "friction=\"0.1\" spring=\"1\""),
         "an unknown attribute 'spring' of <dynamics> of <joint 'elbow'>"},
        {joint("<mimic joint=\"shoulder\"/>"), "the joint 'elbow' mimics 'shoulder'"},
        {type("floating"), "the joint 'elbow' is floating"},
        {type("planar"), "the joint 'elbow' is planar"},
        {type("ball"), "elbow"},
        {with(arm, elbow_limit, R"(<limit lower="3" upper="3" effort="8" velocity="10"/>)"),
         "the joint 'elbow' has limits that leave it no motion"},
        {with(arm, elbow_limit, ""), "elbow"},
        {with(arm, fore_mass, R"(<mass value="nan"/>)"),
         "'nan' in value of <mass> of <inertial> of <link 'fore'> is no decimal number"},
        {with(arm, fore_mass, R"(<mass value="1e400"/>)"), "is no decimal number"},
        {with(arm, fore_mass, R"(<mass value="1e7"/>)"), "is beyond 1e6"},
        {with(arm, fore_mass, R"(<mass value="0,8"/>)"), "'0,8' in value"},
        {with(arm, fore_mass, R"(<mass value="0"/>)"),
         "the link 'fore' has moments of inertia and no mass"},
        {with(arm, fore_mass, R"(<mass value="-1"/>)"), "the link 'fore' has a negative mass"},
        {with(arm, fore_inertia, R"(ixx="0.0005" iyy="0.006" izz="0.02")"),
         "the link 'fore' has moments of inertia that no body has"},
        {with(arm, fore_inertia, R"(ixx="-0.1" iyy="0.006" izz="0.006")"),
         "the link 'fore' has moments of inertia that no body has"},
        {with(arm, R"(xyz="0.12 0 0")", R"(xyz="0.12 0")"), "has 2 numbers; write three"},
        {with_more(R"(<joint name="back" type="fixed"><parent link="base"/><child link="fore"/>
           </joint>)"),
         "is the child of two joints, 'elbow' and 'back': a closed chain"},
        {with_more(R"(<link name="a"/><link name="b"/>
           <joint name="x" type="fixed"><parent link="a"/><child link="b"/></joint>
           <joint name="y" type="fixed"><parent link="b"/><child link="a"/></joint>)"),
         "a closed chain"},
        {with_more(R"(<link name="hand"/><joint name="wrist" type="continuous">
           <parent link="fore"/><child link="hand"/></joint>)"),
         "the link 'hand', which the joint 'wrist' moves, has no mass"},
        {with_more("<link name=\"alone\"/>"), "alone"},
        {with(arm, "<robot", "<sdf"), ""},
        {"", "this is no whole XML"},
        {"<robot name=\"r\"><link name=\"l\"/></robot>", "no joint that moves"}};
    for (auto const& [text, words] : bad) {
        CAPTURE(words);
        CHECK_THAT(refused(text), ContainsSubstring(words) && !StartsWith("it was read"));
    }
}

TEST_CASE("eight joints are refused, and may be fixed") {
    auto const eight = urdf_texts::random_robot(1)(8);
    CHECK_THAT(refused(eight), ContainsSubstring("the joint 'j8' is the eighth that moves"));
    CHECK(read(eight, {.fixed = {"j3"}}).joints.size() == 7);
}

TEST_CASE("a description that is cut anywhere is refused") {
    for (std::size_t n = 0; n + 2 < arm.size(); n += 7) {
        CAPTURE(n);
        CHECK_THAT(refused(arm.substr(0, n)), !StartsWith("it was read"));
    }
}

TEST_CASE("elements that are nested without end are refused") {
    std::string deep = "<robot name=\"r\">";
    for (int k = 0; k < 50'000; ++k) deep += "<link>";
    CHECK_THAT(refused(deep), ContainsSubstring("nested more than 100 deep"));
    std::string chain = "<robot name=\"r\"><link name=\"0\"/>";
    for (int k = 1; k < 50'000; ++k) {
        auto const own = std::to_string(k), before = std::to_string(k - 1);
        chain += "<link name=\"" + own + "\"/><joint name=\"" + own +
                 "\" type=\"fixed\"><parent link=\"" + before + "\"/><child link=\"" + own +
                 "\"/></joint>";
    }
    CHECK_THAT(refused(chain + "</robot>"), ContainsSubstring("more than 2000 links"));
}

TEST_CASE("what has no mass and moves nothing needs no inertia, and pictures are passed over") {
    auto const r = read(with(arm, "</inertial></link>",
                             "</inertial><visual><geometry><mesh filename=\"\"/></geometry>"
                             "</visual></link>"));
    REQUIRE(r.notes.size() == 1);
    CHECK(r.notes[0] == "dropped: <visual>: nothing in them changes this model of motion");
}
