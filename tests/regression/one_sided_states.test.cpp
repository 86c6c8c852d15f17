// SPDX-License-Identifier: MIT
// A concentration is not negative: a state's own range may be one-sided, wherever it is used.
#include "support/catch.hpp"

#include <sivid/io/dataset/model_names.hpp>
#include <sivid/model/describe.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/model/problem_text.hpp>
#include <sivid/paving/divisors.hpp>
#include <sivid/paving/identify.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

using namespace sivid;
using namespace sivid::literals;

namespace {

/// c' = -k c / (K + c)
template <int Kind>
struct reactor {
    static constexpr auto name = "reactor";
    static constexpr auto states = [] {
        if constexpr (Kind == 0) {
            return sivid::states({{"c", "mol/l", {0, 5}}});
        } else if constexpr (Kind == 1) {
            return sivid::states({{"c", "mol/l", 5}});
        } else {
            return sivid::states({{"c", "mol/l", {5, 0}}});
        }
    }();
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"c", "mol/l"}});
    static constexpr auto constants =
        sivid::constants({{"k", "mol/l/s", 1_dec}, {"K", "mol/l", 2_dec}});
    template <class T>
    states_of<reactor, T> rate(T const&, states_of<reactor, T> const& x,
                               constants_of<reactor, T> const& c,
                               inputs_of<reactor, T> const&) const {
        return {-c[0] * x[0] / (c[1] + x[0])};
    }
    template <class T>
    channels_of<reactor, T> observe(T const&, states_of<reactor, T> const& x,
                                    constants_of<reactor, T> const&,
                                    inputs_of<reactor, T> const&) const {
        return {x[0]};
    }
};

/// Read every half second from 0.5 s on; it starts anywhere in its own range.
template <int Kind>
identification_problem read_from(double start, double error = 0.1) {
    identification_problem p{
        record_model(reactor<Kind>{}), {{"k"}, {}}, {interval(0.5, 2)}, {experiment{}}};
    auto& e = p.experiments.front();
    e.name = "E";
    e.initial = box(names_of(p.model.about).state_ranges);
    double c = start;
    for (int k = 1; k <= 4000; ++k) {
        c -= 1e-3 * c / (2 + c); // Euler's steps are off by less than the errors
        if (k % 500 == 0) e.measurements.push_back({1e-3 * k, 0, interval(c - error, c + error)});
    }
    return p;
}

} // namespace

TEST_CASE("a range from one value to another is where a state may start, and how large it is") {
    auto const m = record_model(reactor<0>{});
    auto const& limit = m.about.states[0].limit;
    CHECK((limit.lower == 0 && limit.upper == 5));
    CHECK(limit == 5.0);
    CHECK(limit.range().lower() == 0);
    auto const range = names_of(m.about).state_ranges.at(0);
    CHECK((range.lower() == 0 && range.upper() == 5));
    CHECK_THAT(describe(m), ContainsSubstring("0 <= c <= 5"));
    auto const both = record_model(reactor<1>{});
    CHECK_THAT(describe(both), ContainsSubstring("|c| <= 5"));
    CHECK(names_of(both.about).state_ranges.at(0).lower() == -5);
    CHECK_THROWS_WITH(record_model(reactor<2>{}), ContainsSubstring("'c', from 5 to 0, is empty"));
    // Another range is another problem.
    CHECK(problem_text(read_from<0>(2)) != problem_text(read_from<1>(2)));
    // Effects keep it, and may bring states with ranges of their own.
    effect e = effects::constant_rate("leak", "c", "mol/l/s", {-1_dec, 1_dec});
    e.on_inputs = [](effect_scope& s) { s.add_state("d", "mol/l", {1, 2}, expression(1)); };
    auto const joined = with(m, std::vector{e});
    CHECK(joined.about.states[0].limit.lower == 0);
    CHECK(joined.about.states[1].limit.lower == 1);
}

TEST_CASE("a truth that starts at an end of its range is not excluded") {
    identify_options options;
    options.search.seconds = 10;
    options.search.boxes = 200;
    for (double const start : {0.0, 5.0, 2.0}) {
        CAPTURE(start);
        auto const found = identify(read_from<0>(start), options);
        CHECK(found.verdict == verdict::consistent);
        CHECK(contains(found.hull, std::vector<double>{1}));
    }
}

TEST_CASE("a range that contradicts the data is refuted, a wider one is not") {
    identify_options options;
    options.search.seconds = 10;
    options.search.boxes = 200;
    for (double const start : {-0.5, 8.0}) {
        CAPTURE(start);
        CHECK(identify(read_from<0>(start), options).verdict == verdict::inconsistent);
    }
    auto wide = read_from<0>(8);
    wide.experiments[0].initial = {interval(0, 10)}; // what the data state goes before
    auto const found = identify(wide, options);
    CHECK(found.verdict != verdict::inconsistent);
    CHECK(contains(found.hull, std::vector<double>{1}));
    CHECK(identify(read_from<1>(-0.5), options).verdict != verdict::inconsistent);
}

TEST_CASE("a divisor that is no zero within a one-sided range is none") {
    auto const zeros_of = [](auto const& p) {
        auto const found = divisors_of(p);
        return found.empty() ? zeros::none : found.front().zeros;
    };
    CHECK(zeros_of(read_from<0>(2)) == zeros::none);
    CHECK(zeros_of(read_from<1>(2)) != zeros::none);
}
