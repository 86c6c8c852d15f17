// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_URDF_READER_HPP
#define SIVID_IMPORTING_URDF_READER_HPP

/// @file
/// Needs liburdfdom (Debian: liburdfdom-dev; CMake: sivid::urdf).

#include <sivid/importing/robot/described_robot.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

namespace sivid {

/// How a description is read.
struct urdf_options {
    std::set<std::string> fixed{};              ///< joints that are taken as fixed at 0
    std::array<double, 3> gravity{0, 0, -9.81}; ///< [m/s^2], in the frame of the root link
};

namespace importing_detail {

/// What an element of URDF may hold. What has no meaning for motions is passed over.
struct urdf_element {
    std::set<std::string> attributes, children, passed_over;

    static urdf_element const& of(std::string const& name) {
        static std::map<std::string, urdf_element> const known{
            {"robot",
             {{"name", "version", "xmlns"},
              {"link", "joint"},
              {"material", "gazebo", "transmission", "sensor", "ros2_control", "mujoco"}}},
            {"link", {{"name", "type"}, {"inertial"}, {"visual", "collision"}}},
            {"inertial", {{}, {"origin", "mass", "inertia"}, {}}},
            {"joint",
             {{"name", "type"},
              {"origin", "parent", "child", "axis", "dynamics", "limit", "mimic"},
              {"calibration", "safety_controller"}}},
            {"origin", {{"xyz", "rpy"}, {}, {}}},
            {"mass", {{"value"}, {}, {}}},
            {"inertia", {{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}, {}}},
            {"parent", {{"link"}, {}, {}}},
            {"child", {{"link"}, {}, {}}},
            {"axis", {{"xyz"}, {}, {}}},
            {"dynamics", {{"damping", "friction"}, {}, {}}},
            {"limit", {{"lower", "upper", "effort", "velocity"}, {}, {}}},
            {"mimic", {{"joint", "multiplier", "offset"}, {}, {}}}};
        return known.at(name);
    }
};

/// Keeps what liburdfdom says, in place of its own printing.
class urdf_words : public console_bridge::OutputHandler {
public:
    urdf_words() { console_bridge::useOutputHandler(this); }
    ~urdf_words() override { console_bridge::restorePreviousOutputHandler(); }
    urdf_words(urdf_words const&) = delete;
    urdf_words& operator=(urdf_words const&) = delete;
    void log(std::string const& text, console_bridge::LogLevel level, char const* /*file*/,
             int /*line*/) override {
        if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) first_ = text;
    }
    [[nodiscard]] std::string const& first() const { return first_; }

private:
    std::string first_;
};

/// Reads a description; users call read_urdf.
class urdf_reader {
public:
    urdf_reader(std::string file, std::string text, urdf_options const& options)
        : file_(std::move(file)), text_(std::move(text)), options_(options) {}

    [[nodiscard]] described_robot read() {
        parse();
        result_.name = model_->getName();
        result_.gravity = options_.gravity;
        for (auto const& name : options_.fixed)
            if (!model_->getJoint(name))
                fail(0, "it has no joint " + in_quotes(name) + ", which is to be fixed",
                     "write its name as in the file");
        add_link(*model_->getRoot(), body_joint::base, {});
        if (links_ != model_->links_.size())
            fail(0, "links hang on each other and not on the root link: a closed chain",
                 "cut it: only open chains can be written");
        if (result_.joints.empty())
            fail(0, "it has no joint that moves",
                 "it needs a joint of type revolute, continuous or prismatic");
        if (!dropped_.empty()) {
            std::string list;
            for (auto const& name : dropped_) list += (list.empty() ? "<" : ", <") + name + ">";
            result_.notes.push_back("dropped: " + list +
                                    ": nothing in them changes this model of motion");
        }
        std::set<std::string> joints, bodies;
        for (auto& j : result_.joints) {
            round_inertial(j.inertial);
            j.of = model_name(j.name, joints);
            j.body = model_name(j.link, bodies);
            if (!j.fastest)
                result_.notes.push_back("assumed: " + in_quotes(j.name) + " is no faster than 10 " +
                                        (j.joint.slides ? "m/s" : "rad/s"));
        }
        require_movable(result_, file_);
        return std::move(result_);
    }

private:
    static constexpr std::size_t most_joints = 7;
    static constexpr double farthest = 1e6; ///< of any number

    [[noreturn]] void fail(int line, std::string problem, std::string remedy) const {
        throw input_error({.file = file_, .line = static_cast<std::size_t>(std::max(line, 0))},
                          std::move(problem), std::move(remedy));
    }

    void parse() {
        TiXmlDocument document;
        document.Parse(text_.c_str());
        if (document.Error())
            fail(document.ErrorRow(), std::string("this is no whole XML: ") + document.ErrorDesc(),
                 "correct it, or export the robot again");
        auto* root = document.RootElement();
        if (root == nullptr || root->ValueStr() != "robot")
            fail(root == nullptr ? 0 : root->Row(), "this is no URDF: no element <robot>",
                 "give a file that begins by <robot name=...>");
        require_known(*root);
        std::size_t count = 0; // chains are followed by recursion
        for (auto const* e = root->FirstChildElement(); e; e = e->NextSiblingElement()) ++count;
        if (count > 2000) fail(0, "more than 2000 links and joints", "leave out what is fixed");
        require_open(*root);
        TiXmlPrinter plain; // without what was passed over
        document.Accept(&plain);
        model_ = parsed(plain.CStr());
    }
    void require_known(TiXmlElement& e) {
        auto const name = e.ValueStr();
        auto const& may = urdf_element::of(name);
        auto const words = about(e);
        for (auto const* a = e.FirstAttribute(); a != nullptr; a = a->Next()) {
            std::string const key = a->Name();
            if (!may.attributes.contains(key) && !key.starts_with("xmlns:"))
                fail(e.Row(), "an unknown attribute " + in_quotes(key) + " of " + words,
                     "leave it out: what it means for the motion is not known");
            require_numbers(*a, e.Row(), words);
        }
        std::set<std::string> seen;
        for (TiXmlElement *c = e.FirstChildElement(), *next = nullptr; c != nullptr; c = next) {
            next = c->NextSiblingElement();
            auto const child = c->ValueStr();
            if (may.passed_over.contains(child)) {
                dropped_.insert(child);
                e.RemoveChild(c);
                continue;
            }
            if (!may.children.contains(child))
                fail(c->Row(), "an unknown element <" + child + "> in " + words,
                     child.starts_with("xacro:") ? "expand the file first: xacro robot.urdf.xacro"
                                                 : "leave it out, or describe what it does by "
                                                   "links and joints");
            if (name != "robot" && !seen.insert(child).second)
                fail(c->Row(), "a second <" + child + "> in " + words, "leave one out");
            require_known(*c);
        }
    }
    [[nodiscard]] static std::string about(TiXmlElement const& e) {
        auto const* const name = e.Attribute("name");
        auto const* const of = e.Parent() == nullptr ? nullptr : e.Parent()->ToElement();
        auto const words =
            "<" + e.ValueStr() + (name == nullptr ? "" : " " + in_quotes(name)) + ">";
        return of == nullptr || of->ValueStr() == "robot" ? words : words + " of " + about(*of);
    }
    void require_numbers(TiXmlAttribute const& a, int line, std::string const& words) const {
        static std::set<std::string> const texts{"name", "version", "xmlns",
                                                 "type", "link",    "joint"};
        std::string const key = a.Name();
        if (texts.contains(key) || key.starts_with("xmlns:")) return;
        std::istringstream all(a.Value());
        std::size_t count = 0;
        for (std::string word; all >> word; ++count) {
            auto const value = exact_decimal::parse(word);
            auto const x = value ? nearest(*value) : std::nullopt;
            bool const far = key != "effort" && key != "velocity" && key != "lower" &&
                             key != "upper" && x && std::abs(*x) > farthest;
            if (!x || far)
                fail(line,
                     in_quotes(word) + " in " + key + " of " + words +
                         (x ? " is beyond 1e6" : " is no decimal number"),
                     "write numbers in m, kg and rad");
        }
        if (count != (key == "xyz" || key == "rpy" ? 3u : 1u))
            fail(line, key + " of " + words + " has " + std::to_string(count) + " numbers",
                 key == "xyz" || key == "rpy" ? "write three" : "write one");
    }
    /// Each link hangs on one joint at most.
    void require_open(TiXmlElement const& root) const {
        std::map<std::string, std::string> joint_of;
        for (auto const* j = root.FirstChildElement("joint"); j != nullptr;
             j = j->NextSiblingElement("joint")) {
            auto const* const child = j->FirstChildElement("child");
            auto const* const link = child == nullptr ? nullptr : child->Attribute("link");
            auto const* const name = j->Attribute("name");
            if (link == nullptr || name == nullptr) continue; // liburdfdom says so
            auto const [at, is_new] = joint_of.emplace(link, name);
            if (!is_new)
                fail(j->Row(),
                     "the link " + in_quotes(link) + " is the child of two joints, " +
                         in_quotes(at->second) + " and " + in_quotes(name) + ": a closed chain",
                     "cut it: only open chains can be written");
        }
    }
    [[nodiscard]] urdf::ModelInterfaceSharedPtr parsed(std::string const& text) const {
        urdf_words const words;
        urdf::ModelInterfaceSharedPtr model;
        std::string problem;
        try {
            model = urdf::parseURDF(text);
        } catch (std::exception const& e) {
            problem = e.what();
        }
        if (!model || !model->getRoot())
            fail(0, "liburdfdom cannot read it: " + (problem.empty() ? words.first() : problem),
                 "correct it: check_urdf shows more");
        return model;
    }

    static placement placement_of(urdf::Pose const& p) {
        placement result;
        result.origin = {p.position.x, p.position.y, p.position.z};
        auto const& q = p.rotation;
        double const n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, s = 2 / n;
        result.turn = {{{1 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y - q.z * q.w),
                         s * (q.x * q.z + q.y * q.w)},
                        {s * (q.x * q.y + q.z * q.w), 1 - s * (q.x * q.x + q.z * q.z),
                         s * (q.y * q.z - q.x * q.w)},
                        {s * (q.x * q.z - q.y * q.w), s * (q.y * q.z + q.x * q.w),
                         1 - s * (q.x * q.x + q.y * q.y)}}};
        return result;
    }
    /// That of an element, right angles being exact.
    [[nodiscard]] placement placed(urdf::Pose const& pose, std::string const& what) {
        auto result = placement_of(pose);
        if (result.take_right_angles())
            result_.notes.push_back("decided: rpy of " + what + " is of right angles, rounded");
        return result;
    }

    /// A link that moves with a body, or with the base, and all behind it.
    void add_link(urdf::Link const& link, std::size_t body, placement const& at) {
        ++links_;
        if (link.inertial && body != body_joint::base) {
            auto const& i = *link.inertial;
            link_inertia const own{link.name, i.mass, {i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz}};
            require_physical(own, file_);
            add_inertia(result_.joints[body].inertial, own,
                        at.then(placed(i.origin, "the link " + in_quotes(link.name))));
        }
        for (auto const& joint : link.child_joints) {
            auto const place = at.then(placed(joint->parent_to_joint_origin_transform,
                                              "the joint " + in_quotes(joint->name)));
            auto const& child = *model_->getLink(joint->child_link_name);
            if (joint->type == urdf::Joint::FIXED || options_.fixed.contains(joint->name))
                add_link(child, body, place);
            else
                add_joint(*joint, child, body, place);
        }
    }
    void require_plain(urdf::Joint const& joint) const {
        auto const words = "the joint " + in_quotes(joint.name) + " ";
        auto const fix = "or let it be fixed: --fix " + joint.name;
        if (joint.mimic)
            fail(
                0, words + "mimics " + in_quotes(joint.mimic->joint_name),
                "joints that are geared together cannot be written; write the equations by hand, " +
                    fix);
        if (joint.type != urdf::Joint::REVOLUTE && joint.type != urdf::Joint::CONTINUOUS &&
            joint.type != urdf::Joint::PRISMATIC)
            fail(0, words + (joint.type == urdf::Joint::PLANAR ? "is planar" : "is floating"),
                 "write it as joints that are revolute or prismatic, " + fix);
        if (result_.joints.size() == most_joints)
            fail(0, words + "is the eighth that moves",
                 "leave at most 7 free: --fix " + joint.name);
        if (joint.limits && joint.type != urdf::Joint::CONTINUOUS &&
            !(joint.limits->lower < joint.limits->upper))
            fail(0, words + "has limits that leave it no motion",
                 "correct lower and upper, " + fix);
        if (joint.dynamics && (joint.dynamics->damping < 0 || joint.dynamics->friction < 0))
            fail(0, words + "has negative damping or friction", "correct <dynamics>");
    }
    void add_joint(urdf::Joint const& joint, urdf::Link const& child, std::size_t parent,
                   placement const& at) {
        require_plain(joint);
        described_joint j;
        j.name = joint.name;
        j.link = child.name;
        j.joint.parent = parent;
        j.joint.slides = joint.type == urdf::Joint::PRISMATIC;
        auto const own = turned_to_axis(joint, j);
        auto const frame = at.then(own);
        j.joint.turn = frame.turn;
        j.origin = frame.origin;
        for (auto& x : j.origin) x = std::abs(x) < 1e-15 ? 0 : with_digits(x, 15);
        if (joint.limits && joint.type != urdf::Joint::CONTINUOUS)
            j.range = {joint.limits->lower, joint.limits->upper};
        if (joint.limits && joint.limits->velocity > 0) j.fastest = joint.limits->velocity;
        if (joint.limits && joint.limits->effort > 0) j.strongest = joint.limits->effort;
        if (joint.dynamics) j.damping = joint.dynamics->damping;
        if (joint.dynamics) j.friction = joint.dynamics->friction;
        result_.joints.push_back(j);
        placement back; // the link, seen from the body's frame
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i) back.turn[k][i] = own.turn[i][k];
        add_link(child, result_.joints.size() - 1, back);
    }
    /// The frame in the joint one of whose axes is the joint's.
    [[nodiscard]] placement turned_to_axis(urdf::Joint const& joint, described_joint& j) const {
        std::array<double, 3> a{joint.axis.x, joint.axis.y, joint.axis.z};
        double const size = std::hypot(a[0], a[1], a[2]);
        if (!(size > 0))
            fail(0, "the axis of the joint " + in_quotes(joint.name) + " is 0",
                 "write it as in <axis xyz=\"0 0 1\"/>");
        for (auto& x : a) x /= size;
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(a[k]) == 1) {
                j.joint.axis = k;
                j.joint.sense = a[k];
                return {};
            }
        j.turned = true; // z along the axis, x level with the two shortest parts of it
        std::size_t least = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (std::abs(a[k]) < std::abs(a[least])) least = k;
        std::array<double, 3> x{-a[least] * a[0], -a[least] * a[1], -a[least] * a[2]};
        x[least] += 1;
        double const length = std::hypot(x[0], x[1], x[2]);
        for (auto& v : x) v /= length;
        placement result;
        for (std::size_t k = 0; k < 3; ++k) {
            auto const u = (k + 1) % 3, v = (k + 2) % 3;
            result.turn[k] = {x[k], a[u] * x[v] - a[v] * x[u], a[k]};
        }
        return result;
    }

    std::string file_, text_;
    urdf_options const& options_;
    described_robot result_;
    urdf::ModelInterfaceSharedPtr model_;
    std::set<std::string> dropped_;
    std::size_t links_ = 0; ///< that are reached from the root
};

/// TinyXML descends by recursion: what is nested without end would end the program.
inline void require_shallow(std::string const& file, std::string const& text) {
    int depth = 0;
    for (auto at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
        if (text.compare(at, 4, "<!--") == 0) {
            at = std::min(text.find("-->", at), text.size());
        } else if (text.compare(at, 2, "</") == 0) {
            --depth;
        } else if (auto const end = text.find('>', at); end == text.npos || text[end - 1] != '/') {
            ++depth;
        }
        if (depth > 100)
            throw input_error({.file = file}, "elements are nested more than 100 deep",
                              "a description of a robot is not");
    }
}

} // namespace importing_detail

/// The robot that a URDF file describes: an open chain, or tree, of up to 7 joints that turn or
/// slide; links that are joined fixedly are one body. Nothing is left out in silence.
/// @throws input_error  naming the element, for all that has no place in such a model, and for
///         masses and moments of inertia that no body has
[[nodiscard]] inline described_robot read_urdf(std::filesystem::path const& file,
                                               urdf_options const& options = {}) {
    auto const text = read_text(file);
    auto const name = file.string();
    if (text.size() > 10'000'000)
        throw input_error({.file = name}, "larger than 10 MB", "check the path");
    importing_detail::require_shallow(name, text);
    return importing_detail::urdf_reader(name, text, options).read();
}

} // namespace sivid

#endif
