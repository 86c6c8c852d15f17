// SPDX-License-Identifier: MIT
#include <sivid/report/stored_page.hpp>

#include "io/support.hpp"
#include "report/diagnosis_example.hpp"
#include "report/hovercraft_view.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <string>

using namespace sivid;
using namespace sivid::report;

namespace {

stored_page again(stored_page const& page) {
    io_support::temporary_folder const folder;
    folder.write(page.data_name(), page.data);
    return read_page(folder.path() / page.data_name());
}

} // namespace

TEST_CASE("the page of an identification is made of its data again, byte for byte") {
    auto view = sivid_tests::hovercraft_view(400, true);
    auto const page = stored(view);
    CHECK(page.name == "report.html");
    CHECK(page.data_name() == "report.page.json");
    CHECK(page.html == identification_page(view).str());
    CHECK(again(page).html == page.html);
    CHECK(again(page).data == page.data);
}

TEST_CASE("the page of a diagnosis is made of its data again, byte for byte") {
    auto const view = sivid_tests::hovercraft_diagnosis().view();
    auto const page = stored(view);
    CHECK(page.html == diagnosis_page(view).str());
    CHECK(again(page).html == page.html);
    CHECK(again(page).data == page.data);
}

TEST_CASE("numbers and texts of all kinds come back as they were") {
    identification_view view;
    view.dataset = "a \"quoted\"\n\tname with \\ and \x01, \xC3\xA9";
    double const huge = std::numeric_limits<double>::infinity();
    view.parameters = {{"p", "1", {-huge, huge}, {}, "", std::nan("")},
                       {"q", "1", {-0.0, 0.1}, {5e-324, 1.7976931348623157e308}, "", 1.0 / 3}};
    view.statistics.boxes = 123456789012;
    auto const page = stored(view);
    auto const other = again(page);
    CHECK(other.data == page.data);
    CHECK(other.html == page.html);
}

TEST_CASE("data of a page that are damaged, or none, are refused") {
    io_support::temporary_folder const folder;
    auto const refused = [&](std::string const& text, std::string const& what) {
        folder.write("x.page.json", text);
        CHECK_THROWS_WITH(read_page(folder.path() / "x.page.json"), ContainsSubstring(what));
    };
    auto const whole = stored(sivid_tests::hovercraft_view(400, true)).data;
    refused("", "x.page.json");
    refused("{}", "format");
    refused(whole.substr(0, whole.size() / 2), "x.page.json");
    auto changed = whole;
    changed[changed.size() / 2] = changed[changed.size() / 2] == '1' ? '2' : '1';
    CHECK_THROWS_AS(
        (folder.write("x.page.json", changed), read_page(folder.path() / "x.page.json")),
        input_error);
    auto other = whole;
    other.replace(other.find("identification"), 14, "diagnosis");
    refused(other, "was changed");
    CHECK_THROWS_AS(read_page(folder.path() / "nowhere.json"), input_error);
}
