// SPDX-License-Identifier: MIT
#include <sivid/importing/mapping/detail/window_mapping_reader.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using io_support::dec;
using kind = mapped_start::kind;

namespace {

std::vector<quantity_mapping> channels() {
    std::vector<quantity_mapping> list(2);
    list[0].name = "theta";
    list[1].name = "i";
    return list;
}
std::vector<mapped_start> starts(std::string const& text) {
    return read_starts(parse_json("m.json", text), channels());
}
window_mapping windows(std::string const& text) {
    return read_window_mapping(parse_json("m.json", text), channels());
}
template <class Read>
std::string refused(Read const& read, std::string const& text) {
    try {
        (void)read(text);
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("starts: stated, as channels show them, and as rates of them") {
    auto const all = starts("\"propose\"");
    REQUIRE(all.size() == 2);
    CHECK(all[1].name == "i");
    CHECK(all[1].channel == "i");
    CHECK(all[1].from == kind::value);
    CHECK_FALSE(all[1].bounded);
    auto const each = starts(R"({ "x": [0, 1], "theta": "propose",
        "q": { "channel": "theta", "rate": 3 },
        "w": { "rate_of": "theta", "acceleration": [-1, 2] } })");
    REQUIRE(each.size() == 4);
    CHECK(each[0].from == kind::stated);
    CHECK(each[0].range.upper == dec("1"));
    CHECK(each[1].channel == "theta");
    CHECK(each[2].range.lower == dec("-3"));
    CHECK(each[2].bounded);
    CHECK(each[3].from == kind::rate);
    CHECK(each[3].range.lower == dec("-1"));
    CHECK(each[3].place.pointer == "/w");
}

TEST_CASE("where the channels give nothing a box is asked for") {
    auto const message = refused(starts, R"({ "w": "propose" })");
    CHECK_THAT(message, ContainsSubstring("m.json: /w: no channel 'w' is mapped that shows 'w'") &&
                            ContainsSubstring("state its box [lower, upper]") &&
                            ContainsSubstring("\"rate_of\""));
    CHECK_THAT(refused(starts, R"({ "w": { "rate_of": "v", "acceleration": 1 } })"),
               ContainsSubstring("no channel 'v'"));
    CHECK_THAT(refused(starts, R"({ "theta": { "channel": "theta", "rate": -1 } })"),
               ContainsSubstring("/theta/rate: no number from 0"));
    CHECK_THAT(refused(starts, R"({ "theta": "guess" })"), ContainsSubstring("\"propose\""));
    CHECK_THAT(refused(starts, R"({ "w": { "rate_of": "theta", "jerk": 1, "acceleration": 1 } })"),
               ContainsSubstring("unknown key"));
    CHECK_THAT(refused(starts, R"({ "w": { "rate_of": "theta", "jerk": 1, "within": 0 } })"),
               ContainsSubstring("/w/within: not above 0"));
    CHECK_THAT(refused(starts, R"({ "theta": { "channel": "theta", "speed": 1 } })"),
               ContainsSubstring("unknown key"));
    CHECK_THAT(refused(starts, R"({ "theta": 3 })"), ContainsSubstring("/theta"));
}

TEST_CASE("windows: what is left out, and what is refused") {
    auto const w = windows(R"({ "length": 2 })");
    CHECK(w.every == dec("2"));
    CHECK(w.first.is_zero());
    CHECK(w.most == 0);
    CHECK(windows(R"({ "length": 2, "every": 3, "holdout": 4 })").holdout_every == 4);
    CHECK_THAT(refused(windows, R"({ "length": 2, "every": 1.9 })"),
               ContainsSubstring("/every: windows that overlap would count"));
    CHECK_THAT(refused(windows, R"({ "length": 0 })"), ContainsSubstring("/length: not above 0"));
    CHECK_THAT(refused(windows, R"({ "length": 1, "first": -1 })"),
               ContainsSubstring("/first: before t = 0"));
    CHECK_THAT(refused(windows, R"({ "length": 1, "holdout": 1 })"), ContainsSubstring("/holdout"));
    CHECK_THAT(refused(windows, R"({ "length": 1, "holdout": [0] })"),
               ContainsSubstring("/holdout/0"));
    CHECK_THAT(refused(windows, R"({ "length": 1, "overlap": 1 })"),
               ContainsSubstring("unknown key"));
}
