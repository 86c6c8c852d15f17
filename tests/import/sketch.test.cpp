// SPDX-License-Identifier: MIT
// The Arduino sketch of examples/import, run on the host: what it sends is what the importer reads.
#include "io/import_support.hpp"

#include <cmath>
#include <sstream>

#define ARDUINO 10819 // as its own compiler does; it also keeps this file out of batches
#include "../../examples/import/arduino/sivid_logger/sivid_logger.ino"

using namespace io_support;

namespace {

struct sent_line {
    std::uint32_t time;
    int pwm, count, adc;
};

/// Runs the sketch on a board whose encoder turns; what it should have said.
std::vector<sent_line> run_board(std::size_t lines) {
    auto& b = the_board();
    b = {};
    auto const started = b.clock = 0xFFFFFFFFu - 900'000; // the clock wraps after 0.9 s
    count = 0;
    periods = 0;
    setup();
    std::vector<sent_line> result;
    std::mt19937_64 random{3};
    while (result.size() < lines) {
        b.clock += 200 + static_cast<std::uint32_t>(random() % 300);
        // The shaft swings by 1 rad; where a mark is passed, A changes and B is as the direction
        // asks.
        double const t = 1e-6 * static_cast<double>(b.clock - started);
        auto const wanted = std::lround(std::sin(3 * t) / 0.00523598775598);
        while (count != wanted) {
            b.pins[encoder_a] = 1 - b.pins[encoder_a];
            b.pins[encoder_b] = count < wanted ? b.pins[encoder_a] : 1 - b.pins[encoder_a];
            b.edge();
        }
        b.pins[current_pin] = static_cast<int>(random() % 1024);
        auto const before = b.sent.size();
        loop();
        if (b.sent.size() > before) result.push_back({b.clock, pwm, count, b.pins[current_pin]});
    }
    return result;
}
std::string mapping() {
    std::ifstream in{std::string{SIVID_SOURCE_DIR} + "/examples/import/arduino/mapping.json"};
    return {std::istreambuf_iterator<char>{in}, {}};
}
sivid::imported_dataset import_bench(std::string const& log) {
    temporary_folder const folder;
    folder.write("mapping.json", mapping());
    folder.write("bench.log", log);
    return import_in(folder);
}

} // namespace

TEST_CASE("what the sketch sends is read, through the wrap of its clock", "[import]") {
    auto const truth = run_board(1200); // 6 s
    CHECK(the_board().interrupts);
    CHECK(the_board().sent.rfind("# sivid_logger", 0) == 0);
    auto const r = import_bench(the_board().sent);
    CHECK(noted(r.protocol, "check sum").empty());
    CHECK(noted(r.protocol, "the counter wraps").size() == 1);
    REQUIRE(r.data.scenarios.size() >= 5);
    // Each reading of a window is that of the encoder at this time.
    std::size_t measured = 0, found = 0;
    for (std::size_t i = 0; i < r.data.scenarios.size(); ++i) {
        auto const& s = r.data.scenarios[i];
        double const begin = std::stod(r.protocol.scenarios.at(i).begin);
        measured += s.measurements.size();
        for (std::size_t k = 0; k < s.measurements.size(); ++k)
            for (auto const& line : truth) {
                double const t = 1e-6 * static_cast<std::uint32_t>(line.time - truth[0].time);
                if (std::abs(t - begin - s.measurements[k].time) > 1e-7) continue;
                double const angle = *sivid::nearest(s.stated[k].value);
                found += std::abs(0.005235987755985 * line.count - angle) < 1e-9 ? 1 : 0;
            }
    }
    CHECK(measured >= 500);
    CHECK(found == measured);
    CHECK(r.data.scenarios[3].role == sivid::scenario_role::holdout);
    auto const& volts = r.data.scenarios[0].inputs.at(0).signal.values();
    CHECK(std::abs(volts.at(0) - 12.0 * truth[0].pwm / 255) < 1e-12);
}

TEST_CASE("garbled and cut lines of the sketch do not get through", "[import]") {
    auto const truth = run_board(1200);
    std::mt19937_64 random{17};
    std::istringstream in{the_board().sent};
    std::string log, line;
    std::vector<std::size_t> spoilt;
    for (std::size_t number = 1; std::getline(in, line); ++number) {
        if (number > 3 && number < 1190 && random() % 10 == 0) {
            auto const at = random() % line.size();
            switch (random() % 3) {
            case 0: // a digit for another: without a check sum nothing would be seen
                line[at] = line[at] == '7' ? '8' : '7';
                break;
            case 1:
                line.erase(at, 1);
                break;
            default:
                line.insert(at, 1, static_cast<char>('0' + random() % 10));
            }
            spoilt.push_back(number);
        }
        log += line + "\n";
    }
    auto const r = import_bench(log);
    CHECK(noted(r.protocol, "no check sum, or a wrong one") == spoilt);
    CHECK(spoilt.size() > 60);
}
