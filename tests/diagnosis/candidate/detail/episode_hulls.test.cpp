// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/episode_hulls.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

using namespace sivid;

namespace {

/// An effect of small_catalogue.hpp that begins in each experiment at a time of its own.
struct begun {
    std::size_t which; ///< in the catalogue
    double size;
    std::vector<double> onsets;
    std::vector<double> ends{9, 9};
};
double const never = 9;

identification_problem with_onsets(begun const& b) {
    auto problem = small_campaign::problem();
    for (std::size_t e = 0; e < 2; ++e) {
        auto const onset = b.onsets[e], end = b.ends[e];
        small_campaign::truth real, always;
        auto const now =
            b.which == 0 ? small_campaign::with_drag(b.size) : small_campaign::with_slope(b.size);
        if (b.which < 2) {
            real.missing = [now, onset, end](double t, double v, double u) {
                return t >= onset && t < end ? now.missing(t, v, u) : 0;
            };
        } else {
            always = small_campaign::with_scale(b.size);
        }
        auto measured = small_campaign::experiment(e, real).measurements;
        auto const scaled = small_campaign::experiment(e, always).measurements;
        for (std::size_t k = 0; k < measured.size(); ++k) {
            bool const acts = measured[k].time >= onset && measured[k].time < end;
            if (acts && b.which == 2) measured[k] = scaled[k];
        }
        problem.experiments[e].measurements = std::move(measured);
    }
    return problem;
}

} // namespace

TEST_CASE("windows of onsets hold the true ones, wherever they are") {
    double const k = 1;
    std::vector<begun> const all{begun{0, 0.3, {0.7, 1.5}}, // at knots and samples
                                 begun{1, 0.4, {0.02, 3.95}},   begun{2, 0.25, {1.1, 2.05}},
                                 begun{0, 0.5, {1.234, 0.333}}, begun{1, -0.3, {2.015, 0}},
                                 begun{1, 0.4, {never, 1}},     begun{2, -0.2, {3.9, 0.1}},
                                 begun{0, 0.3, {0, 0}},         begun{0, 0, {never, never}}};
    for (std::size_t n = 0; n < support::swept(std::size_t{2}, all.size()); ++n) {
        auto const& b = all[n];
        CAPTURE(b.which, b.size, b.onsets[0], b.onsets[1]);
        auto const problem = with_onsets(b);
        auto const found =
            hulls_of_episodes(problem, small_campaign::catalogue()[b.which], {.seconds = 20});
        REQUIRE(found.parameters.size() == 2);
        REQUIRE(found.times.size() == 2);
        CHECK(contains(found.parameters[0], k));
        CHECK(contains(found.parameters[1], b.size));
        for (std::size_t e = 0; e < 2; ++e) {
            auto const& on = found.times[e].on;
            CAPTURE(e, on.lower(), on.upper());
            CHECK(contains(on, std::min(b.onsets[e], 4.0)));
            // One that shows for a while is bounded.
            bool const shows = b.onsets[e] > 0.2 && b.onsets[e] < 3;
            if (shows) CHECK(width(on) < 2.5);
        }
    }
}

TEST_CASE("windows of ends and of episodes hold the true ones") {
    double const k = 1;
    std::vector<begun> const all{begun{1, 0.4, {0.8, 0}, {2.6, 1.5}},
                                 begun{2, 0.3, {0, 0}, {1.7, 2.6}},
                                 begun{0, 0.4, {0, 0}, {2, never}},
                                 begun{0, 0.5, {1.234, 0.333}, {3.1, 2.5}},
                                 begun{2, -0.25, {0.5, never}, {2.55, never}},
                                 begun{1, -0.3, {0, never}, {1.015, never}}};
    for (std::size_t n = 0; n < support::swept(std::size_t{2}, all.size()); ++n) {
        auto const& b = all[n];
        CAPTURE(b.which, b.size, b.onsets[0], b.onsets[1], b.ends[0], b.ends[1]);
        bool const begins = b.onsets[0] > 0 || (b.onsets[1] > 0 && b.onsets[1] < never);
        // What is asked: begins and ends somewhere, wherever that is.
        auto const e =
            only_within(small_campaign::catalogue()[b.which], {"E1", "E2"},
                        begins ? std::vector<double>{1, 1} : std::vector<double>{}, {2, 2});
        auto const found = hulls_of_episodes(with_onsets(b), e, {.seconds = 20});
        CHECK(contains(found.parameters[0], k));
        CHECK(contains(found.parameters[1], b.size));
        for (std::size_t x = 0; x < 2; ++x) {
            auto const& [on, off] = found.times[x];
            CAPTURE(x, on.lower(), on.upper(), off.lower(), off.upper());
            bool const acts = b.onsets[x] < never;
            if (acts) {
                CHECK(contains(on, std::min(b.onsets[x], 4.0)));
                CHECK(contains(off, std::min(b.ends[x], 4.0)));
            }
            if (!begins) CHECK(width(on) == 0);
        }
        // That of the first experiment shows.
        auto const& [on, off] = found.times[0];
        if (begins) CHECK(width(on) < 3.9);
        CHECK(width(off) < 3.9);
    }
}

TEST_CASE("windows of what is remembered for a time hold the true ones, and its true size") {
    std::mt19937 chance(20261128);
    auto const drawn = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(chance);
    };
    int told = 0;
    for (int n = 0; n < support::swept(1, 8); ++n) {
        for (auto const& m : small_campaign::memories()) {
            small_campaign::truth real;
            real.k = drawn(0.7, 1.3);
            real.*m.size = drawn(m.least, m.most);
            bool const ends = n % 2 == 1;
            std::vector<double> from, until;
            for (int e = 0; e < 2; ++e) {
                from.push_back(n == 2 && e == 1 ? 0.0 : drawn(0.5, 2));
                until.push_back(ends ? from.back() + drawn(0.5, 2.5) : 100.0);
            }
            auto const problem = small_campaign::seen_within(real, from, until);
            auto const e = only_within(m.e, {"E1", "E2"}, {1, 1},
                                       ends ? std::vector<double>{3, 3} : std::vector<double>{});
            auto const found = hulls_of_episodes(problem, e, {.seconds = 3});
            CAPTURE(n, m.e.name, real.k, real.*m.size, from, until);
            CAPTURE(found.parameters[0], found.parameters[1]);
            CHECK(contains(found.parameters[0], real.k));
            CHECK(contains(found.parameters[1], real.*m.size));
            for (std::size_t s = 0; s < 2; ++s) {
                auto const& [on, off] = found.times[s];
                CAPTURE(s, on.lower(), on.upper(), off.lower(), off.upper());
                CHECK(contains(on, from[s]));
                if (ends) CHECK(contains(off, std::min(until[s], 4.0)));
                told += width(on) < 2.5 ? 1 : 0;
            }
        }
    }
    CHECK(told >= support::swept(4, 20));
}

TEST_CASE("nothing is known of onsets without time, and none are left where nothing explains") {
    auto const e = small_campaign::catalogue()[1];
    begun const slope{1, 0.4, {1, 2}};
    auto const idle = hulls_of_episodes(with_onsets(slope), e, {.seconds = 0});
    CHECK(width(idle.times[0].on) == 4);
    CHECK(width(idle.parameters[1]) == 2);
    // Which of them, and since when, a name says is left open.
    auto const told =
        hulls_of_episodes(with_onsets(slope), only_within(e, {"E2"}, {3.5}), {.seconds = 20});
    CHECK(contains(told.times[0].on, 1.0));
    CHECK(contains(told.times[1].on, 2.0));
    CHECK(contains(told.parameters[1], 0.4));
    auto const wrong = hulls_of_episodes(with_onsets({2, 0.25, {1.1, 2.05}}), e, {.seconds = 20});
    CHECK((is_empty(wrong.parameters[0]) || !contains(wrong.times[0].on, 0.0) ||
           width(wrong.times[0].on) < 4));
}
