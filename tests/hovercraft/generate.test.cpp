// SPDX-License-Identifier: MIT
#include "craft.hpp"
#include "model.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/app/generate.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset_writer.hpp>

#include <fstream>
#include <iterator>

using namespace sivid::app;
using sivid::exact_decimal;

namespace {

exact_decimal dec(char const* text) { return exact_decimal::parse(text).value(); }

std::vector<unknown_parameter> report_priors() {
    return {{"Sv", dec("0.20"), dec("0.25")},
            {"Sg", dec("0.0042"), dec("0.0754")},
            {"L", dec("0.25"), dec("0.35")}};
}

generate_options h3_options() {
    generate_options o;
    o.id = "h3";
    o.noise = 0;
    o.unknown = report_priors();
    for (auto const* e : {"0.02", "0.02", "0.05", "0.02", "0.02", "0.03"})
        o.absolute.push_back(dec(e));
    return o;
}

struct fixture {
    sivid::recorded_model model = sivid::record_model(hovercraft{});
    sivid::model_names names = sivid::names_of(model.about);
    generated make(std::string const& scenario, generate_options const& o) const {
        return generate(model, find_scenarios(hovercraft_example::craft(), scenario), o);
    }
};

std::string text_of(std::filesystem::path const& file) {
    std::ifstream in{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
}

/// The true channels at the times of the samples, enclosed again from the data set alone.
std::vector<sivid::interval> true_outputs(fixture const& f, generated const& g,
                                          sivid::scenario const& s,
                                          std::map<std::string, exact_decimal> const& set) {
    sivid::parameter_choice choice;
    for (auto const& [name, value] : set) choice.fixed[name] = *sivid::enclose(value);
    for (auto const& [name, value] : g.truth) choice.fixed[name] = *sivid::enclose(value);
    std::vector<sivid::signal> inputs;
    sivid::box start(s.initial.size());
    for (auto const& i : s.inputs) inputs.push_back(i.signal);
    for (std::size_t i = 0; i < start.size(); ++i) start[i] = s.initial[i].range;
    auto const flow = std::make_shared<sivid::flow const>(f.model, choice, inputs);
    auto const tube = sivid::integrate<sivid::interval>(flow, start, sivid::box{}, 0, s.duration);
    REQUIRE(tube.complete());
    std::vector<sivid::interval> result;
    for (auto const& m : s.measurements) result.push_back(tube.observe_at(m.time)[m.channel]);
    return result;
}

} // namespace

TEST_CASE("the bundled data of section 4.1 are what their commands make, to the last digit") {
    fixture const f;
    namespace fs = std::filesystem;
    fs::path const bundled = fs::path{SIVID_SOURCE_DIR} / "examples/hovercraft/data";
    auto const same = [&](generated const& made, fs::path const& folder) {
        for (auto const& s : made.data.scenarios) {
            INFO(folder << " " << s.name);
            CHECK(sivid::inputs_csv(s, f.names) == text_of(folder / (s.name + ".inputs.csv")));
            CHECK(sivid::measurements_csv(s, f.names) ==
                  text_of(folder / (s.name + ".measurements.csv")));
        }
        CHECK(made.outliers.size() == 2);
    };
    generate_options o;
    o.unknown = report_priors();
    o.outliers = 2;
    o.relative = dec("0.1");
    for (std::string const scenario : {"S1", "S2", "S3"}) {
        same(f.make(scenario, o), bundled / "section41" / scenario);
    }
    o.relative.reset();
    o.absolute.assign(6, dec("0.1"));
    o.rate = 2;
    o.outlier_size = 12;
    o.seed = 33;
    same(f.make("weave", o), bundled / "figure41");
}

TEST_CASE("the bundled campaign is what `generate` makes, to the last digit") {
    fixture const f;
    auto const made = f.make("S3", h3_options());
    REQUIRE(made.data.scenarios.size() == 1);
    namespace fs = std::filesystem;
    fs::path const bundled = fs::path{SIVID_SOURCE_DIR} / "examples/hovercraft/data/h3";
    CHECK(sivid::inputs_csv(made.data.scenarios[0], f.names) == text_of(bundled / "S3.inputs.csv"));
    CHECK(sivid::measurements_csv(made.data.scenarios[0], f.names) ==
          text_of(bundled / "S3.measurements.csv"));
    CHECK(sivid::dataset_json(made.data, f.names) == text_of(bundled / "dataset.json"));
}

TEST_CASE("the planted truth lies within the bound of every sample that is not an outlier") {
    fixture const f;
    auto const absolute = h3_options().absolute;
    for (std::string const kind : {"relative", "absolute", "combined"}) {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            INFO(kind << " " << seed);
            auto o = h3_options();
            o.absolute = kind == "relative" ? std::vector<exact_decimal>{} : absolute;
            if (kind != "absolute") o.relative = dec("0.03");
            o.noise = seed == 1 ? 1.0 : 0.8;
            o.seed = seed;
            o.outliers = 2;
            o.set = {{"Sg", dec("0.05")}, {"m", dec("1.31")}};
            if (kind == "absolute" && seed == 4) o.decimals = 3;
            auto const made = f.make("all", o);
            CHECK(made.data.fixed.size() == 1);
            CHECK(made.outliers.size() == 6);
            CHECK((made.left_out > 0) == (kind == "relative"));
            for (auto const& s : made.data.scenarios) {
                auto const truth = true_outputs(f, made, s, o.set);
                std::size_t violated = 0;
                bool noisy = false;
                for (std::size_t i = 0; i < truth.size(); ++i) {
                    auto const& m = s.stated[i];
                    // In exact decimals: the enclosures of the ends point the other way.
                    bool const inside =
                        sivid::enclose(m.value - m.error)->upper() <= truth[i].lower() + 1e-9 &&
                        truth[i].upper() - 1e-9 <= sivid::enclose(m.value + m.error)->lower();
                    violated += inside ? 0 : 1;
                    CHECK(inside != disjoint(truth[i], s.measurements[i].bound));
                    noisy = noisy || std::abs(*nearest(m.value) - mid(truth[i])) > 1e-4;
                }
                CHECK(violated == 2);
                CHECK(noisy);
                CHECK(made.data.outlier_budget(s) >= 2);
            }
        }
    }
}

TEST_CASE("the same seed gives the same data, another one does not") {
    fixture const f;
    auto o = h3_options();
    o.noise = 0.5;
    auto const text = [&] {
        return sivid::measurements_csv(f.make("S1", o).data.scenarios[0], f.names);
    };
    auto const first = text();
    CHECK(text() == first);
    o.seed = 2;
    CHECK(text() != first);
}

TEST_CASE("a generated data set is read back as it was") {
    fixture const f;
    io_support::temporary_folder const folder;
    auto o = h3_options();
    o.outliers = 1;
    o.interpolation = sivid::interpolation::hold;
    auto const made = f.make("all", o);
    sivid::write_dataset(made.data, f.names, folder.path());
    auto const back = sivid::read_dataset(folder.path(), f.names);
    CHECK(sivid::dataset_json(back, f.names) == sivid::dataset_json(made.data, f.names));
    for (std::size_t s = 0; s < 3; ++s)
        CHECK(sivid::measurements_csv(back.scenarios[s], f.names) ==
              sivid::measurements_csv(made.data.scenarios[s], f.names));
}

TEST_CASE("an uncertain start is stated, and the truth starts in its middle") {
    fixture const f;
    auto const made = f.make("dock", h3_options());
    auto const& u = made.data.scenarios[0].initial[0];
    REQUIRE(u.stated);
    CHECK(u.stated->lower == dec("0.95"));
    CHECK(u.stated->upper == dec("1.05"));
}

TEST_CASE("requests that cannot be met are refused") {
    fixture const f;
    auto const refused = [&](auto const& change, std::string const& message) {
        auto o = h3_options();
        change(o);
        CHECK_THROWS_WITH(f.make("S1", o), ContainsSubstring(message));
    };
    refused([](auto& o) { o.absolute.clear(); }, "no error bound");
    refused([](auto& o) { o.absolute.resize(2); }, "one for each of the 6");
    refused([](auto& o) { o.noise = 1.5; }, "share of the bound");
    refused([](auto& o) { o.set["Sv"] = dec("0.3"); }, "outside its prior");
    refused([](auto& o) { o.set["Zz"] = dec("1"); }, "unknown constant");
    refused([](auto& o) { o.outliers = 1000; }, "more outliers");
    refused([](auto& o) { o.rate = 0; }, "rate");
    refused([](auto& o) { o.decimals = 1; }, "too small for 1 decimals");
    refused(
        [](auto& o) {
            o.outliers = 1;
            o.outlier_size = 0.5;
        },
        "larger --outlier-size");
}
