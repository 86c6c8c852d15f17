// SPDX-License-Identifier: MIT
// Random damage to a valid data set: the reader accepts it or throws input_error, and nothing else
// happens.
#include <sivid/io/dataset.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <array>

using namespace sivid;
using io_support::temporary_folder;

namespace {

std::string damaged(std::string text, std::mt19937_64& random) {
    auto const below = [&](std::size_t n) {
        return n == 0 ? 0 : static_cast<std::size_t>(random() % n);
    };
    static constexpr std::array<std::string_view, 34> tokens{"{",
                                                             "}",
                                                             "[",
                                                             "]",
                                                             ",",
                                                             ":",
                                                             "\"",
                                                             "\\",
                                                             "\n",
                                                             "\r",
                                                             "#",
                                                             "null",
                                                             "true",
                                                             "1e999",
                                                             "-1e-999",
                                                             "nan",
                                                             "-",
                                                             ".",
                                                             "e",
                                                             "_err",
                                                             "0.1,0.2",
                                                             ",,",
                                                             "\xff",
                                                             "\xEF\xBB\xBF",
                                                             "..",
                                                             "/",
                                                             "t",
                                                             "u",
                                                             "99999999999999999999999",
                                                             "-0",
                                                             "1e",
                                                             "\\u0000",
                                                             "\\ud800",
                                                             " "};
    for (auto times = 1 + below(4); times > 0; --times) {
        auto const at = below(text.size() + 1);
        auto const length = below(std::min<std::size_t>(text.size() - at, 12) + 1);
        switch (below(6)) {
        case 0:
            text.erase(at, length);
            break;
        case 1:
            text.insert(at, tokens[below(tokens.size())]);
            break;
        case 2:
            text.replace(at, length, tokens[below(tokens.size())]);
            break;
        case 3:
            if (at < text.size()) text[at] = static_cast<char>(below(256));
            break;
        case 4:
            text.insert(at, text.substr(below(text.size() + 1), below(60)));
            break;
        case 5:
            text.resize(at);
            break;
        }
    }
    return text;
}

void run(unsigned seed, int count) {
    std::mt19937_64 random{seed};
    temporary_folder const folder;
    io_support::write_small(folder);
    auto const model = io_support::hovercraft_names();
    std::array<std::string, 5> const files{"dataset.json", "S1.inputs.csv", "S1.measurements.csv",
                                           "H1.inputs.csv", "H1.measurements.csv"};
    int accepted = 0, refused = 0;
    for (int i = 0; i < count; ++i) {
        auto const& file = files[random() % files.size()];
        auto const original = folder.read(file);
        auto const spoilt = damaged(original, random);
        folder.write(file, spoilt);
        CAPTURE(file, spoilt);
        try {
            auto const data = read_dataset(folder.path(), model);
            ++accepted;
            for (auto const& s : data.scenarios)
                for (std::size_t k = 0; k < s.measurements.size(); ++k) {
                    REQUIRE_FALSE(is_empty(s.measurements[k].bound));
                    REQUIRE(contains(s.measurements[k].bound, *nearest(s.stated[k].value)));
                }
        } catch (input_error const& e) {
            ++refused;
            REQUIRE_FALSE(e.problem().empty());
            REQUIRE_FALSE(e.place().file.empty());
        } // anything else ends the test
        folder.write(file, original);
    }
    CHECK(accepted > count / 100);
    CHECK(refused > count / 3);
}

} // namespace

TEST_CASE("damaged data sets are accepted or refused, nothing else") { run(20240601, 1500); }

TEST_CASE("many damaged data sets are accepted or refused, nothing else", "[.long]") {
    run(77, 300000);
}
