// SPDX-License-Identifier: MIT
// The one page whose words are kept whole: what a reader sees of the made-up diagnosis, a line for
// each piece of text. After a change that is meant: SIVID_UPDATE_GOLDEN=1 sivid_test_report "the
// golden page", and read the difference.
#include "report/diagnosis_example.hpp"
#include "support/catch.hpp"

#include <sivid/report/diagnosis_page.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace {

constexpr char const* golden = SIVID_SOURCE_DIR "/tests/report/golden/diagnosis_page.txt";

/// The texts between the tags, without styles and drawings.
std::string visible_text(std::string_view page) {
    std::string text;
    for (std::size_t i = 0; i < page.size();) {
        if (page[i] != '<') {
            auto const end = std::min(page.find('<', i), page.size());
            std::string_view piece = page.substr(i, end - i);
            auto const from = piece.find_first_not_of(" \n\t");
            if (from != std::string_view::npos) {
                piece = piece.substr(from, piece.find_last_not_of(" \n\t") + 1 - from);
                text.append(piece).append("\n");
            }
            i = end;
            continue;
        }
        for (std::string_view const skipped : {"<style", "<script", "<svg"})
            if (page.substr(i).starts_with(skipped)) {
                std::string const close = "</" + std::string{skipped.substr(1)} + ">";
                i = std::min(page.find(close, i), page.size());
                break;
            }
        i = page.find('>', i);
        i = i == std::string_view::npos ? page.size() : i + 1;
    }
    return text;
}

} // namespace

TEST_CASE("the golden page") {
    auto example = sivid_tests::hovercraft_diagnosis();
    std::string const now = visible_text(sivid::report::diagnosis_page(example.view()).str());
    if (std::getenv("SIVID_UPDATE_GOLDEN") != nullptr) std::ofstream{golden} << now;
    std::ifstream in{golden};
    REQUIRE(in);
    std::istringstream is{now};
    std::size_t number = 0;
    for (std::string expected, line;;) {
        bool const more = static_cast<bool>(std::getline(in, expected));
        bool const got = static_cast<bool>(std::getline(is, line));
        INFO("line " << ++number << " of " << golden);
        REQUIRE(more == got);
        if (!more) break;
        CHECK(line == expected);
    }
}
