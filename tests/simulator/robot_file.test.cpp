// SPDX-License-Identifier: MIT
// Odd and broken files of robots and mappings: what is said of them.
#include "io/support.hpp"

#include <sivid/io/simulator/robot_file.hpp>
#include <sivid/io/simulator/xml_reader.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace sivid;
using Catch::Matchers::Contains;

class desk {
public:
    [[nodiscard]] xml_document read(std::string_view text) const {
        folder_.write("arm.xml", text);
        return read_xml(folder_.path() / "arm.xml");
    }
    [[nodiscard]] std::vector<export_entry> mapped(std::string const& entries,
                                                   export_format f = export_format::mjcf) const {
        folder_.write("map.json",
                      R"({"format": "sivid-export-1", "attributes": [)" + entries + "]}");
        return read_export_mapping(folder_.path() / "map.json", f);
    }
    /// The file with all entries at "1 1 ..", or what is said of it.
    [[nodiscard]] std::string changed(std::string_view text, std::string const& entries,
                                      export_format f = export_format::mjcf) const {
        try {
            auto const map = mapped(entries, f);
            std::vector<robot_change> changes;
            for (auto const& e : map)
                if (e.rule != nullptr) {
                    std::string numbers = "7";
                    for (std::size_t k = 1; k < e.values.size(); ++k) numbers += " 7";
                    changes.push_back({&e, numbers, "why - - - --not-->"});
                }
            return changed_robot_file(read(text), changes).text;
        } catch (input_error const& e) {
            return e.what();
        }
    }

private:
    io_support::temporary_folder folder_;
};

std::string joint(std::string const& attributes, std::string const& more = "") {
    return "<mujoco>\n<worldbody><body name='b'>\n<joint " + attributes + "/></body></worldbody>" +
           more + "</mujoco>";
}
std::string const damping = R"({"joint": "j", "attribute": "damping", "value": "c"})";

} // namespace

TEST_CASE("broken and foreign XML is told with its line") {
    desk const d;
    auto const says = [&](std::string_view text, std::string const& words) {
        CAPTURE(text, words);
        CHECK_THAT(d.changed(text, damping), Contains(words));
    };
    says("", "no element found");
    says("<mujoco>\n<worldbody>", "line 2: no well-formed XML");
    says(joint("name='j' damping='1' damping='2'"), "line 3: no well-formed XML: duplicate");
    says(joint("name='&who;'"), "line 3: no well-formed XML: undefined entity");
    says("<!DOCTYPE x [<!ENTITY a 'b'>]>\n<mujoco/>", "line 1: <!DOCTYPE>");
    says(std::string("\xFF\xFE<\0m\0", 6), "UTF-16");
    says(std::string("<\0m\0/\0>\0", 8), "UTF-16");
    says("<sdf/>", "line 1: the root is <sdf>");
    says("<robot/>", "give an MJCF file");
    says("{\"a\": 1}", "line 1: no well-formed XML");
    says(joint("name='j' damping='${c}'"), "line 3: damping is '${c}', no plain number");
    says("<mujoco><xacro:if/></mujoco>", "run xacro");
    std::string deep = "<mujoco>";
    for (int k = 0; k < 100'000; ++k) deep += "<a>";
    says(deep, "no well-formed XML");
    says(joint("name='j'", std::string(20'000'000, ' ')), "larger than 20 MB");
}

TEST_CASE("elements that are not there, there twice, or refer to others") {
    desk const d;
    auto const says = [&](std::string const& text, std::string const& words) {
        CAPTURE(text, words);
        CHECK_THAT(d.changed(text, damping), Contains(words));
    };
    says(joint("name='jj'"), "it has no joint 'j'; did you mean 'jj'?");
    says(joint(""), "none has a name");
    says(joint("name='j'/>\n<joint name='j'"),
         "line 4: joint 'j' is there more than once, first in line 3");
    says("<mujoco><default><joint name='j'/></default><sensor><joint name='j'/></sensor></mujoco>",
         "it has no joint 'j'");
    says("<mujoco>\n<include file='more.xml'/></mujoco>", "included file, then give that one: "
                                                          "'more.xml' in line 2");
    CHECK_THAT(d.changed(joint("name='j'"), R"({"body": "b", "attribute": "mass", "value": "m"})"),
               Contains("line 2: body 'b' has no <inertial>"));
    CHECK_THAT(d.changed("<mujoco><compiler inertiafromgeom='true'/><body name='b'><inertial/>"
                         "</body></mujoco>",
                         R"({"body": "b", "attribute": "mass", "value": "m"})"),
               Contains("takes masses from elsewhere"));
    auto const actuator = [](std::string const& gear) {
        return "<mujoco><actuator>\n<motor name='m'" + gear + "/></actuator></mujoco>";
    };
    auto const gear = R"({"actuator": "m", "attribute": "gear", "value": "N", "part": 2})";
    CHECK_THAT(d.changed(actuator(""), gear), Contains("that is not there"));
    CHECK_THAT(d.changed(actuator(" gear='3'"), gear), Contains("is not there: it has 1"));
    CHECK(d.changed(actuator(" gear=' 3\t4 5'"), gear).find("gear=' 3\t7 5'") != std::string::npos);
}

TEST_CASE("names are compared as XML means them, attributes may come from a class") {
    desk const d;
    auto const entry = R"({"joint": "a & b\u00e9", "attribute": "armature", "value": "c"})";
    auto const text = d.changed(joint("class=\"big\" name =\t'a &amp; b\xC3\xA9'  "), entry);
    CHECK_THAT(text, Contains("name =\t'a &amp; b\xC3\xA9' armature=\"7\"  /> <!-- sivid: why"));
    // A comment stays one, whatever it is told.
    CHECK_NOTHROW(static_cast<void>(d.read(text)));
    CHECK_THAT(d.changed("<mujoco><body><joint\nname='j'></joint></body></mujoco>", damping),
               Contains("<joint\nname='j' damping=\"7\"> <!-- sivid: why"));
}

TEST_CASE("mappings that ask for what is not there") {
    desk const d;
    auto const says = [&](std::string const& entries, std::string const& words,
                          export_format f = export_format::mjcf) {
        CAPTURE(entries, words);
        CHECK_THAT(d.changed(joint("name='j'"), entries, f), Contains(words));
    };
    says("", "/attributes: no attributes");
    says(R"({"attribute": "damping", "value": "c"})", "/attributes/0: it names no element");
    says(R"({"joint": "j", "body": "b", "attribute": "damping", "value": "c"})", "two elements");
    says(R"({"joint": "j", "attribute": "friction", "value": "c"})",
         "has no 'friction' of a joint; it has: joint damping, joint frictionloss");
    says(R"({"joint": "j", "attribute": "frictionloss", "value": "c"})", "joint friction",
         export_format::urdf);
    says(damping + "," + damping, "/attributes/1: joint j: damping is given twice");
    says(R"({"joint": "j", "attribute": "damping", "value": ["a", "b"]})", "1 numbers, 2 values");
    says(R"({"joint": "j", "attribute": "damping", "value": "c", "unit": "N^x"})", "no unit");
    says(R"({"joint": "j", "attribute": "damping", "value": "c", "way": 1})", "way");
    says(R"({"joint": "j", "attribute": "delay", "value": "c"})", "a delay has a \"step\"",
         export_format::isaaclab);
    CHECK(d.mapped(R"({"joint": "j", "attribute": "delay", "value": "c"})").front().rule ==
          nullptr);
}

TEST_CASE("a file cut anywhere, or spoilt anywhere, is read whole or refused") {
    desk const d;
    auto const whole = joint("name='j' damping='1'", "<!-- <joint name='j'> -->");
    for (std::size_t k = 0; k < whole.size(); ++k)
        CHECK_THROWS_AS(d.read(std::string_view{whole}.substr(0, k)), input_error);
    std::mt19937 random(7);
    int read = 0;
    for (int k = 0; k < 300; ++k) {
        auto text = whole;
        text[random() % text.size()] = static_cast<char>(random() % 256);
        try {
            auto const doc = d.read(text);
            ++read;
            for (auto const& e : doc.elements)
                for (auto const& a : e.attributes)
                    CHECK((e.begin < a.begin && a.end < e.end && e.end <= text.size()));
        } catch (input_error const&) {
        }
    }
    CHECK(read > 20);
}
