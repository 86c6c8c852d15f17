// SPDX-License-Identifier: MIT
#include <sivid/io/dataset_writer.hpp>

#include <sivid/io/dataset.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

using namespace sivid;
using io_support::temporary_folder;

namespace {

void check_equal(dataset const& a, dataset const& b) {
    CHECK(a.id == b.id);
    CHECK(a.model == b.model);
    CHECK(a.max_outlier_fraction == b.max_outlier_fraction);
    REQUIRE(a.parameters.size() == b.parameters.size());
    for (std::size_t i = 0; i < a.parameters.size(); ++i) {
        CHECK(a.parameters[i].constant == b.parameters[i].constant);
        CHECK(a.parameters[i].unit == b.parameters[i].unit);
        CHECK(a.parameters[i].prior.lower == b.parameters[i].prior.lower);
        CHECK(a.parameters[i].prior.upper == b.parameters[i].prior.upper);
    }
    REQUIRE(a.fixed.size() == b.fixed.size());
    for (std::size_t i = 0; i < a.fixed.size(); ++i) {
        CHECK(a.fixed[i].constant == b.fixed[i].constant);
        CHECK(a.fixed[i].stated == b.fixed[i].stated);
    }
    REQUIRE(a.scenarios.size() == b.scenarios.size());
    CHECK(a.assumptions == b.assumptions);
    for (std::size_t k = 0; k < a.scenarios.size(); ++k) {
        auto const &x = a.scenarios[k], &y = b.scenarios[k];
        CHECK(x.name == y.name);
        CHECK(x.role == y.role);
        CHECK(x.duration == y.duration);
        REQUIRE(x.inputs.size() == y.inputs.size());
        for (std::size_t i = 0; i < x.inputs.size(); ++i) {
            CHECK(x.inputs[i].signal.times() == y.inputs[i].signal.times());
            CHECK(x.inputs[i].signal.values() == y.inputs[i].signal.values());
            CHECK(x.inputs[i].signal.kind() == y.inputs[i].signal.kind());
            CHECK(x.inputs[i].error == y.inputs[i].error);
            CHECK(x.inputs[i].missing == y.inputs[i].missing);
            CHECK(x.inputs[i].bridged == y.inputs[i].bridged);
        }
        REQUIRE(x.measurements.size() == y.measurements.size());
        for (std::size_t i = 0; i < x.measurements.size(); ++i) {
            CHECK(x.measurements[i].time == y.measurements[i].time);
            CHECK(x.measurements[i].channel == y.measurements[i].channel);
            CHECK(x.stated[i].value == y.stated[i].value);
            CHECK(x.stated[i].error == y.stated[i].error);
        }
        REQUIRE(x.initial.size() == y.initial.size());
        for (std::size_t i = 0; i < x.initial.size(); ++i) {
            REQUIRE(x.initial[i].stated.has_value() == y.initial[i].stated.has_value());
            if (!x.initial[i].stated) continue;
            CHECK(x.initial[i].stated->lower == y.initial[i].stated->lower);
            CHECK(x.initial[i].stated->upper == y.initial[i].stated->upper);
        }
    }
}

} // namespace

TEST_CASE("what is written reads back as the same value") {
    auto const model = io_support::hovercraft_names();
    temporary_folder const source, copy;
    io_support::write_small(source);
    auto data = read_dataset(source.path(), model);
    CHECK(data.assumptions.empty());
    data.assumptions = {"the times are exact", "u shows what it is called"};
    write_dataset(data, model, copy.path() / "new");
    check_equal(data, read_dataset(copy.path() / "new", model));
    write_dataset(data, model, copy.path() / "new"); // again, over the old files
    check_equal(data, read_dataset(copy.path() / "new", model));
    // What is bridged where samples of an input are missing.
    data.scenarios[0].inputs[1].bridged = {{0, 0.5}, {0.5, 1}};
    data.scenarios[0].inputs[1].missing = 43;
    write_dataset(data, model, copy.path() / "new");
    CHECK_THAT(copy.read("new/dataset.json"), ContainsSubstring("\"bridged\""));
    check_equal(data, read_dataset(copy.path() / "new", model));
}

TEST_CASE("two measurements of a channel at one time are refused: a table holds one") {
    auto const model = io_support::hovercraft_names();
    temporary_folder const folder;
    io_support::write_small(folder);
    auto data = read_dataset(folder.path(), model);
    write_dataset(data, model, folder.path() / "new");
    auto& s = data.scenarios[1];
    s.measurements.push_back(s.measurements.front());
    s.stated.push_back({*exact_decimal::parse("0.2"), s.stated.front().error});
    CHECK_THROWS_WITH(write_dataset(data, model, folder.path() / "new"),
                      ContainsSubstring("H1.measurements.csv: two measurements of 'r' at 0.5 s"));
    CHECK(read_dataset(folder.path() / "new", model).scenarios[1].measurements.size() == 1);
}

TEST_CASE("a model without inputs is written with its time axis") {
    auto model = io_support::hovercraft_names();
    model.inputs.clear();
    temporary_folder const folder;
    io_support::write_small(folder);
    folder.write("S1.inputs.csv", "t\n0\n1\n");
    folder.write("H1.inputs.csv", "t\n");
    auto const data = read_dataset(folder.path(), model);
    CHECK(inputs_csv(data.scenarios[1], model) == "t\n0\n0.5\n");
    write_dataset(data, model, folder.path() / "new");
    check_equal(data, read_dataset(folder.path() / "new", model));
}

TEST_CASE("a reference campaign survives writing") {
    auto const model = io_support::hovercraft_names();
    temporary_folder const copy;
    for (auto const* name : {"/examples/hovercraft/data/h3", "/tests/data/campaigns/dev003"}) {
        auto const data = read_dataset(std::string{SIVID_SOURCE_DIR} + name, model);
        write_dataset(data, model, copy.path() / data.id);
        check_equal(data, read_dataset(copy.path() / data.id, model));
    }
}
