// SPDX-License-Identifier: MIT
// What the generator writes is read back, without its memory of what it drew: every sample lies
// within its bound of the truth that the label describes, but for the outliers that are allowed.
#include "campaign_files.hpp"
#include "labels.hpp"
#include "measure.hpp"
#include "recorded.hpp"
#include "simulate.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/io/dataset.hpp>

#include <cstdlib>
#include <map>
#include <sstream>

using namespace withheld;
using io_support::temporary_folder;
namespace fs = std::filesystem;

namespace {

int generate(fs::path const& folder, int seed, int count, std::string const& more = "") {
    auto const command = std::string{"\"" WITHHELD_GENERATE "\" --seed "} + std::to_string(seed) +
                         " --count " + std::to_string(count) + " --out \"" +
                         (folder / "campaigns").string() + "\" --labels \"" +
                         (folder / "labels.tsv").string() + "\" " + more;
    return std::system(command.c_str());
}

std::string text_of(fs::path const& file) {
    std::ostringstream text;
    text << std::ifstream{file}.rdbuf();
    return text.str();
}

/// How many samples of the scenario break their bound under the truth of the label.
std::size_t violations(label const& l, recording const& data, recorded_scenario const& s,
                       double step) {
    world w = world_of(l, data.fixed);
    w.motor = s.plan.motor;
    w.rudder = s.plan.rudder;
    w.gusts = true_gusts(l, s.plan.name);
    channels start{};
    for (std::size_t k = 0; k < channel_count; ++k) start[k] = s.plan.initial[k].middle();
    start = true_start(l, s.plan.name).value_or(start);
    std::size_t broken = 0;
    for (double const m : misfits(s, readings(w, start, s.plan.sample_times, step)))
        broken += m > 1 ? 1U : 0U;
    return broken;
}

} // namespace

TEST_CASE("campaigns of all families lie within their bounds of the truth") {
    temporary_folder const folder;
    REQUIRE(generate(folder.path(), 77, 22) == 0);
    auto const labels = read_labels(folder.path() / "labels.tsv");
    REQUIRE(labels.size() == 22);
    std::map<std::string, std::size_t> families;
    for (auto const& l : labels) {
        CAPTURE(l.id, l.effects_text);
        ++families[l.family];
        auto const place = folder.path() / "campaigns" / l.id;
        auto const data = read_recording(place);
        CHECK(data.id == l.id);
        CHECK(data.scenarios.size() == 7);
        CHECK(data.unknown.size() == (l.family == "wide" ? 9 : 3));
        std::size_t outliers = 0;
        for (auto const& s : data.scenarios) {
            CAPTURE(s.plan.name);
            // Another step than the generator's.
            auto const broken = violations(l, data, s, careful_step / 2);
            CHECK(broken <= s.budget);
            outliers += broken;
            CHECK((s.budget > 0) == (l.family == "outliers"));
            if (auto const start = true_start(l, s.plan.name))
                for (std::size_t k = 0; k < channel_count; ++k) {
                    CHECK((*start)[k] >= s.plan.initial[k].lo);
                    CHECK((*start)[k] <= s.plan.initial[k].hi);
                }
            for (auto const& m : s.samples) CHECK((l.family != "pose" || m.channel >= 3));
        }
        CHECK(std::to_string(outliers) == l.more.at("outliers"));
        CHECK((outliers > 0) == (l.family == "outliers"));
        for (auto const& u : data.unknown) {
            CHECK(l.constants_true.at(u.name) > u.prior.lo);
            CHECK(l.constants_true.at(u.name) < u.prior.hi);
        }
        CHECK(l.number("fit_true").value() <= 1);
        CHECK(l.number("holdout_true").value() <= 1);
        if (!l.effects.empty())
            CHECK(l.number("fit_base").value() > (l.family == "weak" ? 0.6 : 1.5));
        // The library's own reader takes it, and nothing of the truth is in it.
        CHECK_NOTHROW(sivid::read_dataset(place, io_support::hovercraft_names()));
        for (auto const& entry : fs::directory_iterator{place})
            for (auto const& name : l.names())
                CHECK(text_of(entry.path()).find(name) == std::string::npos);
    }
    CHECK(families == std::map<std::string, std::size_t>{{"single", 6},
                                                         {"weak", 2},
                                                         {"wide", 2},
                                                         {"pose", 2},
                                                         {"pair", 4},
                                                         {"outliers", 2},
                                                         {"outside", 2},
                                                         {"none", 2}});
}

TEST_CASE("a campaign depends on the seed and its number alone") {
    temporary_folder const a, b, c;
    REQUIRE(generate(a.path(), 5, 4) == 0);
    REQUIRE(generate(b.path(), 5, 2) == 0);
    REQUIRE(generate(c.path(), 6, 1) == 0);
    for (auto const* file :
         {"w0001/dataset.json", "w0001/S4.inputs.csv", "w0001/H1.measurements.csv"}) {
        auto const name = fs::path{"campaigns"} / file;
        CHECK_FALSE(text_of(a.path() / name).empty());
        CHECK(text_of(a.path() / name) == text_of(b.path() / name));
    }
    auto const first = fs::path{"campaigns/w0000/S2.measurements.csv"};
    CHECK(text_of(a.path() / first) != text_of(c.path() / first));
}

TEST_CASE("one family, all effects in turn, and labels stay outside of the data") {
    std::map<std::string, int> seen;
    for (std::size_t i = 0; i < 42; ++i) ++seen[draw_campaign(9, i, family::single).effects.at(0)];
    CHECK(seen.size() == 21);
    for (auto const& [name, times] : seen) {
        CAPTURE(name);
        CHECK(times == 2);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        auto const c = draw_campaign(9, i, family::outside);
        CHECK(largest_deviation(c, {}, {}) >= 3);
    }
    temporary_folder const folder;
    auto const inside =
        " --labels \"" + (folder.path() / "campaigns" / "labels.tsv").string() + '"';
    CHECK(std::system(("\"" WITHHELD_GENERATE "\" --count 1 --out \"" +
                       (folder.path() / "campaigns").string() + '"' + inside + " 2> \"" +
                       (folder.path() / "message").string() + '"')
                          .c_str()) != 0);
    CHECK_FALSE(fs::exists(folder.path() / "campaigns"));
}

#ifdef SIVID_SHARED_DIR
TEST_CASE("labelled campaigns of others lie within their bounds of the simulated truth") {
    auto const dev = fs::path{SIVID_SHARED_DIR} / "data" / "dev";
    if (!fs::exists(dev)) return;
    std::size_t checked = 0;
    for (auto const& l : read_labels(dev / "labels.tsv")) {
        CAPTURE(l.id, l.effects_text);
        if (l.family == "outside") continue; // the label does not say how strong and when
        auto const data = read_recording(dev / l.id);
        if (l.family == "weak") continue; // nor where the uncertain starts were
        for (auto const& s : data.scenarios) {
            CAPTURE(s.plan.name);
            CHECK(violations(l, data, s, 1e-3) <= s.budget);
        }
        ++checked;
    }
    CHECK(checked == 13);
}
#endif
