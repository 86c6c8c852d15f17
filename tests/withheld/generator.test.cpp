// SPDX-License-Identifier: MIT
// What the generator writes is read back, without its memory of what it drew: every sample lies
// within its bound of the truth that the label describes, but for the outliers that are allowed.
#include "campaign_files.hpp"
#include "catalogue.hpp"
#include "fit.hpp"
#include "instruments.hpp"
#include "labels.hpp"
#include "measure.hpp"
#include "recorded.hpp"
#include "simulate.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/io/dataset.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

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
    world const w = true_world(l, data.fixed, s.plan);
    channels start{};
    for (std::size_t k = 0; k < channel_count; ++k) start[k] = s.plan.initial[k].middle();
    start = true_start(l, s.plan.name).value_or(start);
    std::size_t broken = 0;
    for (double const m : misfits(s, readings(w, start, s.plan.sample_times, step)))
        broken += m > 1 ? 1U : 0U;
    return broken;
}

bool small_bounds(label const& l) {
    return !l.effects.empty() && l.effects[0].first.starts_with("bounds_");
}

/// The label's fit of the model attains what the label says, and no part needs more.
void check_known_fits(label const& l, recording const& data) {
    fit_problem const problem{data, {}};
    auto const values = l.values("best_fit");
    double const best = problem.inflation(
        problem.start(std::vector<std::pair<std::string, double>>{values.begin(), values.end()}));
    CHECK_THAT(best, WithinRel(l.number("fit_base_best").value(), 1e-4));
    auto const parts = l.values("best_of_parts");
    CHECK(parts.size() == (l.family == "pose" ? 8 : 11));
    for (auto const& [name, x] : parts) {
        CAPTURE(name);
        CHECK(x > 0);
        // A budget of outliers is divided among the parts, which may round it off.
        if (l.family != "outliers") CHECK(x <= best * (1 + 1e-4));
    }
}

} // namespace

TEST_CASE("campaigns of all families lie within their bounds of the truth") {
    temporary_folder const folder;
    REQUIRE(generate(folder.path(), 77, 22, "--jobs 2") == 0);
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
            if (!small_bounds(l)) CHECK(broken <= s.budget);
            outliers += small_bounds(l) ? 0 : broken;
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
        if (small_bounds(l)) {
            CHECK(l.number("fit_true").value() > 1.1);
            CHECK(l.number("fit_true").value() <= 2);
            CHECK(l.number("fit_true") == l.number("fit_base"));
        } else {
            CHECK(l.number("fit_true").value() <= 1);
            CHECK(l.number("holdout_true").value() <= 1);
            if (!l.effects.empty())
                CHECK(l.number("fit_base").value() > (l.family == "weak" ? 0.6 : 1.5));
        }
        check_known_fits(l, data);
        // The library's own reader takes it, and nothing of the truth is in it.
        CHECK_NOTHROW(sivid::read_dataset(place, io_support::hovercraft_names()));
        for (auto const& entry : fs::directory_iterator{place})
            for (auto const& name : l.names())
                CHECK(text_of(entry.path()).find(name) == std::string::npos);
    }
    CHECK(families.size() == usual_families);
    for (auto const& [name, n] : families) {
        CAPTURE(name);
        bool const two =
            name == "single" || name == "pair" || name == "askew" || name == "instrument";
        CHECK(n == (name == "alias" ? 3 : two ? 2 : 1));
    }
}

TEST_CASE("what each family is about") {
    for (std::size_t i = 0; i < 8; ++i) {
        CAPTURE(i);
        auto const alias = draw_campaign(5, i, {family::alias});
        auto const& plan = alias.scenarios.at(3).plan;
        double const period = plan.sample_times.at(0);
        CHECK(period >= 0.2);
        CHECK(period <= 0.5);
        // Between two samples the rudder goes somewhere that the line through its ends does not.
        double hidden = 0;
        for (double const t : plan.sample_times)
            for (double share = 0.1; share < 1; share += 0.1)
                hidden = std::max(hidden, std::abs(plan.rudder.at(t - share * period) -
                                                   (1 - share) * plan.rudder.at(t) -
                                                   share * plan.rudder.at(t - period)));
        CHECK(hidden > 0.03);
        CHECK(plan.rudder.largest_magnitude() < 1); // within the prior of a saturation
        CHECK((alias.effects.empty() || alias.effects[0].starts_with("bounds_")) == (i % 4 == 3));

        auto const part = draw_campaign(5, i, {family::experiments});
        bool acts = false, rests = false;
        for (auto const& s : part.scenarios) {
            acts = acts || (!s.plan.holdout && s.acting.always());
            rests = rests || (!s.plan.holdout && s.acting.never());
        }
        CHECK(acts);
        CHECK(rests);
        CHECK(largest_deviation(part, {}, {}) >= 3);
        CHECK(largest_deviation(part, part.true_effects, {}) >= 3);

        auto const later = draw_campaign(5, i, {family::onset});
        for (auto const& s : later.scenarios) {
            CHECK(s.acting.begins_later());
            CHECK(s.acting.from < s.plan.duration);
            CHECK_FALSE(s.acting.ends());
        }
        auto const law = draw_campaign(5, i, {family::state});
        CHECK(effect_named(law.effects.at(0)) == nullptr);
        CHECK(largest_deviation(law, {}, {}) >= 3);
        auto const remembered = draw_campaign(5, i, {family::memory});
        for (auto const& s : remembered.scenarios) CHECK(s.acting.begins_later());
        auto const& e = remembered.true_effects;
        bool const limited = e.rudder_rate < effect_values{}.rudder_rate;
        double const others =
            e.rudder_lag + e.input_delay + e.motor_lag + e.position_latency + e.rudder_play;
        CHECK((limited || others > 0));
        CHECK(draw_campaign(5, i, {family::rate}).true_effects.rudder_rate < 0.2001);
        CHECK(largest_deviation(remembered, {}, {}) >= 3);
        CHECK(largest_deviation(remembered, e, {}) >= 3); // nor is it there from the start on
        auto const episode = draw_campaign(5, i, {family::episode});
        for (auto const& s : episode.scenarios) {
            CHECK(s.acting.begins_later() == (i % 2 == 1));
            CHECK(s.acting.to < s.plan.duration);
        }
        CHECK(largest_deviation(episode, episode.true_effects, {}) >= 3);
        auto const strong = draw_campaign(5, i, {family::strong});
        bool beyond = false;
        for (auto const& p : effect_named(strong.effects.at(0))->parameters)
            beyond = beyond || strong.true_effects.*p.member < p.lo ||
                     strong.true_effects.*p.member > p.hi;
        CHECK(beyond);
        CHECK(draw_campaign(5, i, {family::three}).effects.size() == 3);
        auto const small = draw_campaign(5, i, {family::bounds});
        double const factor =
            *std::max_element(small.bound_factor.begin(), small.bound_factor.end());
        CHECK(factor >= 1.3);
        CHECK(factor <= 2);
        CHECK(std::count(small.bound_factor.begin(), small.bound_factor.end(), 1) == 5);
        auto const slow = draw_campaign(5, i, {family::slow});
        double const lasts = *std::max_element(slow.slow.begin(), slow.slow.end());
        CHECK(lasts >= 0.2);
        CHECK(lasts <= 1);
        CHECK(inflation_at_truth(slow, true, part::fit) > 1);
        CHECK(inflation_at_truth(slow, true, part::fit) <= 2);
        auto const noisy = draw_campaign(5, i, {family::noise});
        auto const grown = [](channels const& sizes) {
            return std::count_if(sizes.begin(), sizes.end(), [](double x) { return x > 0; });
        };
        CHECK(grown(noisy.jitter) == (i % 2 == 0 ? 1 : 0));
        CHECK(grown(noisy.noise_of_value) == (i % 2 == 0 ? 0 : 1));
        CHECK(largest_growth(noisy) >= 2);
        CHECK(inflation_at_truth(noisy, true, part::fit) > 1);
        CHECK(inflation_at_truth(noisy, true, part::fit) < 1.1 * (1 + largest_growth(noisy)));
    }
    std::set<std::string> kinds;
    for (std::size_t i = 0; i < instrument_kinds().size(); ++i)
        kinds.insert(draw_campaign(5, i, {family::instrument}).effects.at(0));
    CHECK(kinds.size() == instrument_kinds().size());
}

TEST_CASE("lists of families") {
    CHECK(families_named("").empty());
    CHECK(families_named("alias,three") == std::vector{family::alias, family::three});
    CHECK(families_named("alias,alias") == std::vector{family::alias});
    CHECK_THROWS_AS(families_named("alias,unheard"), std::invalid_argument);
    std::map<family, int> seen;
    for (std::size_t i = 0; i < 6; ++i)
        ++seen[family_of(3, i, {family::alias, family::bounds, family::none})];
    CHECK(seen ==
          std::map<family, int>{{family::alias, 2}, {family::bounds, 2}, {family::none, 2}});
    seen.clear();
    for (std::size_t i = 0; i < 22; ++i) ++seen[family_of(3, i)];
    CHECK(seen.size() == usual_families);
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
    for (std::size_t i = 0; i < 42; ++i)
        ++seen[draw_campaign(9, i, {family::single}).effects.at(0)];
    CHECK(seen.size() == 21);
    for (auto const& [name, times] : seen) {
        CAPTURE(name);
        CHECK(times == 2);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        auto const c = draw_campaign(9, i, {family::outside});
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

TEST_CASE("labelled campaigns of others lie within their bounds of the simulated truth") {
    auto const dev = fs::path{SIVID_SOURCE_DIR} / "tests" / "data" / "campaigns";
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
    CHECK(checked == 5);
}

TEST_CASE("readings in steps are whole multiples of them, and a heading stays within one turn") {
    temporary_folder const folder;
    REQUIRE(generate(folder.path(), 5, 8, "--families reading") == 0);
    std::size_t crossed = 0;
    for (auto const& l : read_labels(folder.path() / "labels.tsv")) {
        CAPTURE(l.id, l.effects_text);
        auto const data = read_recording(folder.path() / "campaigns" / l.id);
        auto const& [name, values] = l.effects.at(0);
        bool const wraps = name == "wraps_psi";
        CHECK(wraps == (l.number("fit_true").value() <= 1)); // modulo a turn
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (auto const& s : data.scenarios) {
            channels start{};
            for (std::size_t k = 0; k < channel_count; ++k) start[k] = s.plan.initial[k].middle();
            start = true_start(l, s.plan.name).value_or(start);
            auto const truth = readings(true_world(l, data.fixed, s.plan), start,
                                        s.plan.sample_times, careful_step);
            for (auto const& m : s.samples) {
                double const y = truth[m.time][m.channel];
                if (wraps && m.channel == 5) {
                    low = std::min(low, m.value);
                    high = std::max(high, m.value);
                    crossed += std::abs(m.value - y) > 3 ? 1U : 0U;
                    CHECK(std::abs(apart(m.value, y, values.at(0))) <= 1.001 * m.error);
                } else if (!wraps && channel_names[m.channel] == name.substr(6)) {
                    CHECK(std::abs(std::remainder(m.value, values.at(0))) < 1e-4);
                    CHECK(std::abs(m.value - y) <= m.error + 0.51 * values.at(0));
                } else {
                    CHECK(std::abs(m.value - y) <= m.error);
                }
            }
        }
        if (wraps) CHECK(high - low <= values.at(0));
    }
    CHECK(crossed > 20);
}
