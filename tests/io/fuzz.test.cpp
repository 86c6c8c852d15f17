// SPDX-License-Identifier: MIT
// Random damage to a valid data set: the reader accepts it or throws input_error, and nothing else
// happens.
#include <sivid/io/dataset.hpp>

#include "io/damaged_text.hpp"
#include "io/support.hpp"
#include "support/catch.hpp"

#include <array>

using namespace sivid;
using io_support::temporary_folder;

namespace {

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
        auto const spoilt = io_support::damaged(original, random, 4);
        folder.write(file, spoilt);
        CAPTURE(file, spoilt);
        try {
            auto const data = read_dataset(folder.path(), model);
            ++accepted;
            REQUIRE(unprintable_in(data.id).empty());
            for (auto const& s : data.scenarios)
                for (std::size_t k = 0; k < s.measurements.size(); ++k) {
                    REQUIRE_FALSE(is_empty(s.measurements[k].bound));
                    REQUIRE(contains(s.measurements[k].bound, *nearest(s.stated[k].value)));
                }
        } catch (input_error const& e) {
            ++refused;
            REQUIRE_FALSE(e.problem().empty());
            REQUIRE_FALSE(e.place().file.empty());
            REQUIRE(unprintable_in(e.what()).empty());
            REQUIRE(std::string_view{e.what()}.size() < 2600);
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
