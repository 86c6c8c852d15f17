// SPDX-License-Identifier: MIT
// A record whose truth is known, through mapping, windows, thinning and proposed starts into
// identify: the truth is never excluded.
#include <sivid/importing/import_writer.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>

#include "../../examples/measured/servo_axis/linear_axis.hpp"
#include "io/import_support.hpp"

#include <cmath>

using namespace sivid;
using namespace io_support;

namespace {

/// M v' = F - F_v v with the force held: q and v at any time, exactly but for the rounding.
struct planted_axis {
    double mass = 95, friction = 200, step = 0.05;
    std::vector<double> force, q{0.1}, v{0.2}; ///< q and v at the steps

    explicit planted_axis(std::mt19937_64& random, std::size_t steps) {
        for (std::size_t k = 0; k < steps; ++k) {
            force.push_back(static_cast<double>(random() % 201) - 100);
            auto const [a, b] = after(k, step);
            q.push_back(a);
            v.push_back(b);
        }
    }
    [[nodiscard]] std::pair<double, double> after(std::size_t k, double t) const {
        double const rate = friction / mass, end = force[k] / friction, d = std::exp(-rate * t);
        return {q[k] + end * t + (v[k] - end) * (1 - d) / rate, end + (v[k] - end) * d};
    }
    [[nodiscard]] std::pair<double, double> at(double t) const {
        auto const k = std::min(static_cast<std::size_t>(t / step + 1e-9), force.size() - 1);
        return after(k, t - step * static_cast<double>(k));
    }
};

constexpr double bound = 2e-5;

/// Every millisecond: time, force, position with errors that fill the bound, and outliers: the
/// first reading of every second and some others.
std::string table_of(planted_axis const& axis, std::size_t rows, bool outliers,
                     std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit{-1, 1};
    std::string text = "ms;force;pos\n";
    for (std::size_t i = 0; i < rows; ++i) {
        double const t = 1e-3 * static_cast<double>(i);
        double e =
            (random() % 2 == 0 ? unit(random) : (random() % 2 == 0 ? 1.0 : -1.0)) * (bound - 2e-8);
        if (outliers && i % 1000 == 1) e = 0.01 * unit(random);
        if (outliers && i % 1000 == 121) e = -0.02; // kept by thinning to every tenth
        auto const k = std::min<std::size_t>(i / 50, axis.force.size() - 1);
        text += std::to_string(i) + ";" + std::to_string(static_cast<int>(axis.force[k])) + ";" +
                exact_decimal::rounded(axis.at(t).first + e, 8).text() + "\n";
    }
    return text;
}

std::string mapping(char const* fraction, char const* acceleration, char const* position) {
    return text_of(R"({
  "format": "sivid-mapping-1", "id": "planted", "model": "linear_axis",
  "parameters": { "M": { "prior": [80, 120] }, "F_v": { "prior": [150, 260] } },
  "max_outlier_fraction": )",
                   fraction, R"(,
  "scenarios": [ { "name": "run", "file": "a.csv", "source": { "separator": ";" },
    "time": { "column": "ms", "unit": "ms", "offset": 0 }, "interpolation": "hold", "thin": 10,
    "inputs": { "F": { "column": "force" } },
    "channels": { "q": { "column": "pos", "error": 0.00002 } },
    "windows": { "length": 0.4, "every": 1, "first": 0.0005, "holdout": 4 },
    "initial": { "q": )",
                   position, R"(, "v": { "rate_of": "q", "acceleration": )", acceleration,
                   "} } } ]\n}");
}

} // namespace

TEST_CASE(
    "a planted record, cut, thinned and started by the mapping: its truth is never excluded") {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        bool const outliers = seed % 2 == 0;
        CAPTURE(seed, outliers);
        std::mt19937_64 random{seed};
        planted_axis const axis{random, 100};
        temporary_folder const folder;
        // |v'| <= (100 + 200 0.5) / 95 = 2.11, |v| <= 0.5.
        folder.write("mapping.json",
                     outliers ? mapping("0.05", "2.2", R"({ "channel": "q", "rate": 0.5 })")
                              : mapping("0", "2.2", "\"propose\""));
        folder.write("a.csv", table_of(axis, 5000, outliers, random));
        (void)import_in(folder);
        auto const model = record_model(linear_axis{});
        auto const data = read_dataset(folder.path() / "out", names_of(model.about));
        REQUIRE(data.scenarios.size() == 5);
        CHECK(data.scenarios[3].role == scenario_role::holdout);
        CHECK(data.assumptions.size() >= 4);
        for (auto const& s : data.scenarios) {
            // Without outliers a window begins with its first reading, otherwise where it is said.
            double const number = std::stod(s.name.substr(5)) - 1;
            auto const [q, v] = axis.at(number + (outliers ? 0.0005 : 0.001));
            CAPTURE(s.name, s.initial[0].range, s.initial[1].range);
            CHECK(contains(s.initial[0].range, q));
            CHECK(contains(s.initial[1].range, v));
            CHECK(width(s.initial[1].range) < (outliers ? 0.4 : 0.05)); // of 1
            CHECK(s.measurements.size() == 40 + (s.measurements.front().time == 0));
        }
        auto const problem = problem_from_dataset(data, model);
        CHECK(problem.experiments.size() == 4);
        identify_options options;
        options.search.seconds = 30;
        options.search.boxes = 60;
        auto const found = identify(problem, options);
        CHECK(found.verdict != verdict::inconsistent);
        CHECK(contains(found.hull[0], axis.mass));
        CHECK(contains(found.hull[1], axis.friction));
        if (!outliers) CHECK(width(found.hull[1]) < 60); // of 110
    }
}

TEST_CASE("a bound of the acceleration that the motion breaks is refused where the data show it") {
    std::mt19937_64 random{9};
    planted_axis const axis{random, 100};
    auto const table = table_of(axis, 5000, false, random);
    auto const message = refusal(mapping("0", "0.01", "\"propose\""), table);
    CHECK_THAT(message, ContainsSubstring("/scenarios/0/initial/v: the start of 'v' in 'run-w") &&
                            ContainsSubstring("no value agrees with the readings of 'q'"));
}

TEST_CASE("outliers are never denied, nor believed at a start") {
    std::mt19937_64 random{10};
    planted_axis const axis{random, 100};
    auto const table = table_of(axis, 5000, true, random);
    // One reading at the start may be one of them.
    CHECK_THAT(refusal(mapping("0.05", "2.2", "\"propose\""), table),
               ContainsSubstring("/scenarios/0/initial/q: the start of 'q' in 'run-w5': the one "
                                 "reading at the start may be an outlier") &&
                   ContainsSubstring("\"rate\""));
    // 0.01 of 5000 readings are 50 outliers, 0.01 of a window's 40 none.
    CHECK_THAT(refusal(mapping("0.01", "2.2", R"({ "channel": "q", "rate": 0.5 })"), table),
               ContainsSubstring("/max_outlier_fraction: of the 40 measurements of 'run-w1' 0.01 "
                                 "allows no outlier"));
}

namespace {

/// The record with the force of these steps unrecorded, whole steps as they are.
std::string without_force(std::string const& table, std::size_t from, std::size_t to) {
    std::string result;
    std::size_t number = 0;
    for (auto const& line : lines_of(table)) {
        auto text = std::string{line.text};
        if (++number >= from && number < to) {
            auto const first = text.find(';'), second = text.find(';', first + 1);
            text.erase(first + 1, second - first - 1);
        }
        result += text + "\n";
    }
    return result;
}

} // namespace

TEST_CASE("forces that were not recorded are bridged as the mapping says, and results name it") {
    std::mt19937_64 random{11};
    planted_axis axis{random, 100};
    auto const table = table_of(axis, 5000, false, random);
    auto const spoilt =
        without_force(table, 1130, 1230); // a tenth of a second of the second window
    auto const plain = mapping("0", "2.2", "\"propose\"");
    CHECK_THAT(
        refusal(plain, spoilt),
        ContainsSubstring("/scenarios/0/inputs/F") &&
            ContainsSubstring("100 samples of this input are missing, first before line 1230") &&
            ContainsSubstring("state \"bridge\": 0.101"));
    auto const model = record_model(linear_axis{});
    auto const identified = [&](std::string const& force) {
        temporary_folder const folder;
        folder.write("mapping.json", replaced(plain, "\"column\": \"force\"", force));
        folder.write("a.csv", spoilt);
        auto const imported = import_in(folder);
        CHECK(noted(imported.protocol, "where samples are missing") ==
              std::vector<std::size_t>{1230});
        auto const problem =
            problem_from_dataset(read_dataset(folder.path() / "out", names_of(model.about)), model);
        identify_options options;
        options.search.seconds = 30;
        options.search.boxes = 60;
        return identify(problem, options);
    };
    auto const held = identified(R"("column": "force", "bridge": 0.101)");
    CHECK(held.assumptions.front() ==
          "inputs exact; input F: held over 100 missing samples, longest gap 0.101 s");
    // With a bound that holds nothing is assumed, and the truth is never excluded.
    auto const bounded = identified(
        R"("column": "force", "error": 1e-9, "bridge": {"longest": 0.101, "error": 200})");
    CHECK(bounded.assumptions.front() == "inputs within their stated errors");
    CHECK(bounded.verdict != verdict::inconsistent);
    CHECK(contains(bounded.hull[0], axis.mass));
    CHECK(contains(bounded.hull[1], axis.friction));
}
