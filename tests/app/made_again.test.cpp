// SPDX-License-Identifier: MIT
// Regions with a probability and least disturbances that are stored: check makes them once more,
// what was forged is refused, and report makes their pages anew.
#include "app/cup.hpp"

#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

using namespace app_test;
using support::text_of;

namespace {

/// Readings of T' = 2 - 0.5 T + d, d = `size` from 0.8 to 1.2, each within 0.05 K.
void plant(served const& s, double size) {
    std::ostringstream text;
    text.precision(15);
    text << "t,T,T_err\n";
    double x = 60, t = 0;
    constexpr double dt = 1e-4;
    for (int n = 1; n <= 20'000; ++n) {
        double const d = t >= 0.8 && t < 1.2 ? size : 0;
        double const slope = 2 - 0.5 * x + d;
        x += dt * (slope - 0.25 * dt * slope);
        t = n * dt;
        if (n % 1000 == 0) text << t << ',' << x + (n % 3000 == 0 ? 0.03 : -0.02) << ",0.05\n";
    }
    s.folder().write("data/tea.measurements.csv", text.str());
}

finished checked(served const& s, std::string const& result) {
    return run({"check", s.at(result)});
}

/// What check says of a file of which a part was replaced; the file is as before afterwards.
finished forged(served const& s, std::string const& file, std::string const& part,
                std::string const& by) {
    auto const path = fs::path{s.at(file)};
    auto const text = text_of(path);
    auto changed = text;
    auto const at = changed.find(part);
    CAPTURE(file, part);
    REQUIRE(at != std::string::npos);
    s.folder().write(file, changed.replace(at, part.size(), by));
    auto const said = checked(s, path.parent_path().filename().string());
    s.folder().write(file, text);
    return said;
}

/// The number behind a key, as it is written.
std::string number_behind(std::string const& text, std::string const& key) {
    auto const from = text.find_first_of("-0123456789", text.find(key) + key.size());
    return text.substr(from, text.find_first_not_of("-+.e0123456789", from) - from);
}

void pages_are_made_anew(served const& s, std::string const& result, std::string const& page) {
    auto const file = fs::path{s.at(result)} / (page + ".html");
    auto const before = text_of(file);
    CHECK(before.size() > 5000);
    fs::remove(file);
    auto const said = run({"report", s.at(result)});
    CAPTURE(said.err);
    CHECK(said.code == 0);
    CHECK(text_of(file) == before);
    s.folder().write(result + "/" + page + ".page.json",
                     text_of(fs::path{s.at(result)} / (page + ".page.json")) + " ");
    CHECK(run({"report", s.at(result)}).code == 2);
}

} // namespace

TEST_CASE("a least disturbance is checked, and one that was forged is refused") {
    served const s;
    plant(s, 5);
    auto const found = run({"disturbance", s.data(), "--on", "T=0.01", "--curve", "2", "--error",
                            "T=0.01", "--quiet", "--budget", "6", "--out", s.at("least")});
    CAPTURE(found.out, found.err);
    REQUIRE((found.code == 0 || found.code == 3));
    auto const good = checked(s, "least");
    CAPTURE(good.out, good.err);
    CHECK(good.code == 0);
    CHECK_THAT(good.out, ContainsSubstring("by first-order sets") &&
                             ContainsSubstring("the same to the last digit"));
    auto const json = text_of(fs::path{s.at("least")} / "disturbance.json");
    auto const lower = number_behind(json, "\"size\""), k = number_behind(json, "\"k\": ");
    auto const at = json.find("\"size\"");
    auto const sizes = json.substr(at, json.find(']', at) + 1 - at);
    auto const ends = [&](double a, double b) {
        return "\"size\": [" + std::to_string(a) + ", " + std::to_string(b) + "]";
    };
    double const low = std::stod(lower), high = std::stod(sizes.substr(sizes.find(',') + 1));
    REQUIRE(low > 0);
    REQUIRE(high > low);
    std::string const file = "least/disturbance.json";
    auto const refused = [&](std::string const& part, std::string const& by, int code = 3) {
        auto const said = forged(s, file, part, by);
        CAPTURE(part, by, said.out, said.err);
        CHECK(said.code == code);
    };
    refused(sizes, ends(0.5 * (low + high), high));
    refused(sizes, ends(low, 0.5 * (low + high)));
    refused(sizes, ends(2 * high, 3 * high), 5);
    refused(sizes, ends(0.1 * low, 0.5 * low), 5);
    refused("\"T\": 60", "\"T\": 59.9");
    refused("\"needed\": [", "\"needed\": [{\"experiment\": \"tea\", \"from\": 0, \"to\": 0.1}, ");
    refused("measurements within their stated bounds", "nothing");
    auto const digest = json.find("\"sha256\": \"") + 11;
    refused(json.substr(digest, 64), std::string(64, '0'), 5);
    refused("\n  \"seconds\": ", "\n  \"seconds\": 1, \"proved\": \"for all\", \"ms\": ", 5);
    refused("\"source\": {", "\"source\": {\"proved\": \"for all\", ", 5);
    s.folder().write("least/products.csv", "of no result here");
    CHECK_THAT(checked(s, "least").out, ContainsSubstring("not checked: ") &&
                                            ContainsSubstring("products.csv") &&
                                            !ContainsSubstring("curve.csv,"));
    std::string const table = "least/disturbance.csv";
    auto const rows = text_of(fs::path{s.at("least")} / "disturbance.csv");
    auto const last = rows.substr(rows.rfind(',') + 1, rows.size() - rows.rfind(',') - 2);
    CHECK(forged(s, table, last + "\n", "0.125\n").code == 3);
    // Other data, another model.
    auto const data = text_of(fs::path{s.data()} / "tea.measurements.csv");
    plant(s, 4);
    CHECK(checked(s, "least").code == 5);
    s.folder().write("data/tea.measurements.csv", data);
    CHECK(checked(s, "least").code == 0);
    pages_are_made_anew(s, "least", "disturbance");
}

TEST_CASE("a region with a probability is checked, and one that was forged is refused") {
    served const s;
    plant(s, 0);
    auto const found =
        run({"confidence", s.data(), "--probability", "0.9", "--seed", "4", "--nominal", "k=0.45",
             "--quiet", "--budget", "3", "--out", s.at("region")});
    CAPTURE(found.out, found.err);
    REQUIRE((found.code == 0 || found.code == 3));
    auto const good = checked(s, "region");
    CAPTURE(good.out, good.err);
    CHECK(good.code == 0);
    auto const refused = [&](std::string const& file, std::string const& part,
                             std::string const& by, int code = 3) {
        auto const said = forged(s, "region/" + file, part, by);
        CAPTURE(file, part, by, said.out, said.err);
        CHECK(said.code == code);
    };
    auto const json = text_of(fs::path{s.at("region")} / "confidence.json");
    refused("confidence.json", "\"probability\": 0.9", "\"probability\": 0.99");
    refused("confidence.json", "\"seed\": 4", "\"seed\": 5");
    refused("confidence.json", "\"above\": 10", "\"above\": 1");
    refused("confidence.json", number_behind(json.substr(json.find("\"nominal\"")), "\"k\""),
            "0.4");
    auto const hull = json.find("\"hull\"");
    auto const lower = number_behind(json.substr(hull), "\"k\"");
    refused("confidence.json", lower, "0.47");
    auto const weight = number_behind(json, "\"weights\"");
    refused("confidence.json", weight, "0.5");
    auto const digest = json.find("\"sha256\": \"") + 11;
    refused("confidence.json", json.substr(digest, 64), std::string(64, '0'), 5);
    auto const rows = text_of(fs::path{s.at("region")} / "confidence.csv");
    auto const inside = rows.find("inside,");
    REQUIRE(inside != std::string::npos);
    auto const corner = rows.substr(inside, rows.find(',', inside + 7) - inside);
    refused("confidence.csv", corner, "inside,0.3");
    pages_are_made_anew(s, "region", "confidence");
}
