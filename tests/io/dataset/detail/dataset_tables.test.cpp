// SPDX-License-Identifier: MIT
#include <sivid/io/dataset/detail/dataset_tables.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("columns are found in any order and returned in the model's") {
    auto const model = io_support::hovercraft_names();
    csv_table const table{"a.csv", "t,psi_err,v,psi,v_err\n"};
    auto const columns = find_columns(table, model.channels, "channel");
    REQUIRE(columns.size() == 2);
    CHECK((columns[0].index == 1 && columns[0].value == 2 && columns[0].error == 4u));
    CHECK((columns[1].index == 5 && columns[1].value == 3 && columns[1].error == 1u));
}

TEST_CASE("a quantity whose own name ends in _err is no error column") {
    std::vector<name_unit> const names{{"a", ""}, {"b_err", ""}};
    auto const columns = find_columns(csv_table{"a.csv", "t,b_err,b_err_err\n"}, names, "channel");
    REQUIRE(columns.size() == 1);
    CHECK((columns[0].index == 1 && columns[0].value == 1 && columns[0].error == 2u));
}

TEST_CASE("bounds enclose value plus and minus error, tightly") {
    auto const model = io_support::hovercraft_names();
    scenario s;
    s.duration = 1;
    read_measurements(csv_table{"a.csv", "t,u,u_err\n0,0.3,0.1\n0.5,1e-320,1e-320\n1,-7,1e-30\n"},
                      model, s);
    REQUIRE(s.measurements.size() == 3);
    auto const near = [](char const* text) { return *enclose(*exact_decimal::parse(text)); };
    CHECK(lower(s.measurements[0].bound) == lower(near("0.2")));
    CHECK(upper(s.measurements[0].bound) == upper(near("0.4")));
    CHECK(lower(s.measurements[1].bound) == 0);
    CHECK(upper(s.measurements[1].bound) == upper(near("2e-320")));
    CHECK(lower(s.measurements[2].bound) ==
          std::nextafter(-7, -8)); // never lost against a large value
    CHECK(upper(s.measurements[2].bound) == std::nextafter(-7, 0));
}
