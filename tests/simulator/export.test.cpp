// SPDX-License-Identifier: MIT
// export: which bytes change, which numbers are written, what is refused.
#include "simulator/pendulum.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace simulator_test;
using Catch::Matchers::Contains;

/// A pendulum with damping 0.012 and 0.004 kg m^2 of rotor, identified.
class identified : public bench {
public:
    identified() {
        record(swing(0.012, 0.004, 0.002), 0.0021);
        auto const found =
            run({"identify", at("data"), "--out", at("out"), "--quiet", "--budget", "2"});
        CAPTURE(found.out, found.err);
        REQUIRE(found.code == 0);
    }
    [[nodiscard]] nlohmann::json json(std::string const& name) const {
        return nlohmann::json::parse(folder.read(name));
    }
    void refused(app_test::finished const& r, int code, std::string const& words) const {
        CAPTURE(r.out, r.err);
        CHECK(r.code == code);
        CHECK_THAT(r.err, Contains(words));
        CHECK_FALSE(fs::exists(folder.path() / "new.xml"));
        CHECK_FALSE(fs::exists(folder.path() / "new.xml.note.txt"));
    }
    /// The mapping has one entry, for the joint's damping but for what is told.
    void map_entry(std::string const& entry) const {
        folder.write("map.json", R"({"format": "sivid-export-1", "attributes": [)" + entry + "]}");
    }
};

/// Without what `export` joins and writes.
std::string without(std::string text, std::string const& from, std::string const& to) {
    auto const begin = text.find(from);
    REQUIRE(begin != text.npos);
    auto const end = text.find(to, begin + from.size());
    REQUIRE(end != text.npos);
    return text.erase(begin, end + to.size() - begin);
}

} // namespace

TEST_CASE("the attributes concerned change, and no other byte of the file") {
    identified const b;
    auto const r = b.write();
    CAPTURE(r.out, r.err);
    REQUIRE(r.code == 0);
    auto const text = b.folder.read("new.xml");
    auto const point = b.json("out/result.json")["witness"]["parameters"];
    double const damping = point["Fv"];
    CHECK_THAT(text, Contains("damping='" + sivid::nearest_text(damping) + "' armature=\"") &&
                         Contains("<!-- sivid: damping " + sivid::nearest_text(damping) +
                                  " N m s/rad of Fv, proved within [0.01"));
    auto rest = without(text, " <!-- sivid:", "-->");
    rest = without(rest, " armature=\"", "\"");
    rest.replace(rest.find("damping='"), 9 + sivid::nearest_text(damping).size(), "damping='0");
    CHECK(rest == file);

    SECTION("what is written is proved, and what is not said there is in the note") {
        auto const ranges = b.json("new.xml.ranges.json");
        auto const& first = ranges["attributes"][0];
        CHECK(first["joint"] == "elbow");
        CHECK(first["value"][0] == damping);
        CHECK(first["exact"] == true);
        auto const hull = b.json("out/result.json")["parameters"]["Fv"]["hull"];
        CHECK(first["range"][0][0] <= hull[0]);
        CHECK(first["range"][0][1] >= hull[1]);
        CHECK(first["range"][0][0] <= 0.012);
        CHECK(first["range"][0][1] >= 0.012);
        CHECK(ranges["attributes"][1]["exact"] == false); // rotor*ratio^2 is rounded
        CHECK(ranges["attributes"][1]["range"][0][0] <= 0.004);
        CHECK(ranges["attributes"][1]["range"][0][1] >= 0.004);
        CHECK_THAT(ranges["warning"].get<std::string>(), Contains("larger than the set"));
        CHECK(ranges["constants"].size() == 5);
        auto const note = b.folder.read("new.xml.note.txt");
        CHECK_THAT(note, Contains("; rounded from [0.004") && Contains("it rests on"));
        CHECK(r.out == note + "written: " + b.at("new.xml") + "\n");
    }
    SECTION("once more into what was written gives the same") {
        b.folder.write("arm.xml", text);
        REQUIRE(b.write().code == 0);
        CHECK(b.folder.read("new.xml") == text);
    }
    SECTION("a file with a mark of UTF-8, and with ends of lines of Windows") {
        std::string other = "\xEF\xBB\xBF";
        for (char c : file) other += c == '\n' ? std::string("\r\n") : std::string(1, c);
        b.folder.write("arm.xml", other);
        REQUIRE(b.write().code == 0);
        std::string expected = "\xEF\xBB\xBF";
        for (char c : text) expected += c == '\n' ? std::string("\r\n") : std::string(1, c);
        CHECK(b.folder.read("new.xml") == expected);
    }
}

TEST_CASE("several numbers, one of several, units, and what a format cannot say") {
    identified const b;
    b.map_entry(R"({"actuator": "m", "attribute": "gear", "value": "ratio", "part": 1},
      {"actuator": "m", "attribute": "forcerange", "value": ["-weight", "weight"], "unit": "N m"},
      {"body": "link", "attribute": "diaginertia", "value": ["inertia", "inertia", "rotor"]},
      {"joint": "elbow", "attribute": "damping", "value": "Fv", "file_unit": "mN m s"},
      {"joint": "elbow", "attribute": "delay", "value": "weight"})");
    auto const r = b.write();
    CAPTURE(r.out, r.err);
    REQUIRE(r.code == 0);
    auto const text = b.folder.read("new.xml");
    double const damping = b.json("out/result.json")["witness"]["parameters"]["Fv"];
    CHECK_THAT(text, Contains("gear=\"10 0 0\"") && Contains("forcerange=\"-0.981 0.981\"") &&
                         Contains("mass=\"0.5\" diaginertia=\"0.022 0.022 4"));
    auto const written = text.substr(text.find("damping='") + 9);
    CHECK(std::abs(std::stod(written) - 1000 * damping) <= 4e-15);
    CHECK_THAT(r.out, Contains("not written, mjcf cannot say it: joint elbow delay 0.981 N m") &&
                          Contains("actuator m: gear (1) 10 1 of ratio"));
}

TEST_CASE("URDF: elements within, one that is made, and no other byte") {
    identified const b;
    std::string const urdf =
        "<?xml version='1.0'?>\n<robot name=\"arm\">\n"
        "\t<link name='link'><inertial><mass value = \"0.5\"/>\n"
        "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
        "</link>\n  <joint name=\"elbow\" type=\"continuous\">\n"
        "    <parent link='base'/><limit effort='1' velocity='2'/>\n  </joint>\n"
        "  <transmission><joint name='elbow'/></transmission>\n</robot>\n";
    b.folder.write("arm.urdf", urdf);
    b.map_entry(R"({"joint": "elbow", "attribute": "damping", "value": "Fv"},
      {"joint": "elbow", "attribute": "friction", "value": "weight"},
      {"joint": "elbow", "attribute": "effort", "value": "2*weight", "unit": "N m"},
      {"link": "link", "attribute": "iyy", "value": "inertia"},
      {"joint": "elbow", "attribute": "armature", "value": "rotor"})");
    auto const r = b.run({"export", b.at("out"), "--to", "urdf", "--into", b.at("arm.urdf"),
                          "--map", b.at("map.json"), "--out", b.at("new.urdf")});
    CAPTURE(r.out, r.err);
    REQUIRE(r.code == 0);
    auto text = b.folder.read("new.urdf");
    CHECK_THAT(text, Contains("\">\n    <dynamics damping=\"0.012") &&
                         Contains("friction=\"0.981\"/> <!-- sivid: damping") &&
                         Contains("<limit effort='1.962' velocity='2'/> <!-- sivid: effort") &&
                         Contains("iyy='0.022' iyz='0'"));
    CHECK_THAT(r.out, Contains("urdf cannot say it: joint elbow armature"));
    for (int k = 0; k < 3; ++k) text = without(text, " <!-- sivid:", "-->");
    text = without(text, "\n    <dynamics", "/>");
    text.replace(text.find("1.962"), 5, "1").replace(text.find("0.022"), 5, "1");
    CHECK(text == urdf);
}

TEST_CASE("a table, and the arguments of actuators of Isaac Lab") {
    identified const b;
    auto r = b.run({"export", b.at("out"), "--to", "json", "--out", b.at("table.json")});
    CAPTURE(r.out, r.err);
    REQUIRE(r.code == 0);
    auto const table = b.json("table.json");
    CHECK(table["format"] == "sivid-ranges-1");
    CHECK(table["constants"]["Fv"]["unit"] == "N m s");
    CHECK(table["constants"]["Fv"]["value"] ==
          b.json("out/result.json")["witness"]["parameters"]["Fv"]);
    CHECK(table["attributes"].empty());
    b.map_entry(R"({"joint": "el.bow", "attribute": "damping", "value": "Fv"},
      {"joint": "el.bow", "attribute": "delay", "value": "Fv/weight", "unit": "s",
       "step": 0.005})");
    r = b.run({"export", b.at("out"), "--to", "isaaclab", "--map", b.at("map.json"), "--out",
               b.at("arm.json")});
    CAPTURE(r.out, r.err);
    REQUIRE(r.code == 0);
    auto const told = b.json("arm.json");
    auto const settings = told["actuators"]["el.bow"];
    CHECK(settings["joint_names_expr"][0] == "el\\.bow");
    CHECK(settings["damping"] == table["constants"]["Fv"]["value"]);
    CHECK(settings["min_delay"] == 2); // 0.0122 s
    CHECK(settings["max_delay"] == 2);
    CHECK(told["attributes"][1]["range"][0] == nlohmann::json::parse("[2, 3]"));
    CHECK(told["attributes"][1]["unit"] == "steps of 0.005 s");
}

TEST_CASE(
    "a delay that a diagnosis finds goes into the note, in steps where the simulator has such") {
    std::string late{incomplete};
    late += "[effect.late]\nkind = \"sensor_latency\"\nof = \"q\"\nprior = \"[0, 0.1] s\"\n";
    bench const b(late);
    auto readings = swing(0, 0, 0.002, 0.02);
    b.record(readings, 0.0021, R"("weight": {"prior": [0.97, 0.99], "unit": "N m"})");
    auto const found = b.run({"diagnose", b.at("data"), "--out", b.at("out"), "--quiet", "--budget",
                              "6", "--threads", "1"});
    CAPTURE(found.out, found.err);
    REQUIRE(found.code == 0);
    b.folder.write("map.json", R"json({"format": "sivid-export-1", "attributes": [
      {"body": "link", "attribute": "mass", "value": "weight/(9.81*0.2)", "unit": "kg"},
      {"joint": "elbow", "attribute": "delay", "value": "late.tau", "step": 0.002}]})json");
    auto const r = b.write();
    CAPTURE(r.out, r.err);
    REQUIRE(r.code == 0);
    CHECK_THAT(r.out, Contains("effect: late") &&
                          Contains("mjcf cannot say it: joint elbow delay 10 steps of 0.002 s of "
                                   "late.tau, proved within [9, 11]") &&
                          Contains("it rests on: delayed times are rounded"));
    CHECK_THAT(b.folder.read("new.xml"), Contains("mass=\"0.499"));

    auto const stored = nlohmann::json::parse(b.folder.read("out/diagnosis.json"));
    auto const forge = [&](int code, std::string const& words, auto const& change) {
        auto other = stored;
        change(other);
        b.folder.write("out/diagnosis.json", other.dump());
        auto const forged = b.write("out", "forged.xml");
        CAPTURE(forged.out, forged.err);
        CHECK(forged.code == code);
        CHECK_THAT(forged.err, Contains(words));
        CHECK_FALSE(fs::exists(b.at("forged.xml")));
    };
    using nlohmann::json;
    forge(3, "the answer is open", [](json& j) { j["answer"]["kind"] = "open"; });
    forge(3, "the answer is unexplained", [](json& j) { j["answer"]["kind"] = "unexplained"; });
    forge(3, "nothing is proved", [](json& j) { j["answer"]["kind"] = "none"; });
    forge(3, "nothing is proved", [](json& j) { j["causes"][0]["verdict"] = "undecided"; });
    forge(5, "not what its data prove",
          [](json& j) { j["causes"][0]["witness"]["parameters"]["late.tau"] = 0.05; });
    forge(5, "no point of the prior",
          [](json& j) { j["causes"][0]["witness"]["parameters"].erase("late.tau"); });
    forge(5, "outside its ranges", [](json& j) {
        j["answer"]["constants"]["weight"]["hull"] = {0.97, 0.971};
    });
    forge(2, "another model", [](json& j) { j["problem"] = std::string(64, 'a'); });
}

TEST_CASE("what is not proved is not written, with the exit code of the result") {
    identified const b;
    auto stored = b.json("out/result.json");
    auto const forge = [&](auto const& change) {
        auto other = stored;
        change(other);
        b.folder.write("out/result.json", other.dump());
        return b.write();
    };
    using nlohmann::json;
    b.refused(forge([](json& j) { j["verdict"] = "undecided"; }), 3, "no parameter is proved");
    b.refused(forge([](json& j) { j["verdict"] = "inconsistent"; }), 4, "diagnose");
    b.refused(forge([](json& j) { j["witness"]["parameters"]["Fv"] = 0.03; }), 5,
              "not what its data prove");
    b.refused(forge([](json& j) { j["witness"]["parameters"]["Fv"] = 0.012008; }), 5,
              "not what its data prove"); // hardly beyond
    b.refused(forge([](json& j) { j["witness"]["initial"]["swing"]["q"] = 0.81; }), 5,
              "no point of the prior and the starts");
    b.refused(forge([](json& j) { j["witness"]["parameters"]["Fv"] = -0.01; }), 5,
              "no point of the prior");
    b.refused(forge([](json& j) {
                  j["parameters"]["Fv"]["hull"] = {0.0119, 0.01195};
              }),
              5, "outside its ranges");
    b.refused(forge([](json& j) { j["problem"] = std::string(64, '0'); }), 2, "another model");
    b.refused(forge([](json& j) { j.erase("source"); }), 2, "--dataset");
    b.refused(forge([](json& j) { j["witness"]["parameters"].erase("Fv"); }), 5,
              "no point of the prior");
    SECTION("a box that is proved inside holds a member, too") {
        auto const r = forge([](json& j) { j["witness"] = nullptr; });
        CAPTURE(r.out, r.err);
        CHECK(r.code == 0);
    }
    SECTION("other data") {
        b.folder.write("out/result.json", stored.dump());
        b.record(swing(0.012, 0.004, 0.001), 0.0021);
        b.refused(b.write(), 2, "not the data set of the result");
    }
    SECTION("no result") { b.refused(b.write("nowhere"), 2, "result.json"); }
}

TEST_CASE("files that are asked for wrongly, and in place of what is read") {
    identified const b;
    b.refused(b.write("out", "arm.xml"), 2, "is read: name another file");
    CHECK(b.folder.read("arm.xml") == file);
    b.refused(b.write("out", "out/result.json"), 2, "is read");
    b.refused(b.write("out", "out/boxes.csv"), 2, "is read");
    fs::create_hard_link(b.at("arm.xml"), b.at("link.xml"));
    b.refused(b.write("out", "link.xml"), 2, "is read");
    b.refused(b.write("out", "data"), 2, "a folder has this name");
    auto const with = [&](std::vector<std::string> const& more) {
        std::vector<std::string> words{"export", b.at("out"), "--out", b.at("new.xml")};
        words.insert(words.end(), more.begin(), more.end());
        return b.run(words);
    };
    b.refused(with({"--to", "mjcf", "--map", b.at("map.json")}), 2, "needs --into");
    b.refused(with({"--to", "mjcf", "--into", b.at("arm.xml")}), 2, "needs --map");
    b.refused(with({"--to", "json", "--into", b.at("arm.xml")}), 2, "has no file to change");
    b.refused(with({"--to", "sdf", "--into", b.at("arm.xml")}), 2, "not in {");
    b.refused(with({"--to", "urdf", "--into", b.at("arm.xml"), "--map", b.at("map.json")}), 2,
              "the root is <mujoco>");
}
