// SPDX-License-Identifier: MIT
#include <sivid/io/dataset_effects.hpp>

#include "io/import_support.hpp"

#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effects.hpp>

#include "../../examples/measured/servo_axis/linear_axis.hpp"

using namespace sivid;
using namespace io_support;
using namespace sivid::literals;

namespace {

std::vector<effect> catalogue() {
    return {effects::dry_friction("dry_friction", "v", "m/s^2", {0_dec, 0.5_dec}, 0.001_dec),
            effects::constant_rate("offset", "v", "m/s^2", {-0.2_dec, 0.2_dec}),
            effects::input_delay("input_delay", "F", {0_dec, 0.05_dec})};
}
dataset with(std::string const& text) {
    dataset data;
    data.effects = read_dataset_effects(parse_json("d.json", text));
    return data;
}
std::string refused(std::string const& text) {
    try {
        auto const data = with(text);
        (void)chosen_effects(catalogue(), data);
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a data set switches effects off and states priors of others") {
    auto const name = catalogue()[1].parameters.at(0).name;
    auto const stated =
        with(R"({ "input_delay": "off", "offset": { ")" + name + R"(": [-1.5, 0.25] } })");
    auto const chosen = chosen_effects(catalogue(), stated);
    REQUIRE(chosen.size() == 2);
    CHECK(chosen[0].name == "dry_friction");
    CHECK(nearest(chosen[0].parameters[0].upper) == 0.5);
    CHECK(nearest(chosen[1].parameters[0].lower) == -1.5);
    CHECK(nearest(chosen[1].parameters[0].upper) == 0.25);
    CHECK(chosen_effects(catalogue(), {}).size() == 3);
    // The problem with the effect has that prior.
    identification_problem base{
        record_model(linear_axis{}), {{"M"}, {}}, box{interval(50, 200)}, {}};
    auto const joined = affected(base, {chosen[1]});
    CHECK(joined.prior[1].lower() == -1.5);
    CHECK(joined.prior[1].upper() == 0.25);
}

TEST_CASE("what the catalogue lacks is refused, and signs that an effect is not made for") {
    auto const k = catalogue()[0].parameters.at(0).name;
    CHECK_THAT(refused(R"({ "wind": "off" })"),
               ContainsSubstring("d.json: /wind: unknown effect 'wind'; this program tries: "
                                 "dry_friction, offset, input_delay"));
    CHECK_THAT(refused(R"({ "dry_friction": { "mass": [0, 1] } })"),
               ContainsSubstring("/dry_friction: the effect has no parameter 'mass'"));
    CHECK_THAT(refused(R"({ "dry_friction": { ")" + k + R"(": [-1, 1] } })"),
               ContainsSubstring("reaches beyond 0"));
    auto limited = catalogue();
    limited.push_back(effects::input_rate_limit("limit", "F", "N/s", {1_dec, 9_dec}));
    CHECK_THROWS_WITH(chosen_effects(limited, with(R"({ "limit": { "R": [0, 9] } })")),
                      ContainsSubstring("'R' reaches 0"));
    CHECK_THAT(refused(R"({ "dry_friction": { ")" + k + R"(": [2, 1] } })"),
               ContainsSubstring("lower is above upper"));
    CHECK_THAT(refused(R"({ "dry_friction": "on" })"), ContainsSubstring("write \"off\""));
    CHECK_THAT(refused(R"({ "dry_friction": 3 })"), ContainsSubstring("/dry_friction"));
    CHECK_THAT(refused("[]"), ContainsSubstring("found a list"));
}

TEST_CASE("mapping, data set and back") {
    auto const mapping =
        replaced(csv_mapping, "\"max_outlier_fraction\"",
                 R"("effects": { "a": "off", "b": { "k": [-0.1, 2e-3], "l": [0, 1] }, "c": {} },
  "max_outlier_fraction")");
    temporary_folder const folder;
    folder.write("mapping.json", mapping);
    folder.write("a.csv", small_table);
    auto const r = import_in(folder);
    auto const data = read_dataset(folder.path() / "out", r.names);
    REQUIRE(data.effects.size() == 3);
    CHECK(data.effects[0].off);
    REQUIRE(data.effects[1].priors.size() == 2);
    CHECK(data.effects[1].priors[0].lower == "-0.1");
    CHECK(data.effects[1].priors[0].upper == "0.002");
    CHECK(data.effects[2].priors.empty());
    CHECK(data.effects[1].place.pointer == "/effects/b");
}
