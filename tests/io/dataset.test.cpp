// SPDX-License-Identifier: MIT
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <functional>
#include <set>

using namespace sivid;
using io_support::replaced;
using io_support::temporary_folder;

namespace {

exact_decimal dec(std::string_view text) { return exact_decimal::parse(text).value(); }

struct bad_input {
    std::string what;     ///< names the case
    std::string file;     ///< the file that is spoilt
    std::string from, to; ///< how
    std::string place;    ///< pointer, or "line:column"
    std::string message;  ///< a part of the error's text
};

std::string place_of(input_error const& e) {
    if (e.place().is_json) return e.place().pointer;
    return std::to_string(e.place().line) + ":" + std::to_string(e.place().column);
}

} // namespace

TEST_CASE("a valid data set is read completely") {
    temporary_folder const folder;
    io_support::write_small(folder);
    auto const data = read_dataset(folder.path(), io_support::hovercraft_names());

    CHECK(data.id == "small");
    CHECK(data.model == "hovercraft");
    REQUIRE(data.parameters.size() == 2);
    CHECK(data.parameters[0].constant == 8);
    CHECK(data.parameters[0].name == "Sv");
    CHECK(data.parameters[0].unit == "m^2");
    CHECK(data.parameters[0].prior.lower == dec("0.2"));
    CHECK(lower(data.parameters[0].prior.enclosure) ==
          std::nextafter(0.2, 0.0)); // the double 0.2 is above 1/5
    CHECK(upper(data.parameters[0].prior.enclosure) == 0.25);
    REQUIRE(data.fixed.size() == 1);
    CHECK(data.fixed[0].constant == 0);
    CHECK(data.fixed[0].stated == dec("1.297"));
    CHECK(width(data.fixed[0].value) > 0);
    CHECK(contains(data.fixed[0].value, 1.297));

    REQUIRE(data.scenarios.size() == 2);
    auto const& s = data.scenarios[0];
    CHECK(s.name == "S1");
    CHECK(s.role == scenario_role::fit);
    CHECK(s.duration == 1);
    REQUIRE(s.inputs.size() == 2);
    for (auto const& u : s.inputs) CHECK(u.error.empty());
    CHECK(s.inputs[0].signal.times() == std::vector<double>{0, 0.5, 1});
    CHECK(s.inputs[0].signal.values() == std::vector<double>{250, 200, 250});
    CHECK(s.inputs[1].signal.values() == std::vector<double>{0, 0.1, 0});
    CHECK(s.inputs[1].signal.kind() == interpolation::linear);

    REQUIRE(s.measurements.size() == 4); // two cells are empty
    CHECK(s.measurements[0].time == 0.1);
    CHECK(s.measurements[0].channel == 0);
    CHECK(s.measurements[1].channel == 5);
    CHECK(s.measurements[2].time == 0.2);
    CHECK(s.measurements[2].channel == 5);
    CHECK(s.measurements[3].time == 1);
    // the tightest interval around 2.038474 -+ 0.02, not around the rounded double operations
    CHECK(lower(s.measurements[0].bound) == lower(*enclose(dec("2.018474"))));
    CHECK(upper(s.measurements[0].bound) == upper(*enclose(dec("2.058474"))));
    CHECK(s.stated[0].value == dec("2.038474"));
    CHECK(s.stated[3].error == dec("0.02"));
    CHECK(data.outlier_budget(s) == 1); // floor(0.29 * 4)

    REQUIRE(s.initial.size() == 6);
    CHECK(s.initial[0].stated);
    CHECK(lower(s.initial[0].range) <= 0.1);
    CHECK(contains(s.initial[0].range, 0.3));
    CHECK(width(s.initial[1].range) == 0);
    CHECK_FALSE(s.initial[2].stated);
    CHECK((lower(s.initial[2].range) == -6 && upper(s.initial[2].range) == 6));

    auto const& h = data.scenarios[1];
    CHECK(h.role == scenario_role::holdout);
    CHECK(h.inputs[0].signal.kind() == interpolation::hold);
    CHECK(h.inputs[0].signal.times() ==
          std::vector<double>{-0.1, 0.25, 0.6}); // the model's order, not the table's
    CHECK(h.inputs[0].error.empty());
    CHECK(h.inputs[1].signal.times() == std::vector<double>{-0.1, 0.6});
    CHECK(h.inputs[1].error ==
          std::vector<double>{upper(*enclose(dec("0.01"))), upper(*enclose(dec("0.02")))});
    CHECK(h.inputs[1].stated_error[1] == dec("0.02"));
    CHECK(data.outlier_budget(h) == 0);
}

TEST_CASE("the outlier budget is exact in decimals") {
    dataset data;
    data.max_outlier_fraction = dec("0.29");
    scenario s;
    s.measurements.resize(100);
    CHECK(data.outlier_budget(s) == 29); // 0.29 * 100 is 28.999... in double
    s.measurements.resize(99);
    CHECK(data.outlier_budget(s) == 28);
    data.max_outlier_fraction = dec("0.999999999999999999999999");
    CHECK(data.outlier_budget(s) == 98);
}

TEST_CASE("a model without inputs needs no file of them") {
    temporary_folder const folder;
    auto model = io_support::hovercraft_names();
    model.inputs.clear();
    folder.write("dataset.json",
                 R"({"format": "sivid-dataset-1", "id": "free", "model": "hovercraft",
        "parameters": {"Sv": {"prior": [0.2, 0.25], "unit": "m^2"}}, "max_outlier_fraction": 0,
        "scenarios": [{"name": "S1", "role": "fit", "duration": 1, "measurements": "S1.csv", "initial": {}}]})");
    folder.write("S1.csv", "t,u,u_err\n0.5,1,0.1\n");
    auto const data = read_dataset(folder.path(), model);
    CHECK(data.scenarios[0].inputs.empty());
    CHECK(data.scenarios[0].measurements.size() == 1);
    CHECK_FALSE(dataset_digest(folder.path()).empty());
    // one with inputs does
    CHECK_THROWS_AS(read_dataset(folder.path(), io_support::hovercraft_names()), input_error);
}

TEST_CASE("byte-order marks, CRLF, comments and free spacing are accepted") {
    temporary_folder const folder;
    io_support::write_small(folder);
    auto const model = io_support::hovercraft_names();
    auto const plain = read_dataset(folder.path(), model);
    for (auto const* name : {"dataset.json", "S1.inputs.csv", "S1.measurements.csv"}) {
        std::string text = "\xEF\xBB\xBF";
        if (std::string_view{name}.ends_with(".csv")) text += "# a comment, \"quoted\"\r\n";
        for (char c : folder.read(name)) text += c == '\n' ? std::string{"\r\n"} : std::string{c};
        folder.write(name, text);
    }
    auto const data = read_dataset(folder.path(), model);
    REQUIRE(data.scenarios[0].measurements.size() == plain.scenarios[0].measurements.size());
    CHECK(data.scenarios[0].stated[0].value == plain.scenarios[0].stated[0].value);
    CHECK(data.scenarios[0].inputs[0].signal.values() ==
          plain.scenarios[0].inputs[0].signal.values());
}

TEST_CASE("bad input gives one error that names the place") {
    std::string const json = "dataset.json", inputs = "S1.inputs.csv",
                      measured = "S1.measurements.csv";
    std::string const huge = "1" + std::string(400, '0');
    std::vector<bad_input> const cases{
        // the document
        {"malformed JSON", json, "\"id\": \"small\",", "\"id\" \"small\",", "/id",
         "malformed JSON"},
        {"JSON cut off", json, "} ]\n}\n", "} ]\n", "", "malformed JSON"},
        {"text after the end", json, "} ]\n}\n", "} ]\n} x", "", "malformed JSON"},
        {"not an object", json, "{\n  \"format\"", "[\n  \"format\"", "/1", "malformed JSON"},
        {"key twice", json, "\"id\": \"small\",", "\"id\": \"small\", \"id\": \"other\",", "",
         "'id' appears twice"},
        {"unknown key", json, "\"id\"", "\"comment\": 1, \"id\"", "/comment", "unknown key"},
        {"assumptions that are no texts", json, "\"id\"", "\"assumptions\": [1], \"id\"",
         "/assumptions/0", "a text in quotes"},
        {"unknown key of a scenario", json, "\"role\": \"fit\"", "\"role\": \"fit\", \"rate\": 20",
         "/scenarios/0/rate", "unknown key"},
        {"unknown key of a parameter", json, "\"unit\": \"m^2\"",
         "\"unit\": \"m^2\", \"nominal\": 0.22", "/parameters/Sv/nominal", "unknown key"},
        {"format missing", json, "\"format\": \"sivid-dataset-1\", ", "", "",
         "'format' is missing"},
        {"unknown format version", json, "sivid-dataset-1", "sivid-dataset-2", "/format",
         "unknown format"},
        {"format is a number", json, "\"sivid-dataset-1\"", "1", "/format", "instead of a text"},
        {"id missing", json, "\"id\": \"small\", ", "", "", "'id' is missing"},
        {"id empty", json, "\"id\": \"small\"", "\"id\": \"\"", "/id", "is empty"},
        {"unknown model", json, "\"hovercraft\"", "\"submarine\"", "/model",
         "unknown model 'submarine'"},
        // parameters
        {"unknown constant", json, "\"Cd\": {", "\"Cx\": {", "/parameters/Cx",
         "unknown constant 'Cx'"},
        {"parameter twice", json, "\"Cd\": {", "\"Sv\": {", "/parameters", "appears twice"},
        {"no parameter", json,
         "\"Sv\": {\"prior\": [0.20, 0.25], \"unit\": \"m^2\"}, \"Cd\": {\"prior\": [0.5, 0.7]}",
         "", "/parameters", "no parameter"},
        {"parameters are a list", json,
         "{ \"Sv\": {\"prior\": [0.20, 0.25], \"unit\": \"m^2\"}, \"Cd\": {\"prior\": [0.5, 0.7]} "
         "}",
         "[]", "/parameters", "instead of an object"},
        {"prior missing", json, "{\"prior\": [0.5, 0.7]}", "{}", "/parameters/Cd",
         "'prior' is missing"},
        {"prior empty", json, "[0.5, 0.7]", "[]", "/parameters/Cd/prior", "0 numbers instead of 2"},
        {"prior with one end", json, "[0.5, 0.7]", "[0.5]", "/parameters/Cd/prior",
         "1 numbers instead of 2"},
        {"prior with three ends", json, "[0.5, 0.7]", "[0.5, 0.6, 0.7]", "/parameters/Cd/prior",
         "3 numbers instead of 2"},
        {"lower above upper", json, "[0.5, 0.7]", "[0.7, 0.5]", "/parameters/Cd/prior",
         "lower is above upper"},
        {"lower above upper by less than a double shows", json, "[0.5, 0.7]",
         "[0.70000000000000000000001, 0.7]", "/parameters/Cd/prior", "lower is above upper"},
        {"prior of texts", json, "[0.5, 0.7]", "[\"0.5\", 0.7]", "/parameters/Cd/prior/0",
         "instead of a number"},
        {"prior with null", json, "[0.5, 0.7]", "[0.5, null]", "/parameters/Cd/prior/1",
         "found null"},
        {"prior overflows", json, "[0.5, 0.7]", "[0.5, 1e999]", "/parameters/Cd/prior/1",
         "beyond the range"},
        {"prior overflows as a whole number", json, "[0.5, 0.7]", "[0.5, " + huge + "]",
         "/parameters/Cd/prior/1", "beyond the range"},
        {"prior NaN", json, "[0.5, 0.7]", "[0.5, NaN]", "/parameters/Cd/prior/1", "malformed JSON"},
        {"prior infinite", json, "[0.5, 0.7]", "[0.5, Infinity]", "/parameters/Cd/prior/1",
         "malformed JSON"},
        {"another unit", json, "\"unit\": \"m^2\"", "\"unit\": \"m^3\"", "/parameters/Sv/unit",
         "does not convert to the model"},
        // fixed
        {"fixed unknown", json, "\"m\": 1.297", "\"mass\": 1.297", "/fixed/mass",
         "unknown constant"},
        {"fixed and parameter", json, "\"m\": 1.297", "\"Sv\": 0.22", "/fixed/Sv",
         "is fixed and a parameter"},
        {"fixed is a list", json, "1.297", "[1.297, 1.3]", "/fixed/m", "instead of a number"},
        {"fixed overflows", json, "1.297", "-2e308", "/fixed/m", "beyond the range"},
        // outliers
        {"fraction missing", json, "\"max_outlier_fraction\": 0.29,", "", "",
         "'max_outlier_fraction' is missing"},
        {"fraction is one", json, "0.29", "1", "/max_outlier_fraction", "outside [0, 1)"},
        {"fraction is one in another notation", json, "0.29", "10.0e-1", "/max_outlier_fraction",
         "outside [0, 1)"},
        {"fraction negative", json, "0.29", "-0.01", "/max_outlier_fraction", "outside [0, 1)"},
        {"fraction is a text", json, "0.29", "\"0.29\"", "/max_outlier_fraction",
         "instead of a number"},
        // scenarios
        {"scenario name twice", json, "\"name\": \"H1\"", "\"name\": \"S1\"", "/scenarios/1/name",
         "'S1' appears twice"},
        {"scenario name is a path", json, "\"name\": \"H1\"", "\"name\": \"../H1\"",
         "/scenarios/1/name", "cannot be a file name"},
        {"scenario name missing", json, "\"name\": \"S1\", ", "", "/scenarios/0",
         "'name' is missing"},
        {"no fit scenario", json, "\"role\": \"fit\"", "\"role\": \"holdout\"", "/scenarios",
         "role fit"},
        {"unknown role", json, "\"role\": \"fit\"", "\"role\": \"train\"", "/scenarios/0/role",
         "write fit or holdout"},
        {"unknown interpolation", json, "\"linear\"", "\"cubic\"", "/scenarios/0/interpolation",
         "write linear or hold"},
        {"duration zero", json, "\"duration\": 1,", "\"duration\": 0,", "/scenarios/0/duration",
         "not above 0"},
        {"duration negative", json, "\"duration\": 1,", "\"duration\": -1,",
         "/scenarios/0/duration", "not above 0"},
        {"duration missing", json, "\"duration\": 1, ", "", "/scenarios/0",
         "'duration' is missing"},
        {"duration underflows", json, "\"duration\": 1,", "\"duration\": 1e-999,",
         "/scenarios/0/duration", "not above 0"},
        {"unknown state", json, "\"v\": [0, 0]", "\"w\": [0, 0]", "/scenarios/0/initial/w",
         "unknown state"},
        {"initial outside of the model's range", json, "[0.1, 0.3]", "[50, 60]",
         "/scenarios/0/initial/u", "never is where the model keeps it, from -8 to 8"},
        {"initial lower above upper", json, "[0.1, 0.3]", "[0.3, 0.1]", "/scenarios/0/initial/u",
         "lower is above upper"},
        {"initial is a number", json, "[0.1, 0.3]", "0.1", "/scenarios/0/initial/u",
         "instead of a list"},
        {"initial missing", json, ", \"initial\": {}", "", "/scenarios/1", "'initial' is missing"},
        // paths
        {"file missing", json, "S1.inputs.csv", "S7.inputs.csv", "/scenarios/0/inputs",
         "there is no file"},
        {"file is a folder", json, "\"S1.inputs.csv\"", "\".\"", "0:0", "not a regular file"},
        {"absolute path", json, "S1.inputs.csv", "/etc/passwd", "/scenarios/0/inputs",
         "absolute path"},
        {"path upwards", json, "S1.measurements.csv", "../S1.measurements.csv",
         "/scenarios/0/measurements", "out of the folder"},
        {"path down and upwards", json, "S1.measurements.csv", "a/../../x",
         "/scenarios/0/measurements", "out of the folder"},
        {"path through a link", json, "S1.measurements.csv", "link.csv",
         "/scenarios/0/measurements", "through a link"},
        {"path empty", json, "\"S1.inputs.csv\"", "\"\"", "/scenarios/0/inputs", "is empty"},
        // inputs
        {"inputs empty", inputs, std::string{io_support::small_inputs}, "", "0:0",
         "no heading line"},
        {"inputs without samples", inputs, "0,250,0\n0.5,200,0.1\n1,250,0\n", "", "1:2",
         "has no sample"},
        {"first column is not t", inputs, "t,W", "time,W", "1:1", "instead of t"},
        {"separated by semicolons", inputs, std::string{io_support::small_inputs},
         "t;W;delta\n0;1;0\n1;1;0\n", "1:1", "instead of t"},
        {"unknown input", inputs, "delta", "rudder", "1:3", "unknown input 'rudder'"},
        {"input missing", inputs, std::string{io_support::small_inputs}, "t,W\n0,1\n1,1\n", "1:0",
         "'delta' is missing"},
        {"input twice", inputs, "t,W,delta", "t,W,W", "1:3", "appears twice"},
        {"input error without the input", inputs, "t,W,delta", "t,W,psi_err", "1:3",
         "unknown input"},
        {"inputs start late", inputs, "0,250,0\n", "0.01,250,0\n", "2:2", "starts after t = 0"},
        {"inputs end early", inputs, "1,250,0\n", "0.99,250,0\n", "4:2",
         "ends before the duration"},
        {"one input ends early", inputs, "1,250,0\n", "1,250,\n", "4:3",
         "ends before the duration"},
        {"input time twice", inputs, "0.5,200", "0,200", "3:1", "does not come after"},
        {"input times unsorted", inputs, "0.5,200", "-1,200", "3:1", "does not come after"},
        {"input times equal as doubles", inputs, "1,250,0\n",
         "0.50000000000000000000001,250,0\n1,2,3\n", "4:1", "does not come after"},
        {"input is NaN", inputs, "0.5,200", "0.5,nan", "3:2", "'nan' is not a finite number"},
        {"input is infinite", inputs, "0.5,200", "0.5,inf", "3:2", "'inf' is not a finite number"},
        {"input overflows", inputs, "0.5,200", "0.5,1e400", "3:2", "beyond the range"},
        {"input row short", inputs, "0.5,200,0.1", "0.5,200", "3:3", "2 cells in a table of 3"},
        {"input row long", inputs, "0.5,200,0.1", "0.5,200,0.1,7", "3:4",
         "4 cells in a table of 3"},
        {"input time missing", inputs, "0.5,200", ",200", "3:1", "empty"},
        {"input error zero", inputs, std::string{io_support::small_inputs},
         "t,W,delta,W_err\n0,1,0,0\n1,1,0,1\n", "2:4", "not above 0"},
        {"input error cell missing", inputs, std::string{io_support::small_inputs},
         "t,W,delta,W_err\n0,1,0,1\n1,1,0,\n", "3:4", "error bound is missing"},
        // measurements
        {"unknown channel", measured, "t,u,u_err", "t,w,w_err", "1:2", "unknown channel 'w'"},
        {"measurement error column missing", measured, "psi,psi_err", "psi,v_err", "1:5",
         "no column for the values"},
        {"channel without error column", measured, std::string{io_support::small_measurements},
         "t,u\n0,1\n", "1:2", "no column 'u_err'"},
        {"measurement error cell missing", measured, "3,0.02,,", "3,,,", "4:3",
         "error bound is missing"},
        {"error zero", measured, "3,0.02,,", "3,0,,", "4:3", "not above 0"},
        {"error negative", measured, "3,0.02,,", "3,-0.02,,", "4:3", "not above 0"},
        {"error of an empty cell negative", measured, "0.2,,0.02", "0.2,,-0.02", "3:3",
         "not above 0"},
        {"error NaN", measured, "3,0.02,,", "3,NaN,,", "4:3", "not a finite number"},
        {"value overflows", measured, "3,0.02,,", "3e400,0.02,,", "4:2", "beyond the range"},
        {"value plus error overflows", measured, "3,0.02,,", "1.7e308,1e308,,", "4:2",
         "beyond the range"},
        {"value is text", measured, "3,0.02,,", "three,0.02,,", "4:2",
         "'three' is not a finite number"},
        {"value with decimal comma", measured, "3,0.02,,", "3,1,0.02,,", "4:6",
         "6 cells in a table of 5"},
        {"quotation marks", measured, "3,0.02,,", "\"3\",0.02,,", "4:2", "quotation mark"},
        {"measurement after the duration", measured, "1,3,0.02", "1.001,3,0.02", "4:1",
         "outside [0, duration]"},
        {"measurement before the start", measured, "0.1,2.038474", "-0.1,2.038474", "2:1",
         "outside [0, duration]"},
        {"measurement times unsorted", measured, "0.2,,", "0.05,,", "3:1", "does not come after"},
        {"measurement time twice", measured, "0.2,,", "0.1,,", "3:1", "does not come after"},
        {"no measurement", measured, std::string{io_support::small_measurements},
         "t,u,u_err\n0.1,,\n", "/scenarios/0/measurements", "no measurement"},
        {"no measurement row", measured, std::string{io_support::small_measurements}, "t,u,u_err\n",
         "/scenarios/0/measurements", "no measurement"},
        {"no measurement column", measured, std::string{io_support::small_measurements}, "t\n0.1\n",
         "/scenarios/0/measurements", "no measurement"},
        {"measurements empty", measured, std::string{io_support::small_measurements}, "", "0:0",
         "no heading line"},
    };
    std::set<std::string> names;
    auto const model = io_support::hovercraft_names();
    for (auto const& c : cases) {
        CAPTURE(c.what);
        CHECK(names.insert(c.what).second);
        temporary_folder const outer;
        outer.write("outside.csv", io_support::small_measurements);
        outer.write("S1.measurements.csv", io_support::small_measurements);
        temporary_folder const folder;
        io_support::write_small(folder);
        std::filesystem::create_symlink(outer.path() / "outside.csv", folder.path() / "link.csv");
        REQUIRE_NOTHROW(
            read_dataset(folder.path(), model)); // only the planted defect is in the way
        folder.write(c.file, replaced(folder.read(c.file), c.from, c.to));
        try {
            (void)read_dataset(folder.path(), model);
            FAIL_CHECK("was accepted");
        } catch (input_error const& e) {
            CAPTURE(e.what());
            CHECK(place_of(e) == c.place);
            CHECK_THAT(e.what(), ContainsSubstring(c.message));
            CHECK_FALSE(e.remedy().empty());
            if (c.place != "0:0")
                CHECK_THAT(e.place().file,
                           EndsWith(c.place.front() == '/' || c.place.empty() ? json : c.file));
        }
    }
    CHECK(cases.size() >= 40);
}

TEST_CASE("what is bridged lies between samples of the input, each gap once") {
    temporary_folder const folder;
    write_small(folder);
    auto const read = [&](std::string const& bridged) {
        folder.write("dataset.json",
                     io_support::replaced(io_support::small_json, "\"v\": [0, 0] } }",
                                          "\"v\": [0, 0] }, \"bridged\": " + bridged + " }"));
        return read_dataset(folder.path(), io_support::hovercraft_names());
    };
    auto const data = read(R"({ "W": { "samples": 7, "gaps": [[0, 0.5]] } })");
    CHECK(data.scenarios[0].inputs[0].missing == 7);
    CHECK(data.scenarios[0].inputs[0].bridged == std::vector{std::pair{0.0, 0.5}});
    CHECK(data.scenarios[0].inputs[1].bridged.empty());
    auto const refused = [&](std::string const& bridged, std::string const& says) {
        CHECK_THROWS_WITH(read(bridged), ContainsSubstring(says));
    };
    refused(R"({ "X": { "samples": 7, "gaps": [[0, 0.5]] } })", "unknown input");
    refused(R"({ "W": { "samples": 7, "gaps": [[0, 1]] } })", "from one sample of 'W' to the next");
    refused(R"({ "W": { "samples": 7, "gaps": [[0.1, 0.5]] } })", "from one sample");
    refused(R"({ "W": { "samples": 7, "gaps": [[1, 2]] } })", "from one sample");
    refused(R"({ "W": { "samples": 7, "gaps": [[0, 0.5], [0, 0.5]] } })", "follow each other");
    refused(R"({ "W": { "samples": 7, "gaps": [] } })", "no gap");
    refused(R"({ "W": { "samples": 0, "gaps": [[0, 0.5]] } })", "whole number from 1");
    refused(R"({ "W": { "gaps": [[0, 0.5]] } })", "samples");
    refused(R"({ "W": { "samples": 1, "gaps": [[0, 0.5]], "why": 1 } })", "why");
    // In the data set's unit of time, as everything else.
    folder.write("S1.inputs.csv", "t,W,delta\n0,250,0\n500,200,0.1\n1000,250,0\n");
    folder.write("S1.measurements.csv", "t,u,u_err\n100,2,0.02\n");
    folder.write("H1.inputs.csv", "t,W,delta\n0,250,0\n1000,250,0\n");
    auto text =
        io_support::replaced(io_support::small_json, "\"duration\": 1,", "\"duration\": 1000,");
    text = io_support::replaced(
        text, "\"v\": [0, 0] } }",
        R"("v": [0, 0] }, "bridged": { "W": { "samples": 7, "gaps": [[0, 500]] } } })");
    folder.write("dataset.json", io_support::replaced(text, "\"scenarios\"",
                                                      "\"time_unit\": \"ms\", \"scenarios\""));
    auto const other = read_dataset(folder.path(), io_support::hovercraft_names());
    CHECK(other.scenarios[0].inputs[0].bridged == std::vector{std::pair{0.0, 0.5}});
}

TEST_CASE("a folder or a description that is not there is an error") {
    temporary_folder const folder;
    auto const model = io_support::hovercraft_names();
    CHECK_THROWS_WITH(read_dataset(folder.path() / "gone", model),
                      ContainsSubstring("no such folder"));
    CHECK_THROWS_WITH(read_dataset(folder.path(), model),
                      ContainsSubstring("dataset.json: no such file"));
    folder.write("dataset.json", "{}");
    CHECK_THROWS_WITH(read_dataset(folder.path() / "dataset.json", model),
                      ContainsSubstring("no such folder"));
    std::filesystem::remove(folder.path() / "dataset.json");
    std::filesystem::create_directory(folder.path() / "dataset.json");
    CHECK_THROWS_WITH(read_dataset(folder.path(), model), ContainsSubstring("not a regular file"));
}

TEST_CASE("a unit may be left out or spelt as none") {
    temporary_folder const folder;
    auto const model = io_support::hovercraft_names();
    io_support::write_small(folder);
    for (auto unit : {"\"\"", "\"1\"", "\"-\""}) {
        CAPTURE(unit);
        folder.write("dataset.json", replaced(io_support::small_json, "[0.5, 0.7]",
                                              std::string{"[0.5, 0.7], \"unit\": "} + unit));
        CHECK_NOTHROW(read_dataset(folder.path(), model));
    }
}

TEST_CASE("a model without inputs needs a time axis alone") {
    temporary_folder const folder;
    io_support::write_small(folder);
    auto model = io_support::hovercraft_names();
    model.inputs.clear();
    folder.write("S1.inputs.csv", "t\n0\n1\n");
    folder.write("H1.inputs.csv", "t\n");
    CHECK(read_dataset(folder.path(), model).scenarios[0].inputs.empty());
}

TEST_CASE("the bundled campaign is read") {
    auto const folder = std::filesystem::path{SIVID_SOURCE_DIR} / "examples/hovercraft/data/h3";
    auto const data = read_dataset(folder, io_support::hovercraft_names());
    CHECK(data.id == "h3");
    CHECK(data.parameters.size() == 3);
    REQUIRE(data.scenarios.size() == 1);
    CHECK(data.scenarios[0].measurements.size() == 180);
}

TEST_CASE("the reference campaigns are read") {
    auto const model = io_support::hovercraft_names();
    std::size_t campaigns = 0;
    for (auto const& entry :
         std::filesystem::recursive_directory_iterator{SIVID_SOURCE_DIR "/tests/data"}) {
        if (entry.path().filename() != "dataset.json") continue;
        auto const folder = entry.path().parent_path();
        CAPTURE(folder.string());
        auto const data = read_dataset(folder, model);
        ++campaigns;
        CHECK(data.id == folder.filename().string());
        for (auto const& s : data.scenarios) {
            CAPTURE(s.name);
            CHECK(s.measurements.size() == s.stated.size());
            CHECK(s.inputs.size() == 2);
            for (std::size_t i = 0; i < s.measurements.size(); ++i) {
                auto const bound = s.measurements[i].bound;
                auto const value = *nearest(s.stated[i].value), error = *nearest(s.stated[i].error);
                REQUIRE(contains(bound, value));
                REQUIRE(std::abs(width(bound) - 2 * error) <= 1e-14 * (std::abs(value) + error));
            }
        }
    }
    CHECK(campaigns == 5);
}

TEST_CASE("a data set in other units is the same problem") {
    temporary_folder const folder, plain;
    io_support::write_small(plain);
    io_support::write_small(folder);
    auto const model = io_support::hovercraft_names();
    // The same numbers in milliseconds, millimetres a second, square centimetres and grams.
    auto json = replaced(io_support::small_json, "\"max_outlier_fraction\"",
                         "\"time_unit\": \"ms\", \"channel_units\": {\"u\": \"mm/s\"}, "
                         "\"input_units\": {\"W\": \"1/min\"}, \"max_outlier_fraction\"");
    json = replaced(json, "[0.20, 0.25], \"unit\": \"m^2\"", "[2000, 2500], \"unit\": \"cm^2\"");
    json = replaced(json, "\"m\": 1.297", "\"m\": {\"value\": 1297, \"unit\": \"g\"}");
    json = replaced(json, "\"duration\": 1,", "\"duration\": 1000,");
    json = replaced(json, "\"duration\": 0.5", "\"duration\": 500");
    json = replaced(json, "\"u\": [0.1, 0.3]", "\"u\": {\"range\": [10, 30], \"unit\": \"cm/s\"}");
    folder.write("dataset.json", json);
    folder.write("S1.inputs.csv", "t,W,delta\n0,15000,0\n500,12000,0.1\n1000,15000,0\n");
    folder.write("S1.measurements.csv", "t,u,u_err,psi,psi_err\n"
                                        "100,2038.474,20,-0.005986,0.03\n"
                                        "200,,20,0.1,0.03\n"
                                        "1000,3000,20,,\n");
    folder.write("H1.inputs.csv",
                 "t,delta,delta_err,W\n-100,0,0.01,6000\n250,,,7200\n600,0.2,0.02,7800\n");
    folder.write("H1.measurements.csv", "t,r,r_err\n500,0.1,1e-3\n");
    auto const a = read_dataset(folder.path(), model), b = read_dataset(plain.path(), model);
    CHECK(a.parameters[0].prior.lower == b.parameters[0].prior.lower);
    CHECK(a.parameters[0].prior.upper == b.parameters[0].prior.upper);
    CHECK(a.parameters[0].unit == "m^2");
    CHECK(lower(a.fixed[0].value) == lower(b.fixed[0].value));
    CHECK(upper(a.fixed[0].value) == upper(b.fixed[0].value));
    for (std::size_t s = 0; s < 2; ++s) {
        auto const &x = a.scenarios[s], &y = b.scenarios[s];
        CHECK(x.duration == y.duration);
        CHECK(x.initial[0].range.lower() == y.initial[0].range.lower());
        CHECK(x.initial[0].range.upper() == y.initial[0].range.upper());
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(x.inputs[i].signal.times() == y.inputs[i].signal.times());
            CHECK(x.inputs[i].signal.values() == y.inputs[i].signal.values());
            CHECK(x.inputs[i].error == y.inputs[i].error);
        }
        REQUIRE(x.measurements.size() == y.measurements.size());
        for (std::size_t k = 0; k < x.measurements.size(); ++k) {
            CHECK(x.measurements[k].time == y.measurements[k].time);
            CHECK(lower(x.measurements[k].bound) == lower(y.measurements[k].bound));
            CHECK(upper(x.measurements[k].bound) == upper(y.measurements[k].bound));
        }
    }
}

TEST_CASE("units of a data set are compared with the model's") {
    temporary_folder const folder;
    auto const model = io_support::hovercraft_names();
    auto const at = [&](std::string const& from, std::string const& to) {
        io_support::write_small(folder);
        folder.write("dataset.json", replaced(io_support::small_json, from, to));
        try {
            (void)read_dataset(folder.path(), model);
        } catch (input_error const& e) {
            CHECK_FALSE(e.remedy().empty());
            return e.place().pointer + ": " + e.problem();
        }
        return std::string("accepted");
    };
    auto const key = [&](std::string const& more) { return at("\"id\"", more + ", \"id\""); };
    CHECK(key(R"("channel_units": {"psi": "rad", "u": "m/s"}, "input_units": {"W": "1/s"})") ==
          "accepted");
    CHECK(key(R"("channel_units": {"psi": "deg"}, "time_unit": "s")") == "accepted");
    CHECK_THAT(key(R"("channel_units": {"psi": "hours of sleep"})"),
               ContainsSubstring("/channel_units/psi: 'hours of sleep' is no unit"));
    CHECK_THAT(key(R"("channel_units": {"psi": "m"})"),
               ContainsSubstring("/channel_units/psi: 'm' is the unit of the channel 'psi', which "
                                 "does not convert to the model's 'rad'"));
    CHECK_THAT(key(R"("channel_units": {"heading": "rad"})"),
               ContainsSubstring("unknown channel 'heading'"));
    CHECK_THAT(key(R"("input_units": {"delta": "%"})"), ContainsSubstring("accepted"));
    CHECK_THAT(key(R"("input_units": {"W": "rpm"})"), ContainsSubstring("/input_units/W"));
    CHECK_THAT(key(R"("time_unit": "m")"), ContainsSubstring("/time_unit: 'm' is the unit of"));
    CHECK_THAT(key(R"("time_unit": 3)"), ContainsSubstring("/time_unit"));
    CHECK_THAT(at("\"m\": 1.297", R"("m": {"value": 1.297, "unit": "m"})"),
               ContainsSubstring("/fixed/m/unit"));
    CHECK_THAT(at("\"m\": 1.297", R"("m": {"unit": "kg"})"), ContainsSubstring("/fixed/m"));
    CHECK_THAT(at("\"u\": [0.1, 0.3]", R"("u": {"range": [0.1, 0.3], "unit": "m"})"),
               ContainsSubstring("/scenarios/0/initial/u/unit"));
    CHECK_THAT(at("[0.20, 0.25]", "[1e99, 1e100]"), ContainsSubstring("accepted"));
    CHECK_THAT(at("[0.20, 0.25], \"unit\": \"m^2\"", "[1e99, 1e100], \"unit\": \"km^2\""),
               ContainsSubstring("/parameters/Sv/prior: in the model's unit"));
}
