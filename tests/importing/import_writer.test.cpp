// SPDX-License-Identifier: MIT
#include <sivid/importing/import_writer.hpp>

#include "io/import_support.hpp"

#include <nlohmann/json.hpp>

#include <map>

using namespace sivid;
using namespace io_support;

namespace {
std::size_t entries(fs::path const& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator{folder}, fs::directory_iterator{}));
}
imported_dataset example(std::string const& name) {
    return import_dataset(read_import_mapping(std::string{SIVID_SOURCE_DIR} + "/examples/import/" +
                                              name + "/mapping.json"));
}
} // namespace

TEST_CASE("an import is written with its protocol, and nothing is left beside it") {
    temporary_folder const folder;
    folder.write("mapping.json", csv_mapping);
    folder.write("a.csv", small_table);
    auto const r = import_in(folder);
    CHECK(folder.read("out/A.measurements.csv") ==
          "t,h,h_err\n0,1,0.02\n0.1,1.01,0.02\n0.3,1.035,0.02\n");
    CHECK(folder.read("out/A.inputs.csv") == "t,u\n0,1.5\n0.1,1.5\n0.2,2.5\n0.3,2.5\n");
    CHECK(folder.read("out/import.txt") == r.protocol.text());
    CHECK(nlohmann::json::parse(folder.read("out/import.json"))["dataset"] == "small");
    CHECK(entries(folder.path()) == 3);
    CHECK(entries(folder.path() / "out") == 5);
    // Again, over the old one and with a slash at the end.
    write_import(r, folder.path() / "out/");
    CHECK(entries(folder.path() / "out") == 5);
    CHECK(entries(folder.path()) == 3);
    // In a folder that is not there yet.
    write_import(r, folder.path() / "new" / "deeper");
    CHECK(entries(folder.path() / "new") == 1);
}

TEST_CASE("what cannot be written leaves nothing") {
    temporary_folder const folder;
    folder.write("mapping.json", csv_mapping);
    folder.write("a.csv", small_table);
    folder.write("file", "x");
    auto const r = import_dataset(read_import_mapping(folder.path() / "mapping.json"));
    CHECK_THROWS_AS(write_import(r, folder.path() / "file" / "out"), output_error);
    CHECK_THROWS_AS(write_import(r, folder.path() / "file"), output_error);
    CHECK(entries(folder.path()) == 3);
    CHECK(folder.read("file") == "x");
    // What the reader would refuse is not written.
    auto broken = r;
    broken.data.scenarios[0].role = scenario_role::holdout;
    CHECK_THROWS_AS(write_import(broken, folder.path() / "out"), std::logic_error);
    CHECK(entries(folder.path()) == 3);
    // Nor is what is not of the model.
    auto model = r.names;
    model.channels[0].name = "height";
    try {
        write_import(r, folder.path() / "out", &model);
        FAIL("a channel that the model does not have");
    } catch (input_error const& e) {
        CHECK(std::string{e.what()} ==
              "mapping.json: what it makes is not of the model: "
              "unknown channel 'h'; the model has: height");
    }
    CHECK(entries(folder.path()) == 3);
    write_import(r, folder.path() / "out", &r.names);
    CHECK(entries(folder.path()) == 4);
}

TEST_CASE("an import that fails while it replaces another leaves the other whole") {
    temporary_folder const folder;
    folder.write("mapping.json", csv_mapping);
    folder.write("a.csv", small_table);
    auto const old = import_in(folder);
    folder.write("a.csv", "time,pump,level,bound\n0,7,700,1\n300,7,701,1\n");
    auto const next = import_dataset(read_import_mapping(folder.path() / "mapping.json"));
    auto const files = {"dataset.json", "A.inputs.csv", "A.measurements.csv", "import.txt",
                        "import.json"};
    for (std::string const blocked : files) {
        CAPTURE(blocked);
        write_import(old, folder.path() / "out");
        std::map<std::string, std::string> before;
        for (std::string const file : files) before[file] = folder.read("out/" + file);
        fs::remove(folder.path() / "out" / blocked);
        fs::create_directory(folder.path() / "out" / blocked);
        CHECK_THROWS_AS(write_import(next, folder.path() / "out"), output_error);
        fs::remove(folder.path() / "out" / blocked);
        for (std::string const file : files)
            if (file != blocked) CHECK(folder.read("out/" + file) == before[file]);
        CHECK(entries(folder.path() / "out") == 4);
        CHECK(entries(folder.path()) == 3);
    }
}

TEST_CASE("the worked example of a data logger") {
    auto const r = example("german_logger");
    auto const& s = r.data.scenarios.at(0);
    CHECK(s.name == "steps");
    CHECK(s.duration == 1.9);
    CHECK(s.measurements.size() == 378);
    CHECK(noted(r.protocol, "no reading") == std::vector<std::size_t>{125, 126, 255});
    CHECK(noted(r.protocol, "skipped") == std::vector<std::size_t>{1, 2, 4});
    // The readings are on a grid of 0.5 rpm, with up to 1.2 rpm of noise.
    auto const& all = r.protocol.bounds.back().candidates; // of the speed
    CHECK(all.front().from == "step");
    CHECK_THAT(all.front().bound, WithinRel(0.25 * 0.10471975511966, 1e-6));
    CHECK(all.back().from == "neighbours");
    CHECK(all.back().bound > 1.45 * 0.1047);
    temporary_folder const folder;
    write_import(r, folder.path() / "out");
    CHECK(read_dataset(folder.path() / "out", r.names).scenarios.size() == 1);
}

TEST_CASE("the worked example of a serial stream") {
    auto const r = example("serial_stream");
    REQUIRE(r.data.scenarios.size() == 2);
    CHECK(r.data.scenarios[0].duration == 3.99); // through the wrap of the clock
    CHECK(r.data.scenarios[1].duration == 1.49);
    auto const& p = r.protocol;
    CHECK(noted(p, "not as many cells") == std::vector<std::size_t>{1, 43, 80, 374});
    CHECK(noted(p, "repeats the line") == std::vector<std::size_t>{224});
    CHECK(noted(p, "counter wraps from 65530 to 4") == std::vector<std::size_t>{157});
    CHECK(noted(p, "gap from 454 to 764 ms: the inputs") == std::vector<std::size_t>{203});
    CHECK(noted(p, "does not go on from it alone") == std::vector<std::size_t>{294});
    CHECK(noted(p, "restart: time goes from 2454 back to 120 ms: a new") ==
          std::vector<std::size_t>{376});
    CHECK(noted(p, "possible range") == std::vector<std::size_t>{274});
    CHECK(noted(p, "may be cut") == std::vector<std::size_t>{526});
    // The encoder is followed through its end: 65000 + 4000 sin(1.3 t) counts.
    double largest = 0;
    for (auto const& m : r.data.scenarios[0].measurements)
        if (m.channel == 1) largest = std::max(largest, upper(m.bound));
    CHECK_THAT(largest, WithinAbs(69000 * 0.001533980787885641, 0.01));
    temporary_folder const folder;
    write_import(r, folder.path() / "out");
    CHECK(read_dataset(folder.path() / "out", r.names).scenarios.size() == 2);
}

TEST_CASE("the worked example of two loggers") {
    auto const r = example("two_loggers");
    auto const& s = r.data.scenarios.at(0);
    CHECK(s.duration == 3);
    CHECK(s.measurements.size() == 151 + 300);
    // The clock of the second one was drawn with -103.2371 s and 0.00012.
    CHECK(has_note(r.protocol, "its clock: -103.23487101032 s are added"));
    CHECK(has_note(r.protocol, "off by 0.00535 s at most"));
    auto const text = r.protocol.text();
    CHECK_THAT(text, ContainsSubstring("  dropped: imu.csv: w: outside [0, duration]"));
    CHECK_THAT(text, !ContainsSubstring("became no scenario"));
}

TEST_CASE("docs/importing.md quotes what the examples give") {
    std::string const root{SIVID_SOURCE_DIR};
    auto const page = read_text(root + "/docs/importing.md");
    std::string shown, files;
    for (auto const* name : {"german_logger", "serial_stream"}) {
        shown += example(name).protocol.text();
        for (auto const* file : {"/mapping.json", "/motor.csv", "/pendulum.log"})
            if (auto const path = root + "/examples/import/" + name + file; fs::exists(path))
                files += read_text(path);
    }
    std::size_t quoted = 0;
    for (auto const& line : lines_of(page)) {
        for (auto const* head :
             {"  dropped: ", "  changed: ", "  decided: ", "  assumed: ", "scenario "})
            if (line.text.starts_with(head)) {
                CAPTURE(line.text);
                CHECK(shown.find(line.text) != std::string::npos);
                ++quoted;
            }
        auto const digits = std::min(line.text.find_first_not_of("0123456789"), line.text.size());
        if (digits > 3 && digits < line.text.size() &&
            (line.text[digits] == ',' || line.text[digits] == ';')) { // a line of a recorded file
            CAPTURE(line.text);
            CHECK(files.find(line.text) != std::string::npos);
            ++quoted;
        }
    }
    CHECK(quoted > 8);
    auto const arduino = read_text(root + "/examples/import/arduino/mapping.json");
    auto const windows = arduino.find("      \"windows\"");
    REQUIRE(windows != std::string::npos);
    CHECK(page.find(arduino.substr(windows, arduino.find("    }", windows) - windows)) !=
          std::string::npos);
    // The table's mapping stands there in full.
    auto const from = page.find("```json\n") + 8;
    auto const in_page = parse_json("page", page.substr(from, page.find("```\n", from) - from));
    auto const in_file = read_json(root + "/examples/import/german_logger/mapping.json");
    CHECK(in_page.at("scenarios").elements().size() == in_file.at("scenarios").elements().size());
    CHECK(in_page.at("id").string() == in_file.at("id").string());
    auto const factor = [](json_value const& j) {
        return j.at("scenarios")
            .elements()[0]
            .at("channels")
            .at("omega")
            .at("factor")
            .elements()[1]
            .number();
    };
    CHECK(factor(in_page) == factor(in_file));
}

TEST_CASE("what a mapping says of units is in the data set, and is compared with the model's") {
    temporary_folder const folder;
    std::string const mapping = R"({"format": "sivid-mapping-1", "id": "course", "model": "turn",
      "parameters": {"w": {"prior": [0, 180], "unit": "deg/s"}}, "max_outlier_fraction": 0,
      "scenarios": [{"name": "s", "file": "course.csv", "source": {"kind": "csv"},
        "time": {"column": "t", "unit": "ms", "offset": 0},
        "channels": {"psi": {"column": "heading", "unit": "deg", "error": 3}},
        "initial": "propose"}]})";
    auto const written = [&](std::string const& text) {
        folder.write("mapping.json", text);
        folder.write("course.csv", "t,heading\n0,0\n1000,90\n2000,180\n3000,270\n");
        write_import(import_dataset(read_import_mapping(folder.path() / "mapping.json")),
                     folder.path() / "out");
        return folder.read("out/dataset.json");
    };
    auto const json = written(mapping);
    CHECK_THAT(json, ContainsSubstring(R"("time_unit": "s")"));
    CHECK_THAT(json, ContainsSubstring(R"("channel_units": {"psi": "deg"})"));
    CHECK_THAT(json, ContainsSubstring(R"("psi": {"range": [-3, 3], "unit": "deg"})"));

    model_names model;
    model.name = "turn";
    model.constants = {{"w", "rad/s"}};
    model.states = model.channels = {{"psi", "rad"}};
    model.state_ranges = {{-10, 10}};
    auto const data = read_dataset(folder.path() / "out", model);
    constexpr double degree = 3.141592653589793 / 180;
    CHECK(contains(data.parameters[0].prior.enclosure, 180 * degree));
    CHECK(width(data.parameters[0].prior.enclosure) < 180.0001 * degree);
    auto const& s = data.scenarios[0];
    for (std::size_t k = 0; k < 4; ++k) {
        auto const turned = 90 * static_cast<double>(k);
        CHECK(s.measurements[k].time == static_cast<double>(k));
        CHECK_THAT(lower(s.measurements[k].bound), WithinAbs((turned - 3) * degree, 1e-14));
        CHECK_THAT(upper(s.measurements[k].bound), WithinAbs((turned + 3) * degree, 1e-14));
    }
    CHECK_THAT(upper(s.initial[0].range), WithinAbs(3 * degree, 1e-15));

    model.channels[0].unit = "m";
    CHECK_THROWS_WITH(read_dataset(folder.path() / "out", model),
                      ContainsSubstring("/channel_units/psi"));
    model.channels[0].unit = "rad";
    model.time_unit = "min";
    CHECK(read_dataset(folder.path() / "out", model).scenarios[0].measurements[3].time == 0.05);

    CHECK_THROWS_WITH(written(io_support::replaced(mapping, "\"deg\"", "\"hours of sleep\"")),
                      ContainsSubstring("/scenarios/0/channels/psi/unit") &&
                          ContainsSubstring("'hours of sleep' is no unit"));
    CHECK_THROWS_WITH(written(io_support::replaced(mapping, "\"deg/s\"", "\"deg of sleep\"")),
                      ContainsSubstring("/parameters/w/unit"));
    CHECK_THROWS_WITH(written(io_support::replaced(mapping, "\"ms\"", "\"m\"")),
                      ContainsSubstring("unknown unit 'm'"));
    auto const two = io_support::replaced(
        mapping, "\"initial\": \"propose\"}",
        R"("initial": "propose"}, {"name": "s2", "file": "course.csv", "source": {"kind": "csv"},
           "time": {"column": "t", "unit": "ms", "offset": 0},
           "channels": {"psi": {"column": "heading", "unit": "rad", "error": 3}}})");
    CHECK_THROWS_WITH(written(two), ContainsSubstring("'psi' has 'rad' here and 'deg' in 's'"));
}
