// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/gap/detail/confined_gap.hpp>

#include <sivid/approximate/fit/fit.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

using names = std::vector<std::string>;

/// So many experiments, of which some are of another truth.
identification_problem campaign(std::size_t count, std::vector<std::size_t> const& other,
                                small_campaign::truth const& real,
                                small_campaign::truth const& elsewhere = {}) {
    auto p = small_campaign::problem();
    p.experiments.clear();
    for (std::size_t e = 0; e < count; ++e) {
        bool const is_other = std::find(other.begin(), other.end(), e) != other.end();
        p.experiments.push_back(small_campaign::experiment(e, is_other ? real : elsewhere));
    }
    return p;
}

std::vector<confined_gap> confined(identification_problem const& p,
                                   confinement_options const& options = {}) {
    auto const at = fit(p);
    auto const whole = bound_inflation(p, &at);
    return find_confined_gaps(p, at, whole.value, options);
}

/// The factor by which a part must grow at one k, where all others are met; infinite where they are
/// not. The cart's simulation is the fit's, not the proofs'.
double needed(identification_problem const& p, confined_gap const& c, double k) {
    std::vector<std::vector<double>> starts;
    for (auto const& e : p.experiments) starts.push_back(mid(e.initial));
    auto const at = approximate_fitter(p).at({k}, starts);
    double part = 0, others = 0;
    for (std::size_t e = 0; e < p.experiments.size(); ++e) {
        auto const data = sorted(p.experiments[e].measurements);
        auto const& in = c.scenarios;
        bool const here =
            in.empty() || std::find(in.begin(), in.end(), p.experiments[e].name) != in.end();
        for (std::size_t n = 0; n < data.size(); ++n) {
            auto const& channel = p.model.about.channels[data[n].channel].name;
            double& most = here && (c.channel.empty() || c.channel == channel) ? part : others;
            most = std::max(most, std::abs(at.residuals[e][n]));
        }
    }
    return others <= 1 ? part : detail::infinity;
}

/// The problem with the bounds of a part so many times as wide.
identification_problem loosened(identification_problem const& p, data_part const& part,
                                double factor) {
    return bound_growth::of(p, part)(p, factor - 1);
}

/// What is claimed of the factor, against a fine grid of the only unknown.
void attack(identification_problem const& p, confined_gap const& c) {
    double least = detail::infinity, best = 1;
    auto const look = [&](double from, double to, double step) {
        for (double k = from; k <= to; k += step) {
            double const f = needed(p, c, k);
            if (f < least) least = f, best = k;
        }
    };
    look(0.5, 1.5, 1e-3);
    look(best - 1e-3, best + 1e-3, 2e-6);
    CAPTURE(c.channel, c.scenarios, c.factor.lower(), c.factor.upper(), least);
    CHECK(c.factor.lower() <= least);
    CHECK(c.factor.upper() >= 0.999 * least); // the grid may miss the best by little
    CHECK(c.factor.upper() <= 1.05 * least);  // it is found
    CHECK(c.factor.lower() >= 0.9 * least);   // and proved to be needed
    REQUIRE(c.witness.parameters.size() == 1);
    CHECK(needed(p, c, c.witness.parameters[0].value) <= c.factor.upper());
}

} // namespace

TEST_CASE("a sensor that is wrong, an experiment that is another: they stand alone") {
    auto const scaled = small_campaign::problem(small_campaign::with_scale(0.2));
    auto found = confined(scaled);
    REQUIRE(found.size() == 1);
    CHECK(found[0].channel == "p");
    CHECK(found[0].scenarios.empty());
    attack(scaled, found[0]);

    auto const third = campaign(4, {2}, small_campaign::with_drag(0.3));
    found = confined(third);
    REQUIRE(found.size() == 1);
    CHECK(found[0].channel.empty());
    CHECK(found[0].scenarios == names{"E3"});
    attack(third, found[0]);

    auto const both = campaign(4, {1}, small_campaign::with_scale(0.3));
    found = confined(both);
    REQUIRE(found.size() == 1);
    CHECK(found[0].channel == "p");
    CHECK(found[0].scenarios == names{"E2"});
    attack(both, found[0]);
}

TEST_CASE("bounds that are too small are found with their factor") {
    for (double const factor : {1.3, 2.0}) {
        auto p = small_campaign::problem();
        for (auto& e : p.experiments) {
            for (auto& m : e.measurements) {
                double const y = mid(m.bound), size = 0.03 * 0.6 / factor;
                if (m.channel == 1) m.bound = interval(y - size, y + size);
            }
        }
        auto const found = confined(p);
        REQUIRE(found.size() == 1);
        CHECK(found[0].channel == "v");
        CHECK(found[0].scenarios.empty());
        CHECK(found[0].factor.lower() <= factor);
        attack(p, found[0]);
    }
}

namespace {

/// Readings of the speed that are off by so much of what `size` says of it, at most.
template <class Size, class Slow>
identification_problem noisy_speed(draws& d, std::size_t experiments, Size const& size,
                                   Slow const& slow) {
    auto p = campaign(experiments, {}, {});
    for (auto& e : p.experiments) {
        auto const& u = std::get<sampled_signal>(e.inputs[0]);
        for (auto& m : e.measurements) {
            if (m.channel != 1) continue;
            double const v = mid(m.bound),
                         off = d.uniform(-1, 1) * size(v, u.approximate(m.time) - v / 4) + slow();
            m.bound = interval(v + off - rad(m.bound), v + off + rad(m.bound));
        }
    }
    return p;
}
template <class Size>
identification_problem noisy_speed(draws& d, std::size_t experiments, Size const& size) {
    return noisy_speed(d, experiments, size, [] { return 0.0; });
}

} // namespace

TEST_CASE(
    "noise that grows with the value or the rate of a channel is told from bounds too small") {
    draws d(77);
    for (double const size : {0.1, 0.3}) {
        auto const by_value =
            confined(noisy_speed(d, 3, [&](double v, double) { return size * v; }));
        REQUIRE(by_value.size() == 1);
        CHECK(by_value[0].channel == "v");
        REQUIRE(by_value[0].grows);
        CHECK(by_value[0].grows->what == noise_growth::with::value);
        CHECK(by_value[0].grows->coefficient.lower() > 0);
        CHECK(by_value[0].grows->coefficient.lower() <= size);
        CHECK(by_value[0].grows->coefficient.upper() >= 0.5 * size);

        auto const by_rate =
            confined(noisy_speed(d, 3, [&](double, double a) { return size * a; }));
        REQUIRE(by_rate.size() == 1);
        CHECK(by_rate[0].channel == "v");
        REQUIRE(by_rate[0].grows);
        CHECK(by_rate[0].grows->what == noise_growth::with::rate);
        CHECK(by_rate[0].grows->coefficient.lower() > 0);
        CHECK(by_rate[0].grows->coefficient.lower() <= 1.05 * size); // rates are differences
        CHECK(by_rate[0].grows->coefficient.upper() >= 0.5 * size);

        auto const as_ever = confined(noisy_speed(d, 3, [&](double, double) { return size / 3; }));
        REQUIRE(as_ever.size() == 1);
        CHECK_FALSE(as_ever[0].grows);
        for (auto const& c : {by_value[0], by_rate[0], as_ever[0]}) CHECK_FALSE(c.correlated);
    }
}

TEST_CASE("errors that go together are told from noise") {
    draws d(78);
    for (double const lasts : {0.2, 0.5}) { // of 4 s; fits take up what is slower
        double slow = 0;
        auto const kept = std::exp(-0.1 / lasts); // of the one before, 0.1 s ago
        auto const found = confined(noisy_speed(
            d, 3, [&](double, double) { return 0.0; },
            [&] {
                slow = kept * slow + (1 - kept) * d.uniform(-1, 1);
                return 0.3 * slow / std::sqrt((1 - kept) / (1 + kept));
            }));
        REQUIRE(!found.empty());
        CHECK(found[0].channel == "v");
        REQUIRE(found[0].correlated);
        CAPTURE(lasts, found[0].correlated->seconds);
        CHECK(found[0].correlated->seconds > 0.3 * lasts);
        CHECK(found[0].correlated->seconds < 1.6 * lasts);
    }
}

TEST_CASE("what is claimed of noise that grows with a value, against a fine grid") {
    draws d(78);
    std::size_t told = 0;
    for (std::size_t n = 0; n < support::swept(std::size_t{4}, std::size_t{100}); ++n) {
        double const size = d.uniform(0.05, 0.4);
        auto const p = noisy_speed(d, 2, [&](double v, double) { return size * v; });
        for (auto const& c : confined(p)) {
            if (!c.grows || c.grows->what != noise_growth::with::value) continue;
            ++told;
            std::vector<std::vector<double>> starts;
            for (auto const& e : p.experiments) starts.push_back(mid(e.initial));
            auto const shown =
                approximate_fitter(p).at({c.grows->shown.parameters[0].value}, starts);
            auto const needed_at = [&](double k) {
                auto const at = approximate_fitter(p).at({k}, starts);
                double most = 0;
                for (std::size_t e = 0; e < p.experiments.size(); ++e) {
                    auto const data = sorted(p.experiments[e].measurements);
                    for (std::size_t i = 0; i < data.size(); ++i) {
                        double const off = std::abs(at.residuals[e][i]), half = rad(data[i].bound);
                        if (!(off > 1)) continue;
                        if (data[i].channel != 1) return detail::infinity;
                        double const y = mid(data[i].bound) + shown.residuals[e][i] * half;
                        most = std::max(most, (off - 1) * half / std::abs(y));
                    }
                }
                return most;
            };
            double least = detail::infinity;
            for (double k = 0.5; k <= 1.5; k += 1e-3) least = std::min(least, needed_at(k));
            double const there = needed_at(c.grows->witness.parameters[0].value);
            CAPTURE(n, size, c.grows->coefficient.lower(), c.grows->coefficient.upper(), least);
            CHECK(c.grows->coefficient.lower() <= least);
            CHECK(c.grows->coefficient.upper() >= there * (1 - 1e-6)); // it is simulated
        }
    }
    CHECK(told > 0);
}

TEST_CASE("experiments that differ are left out one after the other") {
    auto const p = campaign(5, {1, 3}, small_campaign::with_drag(0.3));
    auto const found = confined(p);
    REQUIRE(found.size() == 1);
    CHECK(found[0].scenarios == names{"E2", "E4"});
    attack(p, found[0]);
}

TEST_CASE("parts may be whole experiments only") {
    confinement_options options;
    options.channels = false;
    auto const p = campaign(4, {2}, small_campaign::with_scale(0.3));
    auto const parts = find_unexplained_parts(p, fit(p), options);
    REQUIRE(parts.size() == 1);
    CHECK_FALSE(parts[0].channel);
    CHECK(parts[0].experiments == std::vector<std::size_t>{2});
    auto const scaled = small_campaign::problem(small_campaign::with_scale(0.2));
    CHECK(find_unexplained_parts(scaled, fit(scaled), options).empty());
    CHECK(find_unexplained_parts(scaled, {}, {}).empty()); // no fit
}

TEST_CASE("what is wrong everywhere is confined to nothing") {
    CHECK(confined(small_campaign::problem(small_campaign::with_drag(0.3))).empty());
    CHECK(confined(campaign(3, {0, 1, 2}, small_campaign::with_drag(0.3))).empty());
}

TEST_CASE("outliers stay allowed where bounds grow") {
    auto p = small_campaign::problem(small_campaign::with_scale(0.2));
    auto const without = confined(p);
    for (auto& e : p.experiments) {
        e.outliers = 2;
        e.measurements[21].bound = e.measurements[21].bound + interval(1.0); // of the speed
    }
    auto const found = confined(p);
    REQUIRE(found.size() == 1);
    CHECK(found[0].channel == "p");
    REQUIRE(without.size() == 1);
    CHECK(found[0].factor.lower() <= without[0].factor.upper()); // more is allowed
}

TEST_CASE("what no search proves from below is what all bounds need") {
    auto const p = small_campaign::problem(small_campaign::with_scale(0.2));
    auto const at = fit(p);
    auto const whole = bound_inflation(p, &at).value;
    confinement_options options;
    options.lower.keep_going = [] { return false; };
    for (auto const& known : {whole, unknown_inflation(), interval(0.5, 20)}) {
        auto const found = find_confined_gaps(p, at, known, options);
        REQUIRE(found.size() == 1);
        double const proved = known.lower() > 1 ? known.lower() : 0;
        CHECK(found[0].factor.lower() <= proved);
        CHECK(found[0].factor.lower() >= proved * (1 - 1e-12));
    }
}

TEST_CASE("a search that is stopped claims nothing unproved") {
    auto const p = small_campaign::problem(small_campaign::with_scale(0.2));
    for (int most = 0; most < 60; most += 7) {
        int asked = 0;
        confinement_options options;
        options.go_on = [&] { return ++asked <= most; };
        options.lower.keep_going = options.go_on;
        for (auto const& c : confined(p, options)) {
            CHECK(c.channel == "p");
            CHECK(needed(p, c, c.witness.parameters[0].value) <= c.factor.upper());
            double least = detail::infinity;
            for (double k = 0.5; k <= 1.5; k += 1e-3) least = std::min(least, needed(p, c, k));
            CHECK(c.factor.lower() <= least);
        }
    }
}

TEST_CASE("bounds of a part grow about their middles") {
    auto const p = small_campaign::problem();
    auto const wider = loosened(p, {1, {0}}, 3);
    for (std::size_t e = 0; e < 2; ++e) {
        for (std::size_t n = 0; n < p.experiments[e].measurements.size(); ++n) {
            auto const &was = p.experiments[e].measurements[n],
                       &is = wider.experiments[e].measurements[n];
            bool const grows = e == 0 && was.channel == 1;
            double const size = grows ? 3 * rad(was.bound) : rad(was.bound);
            CHECK(std::abs(rad(is.bound) - size) <= 1e-12 * size);
            CHECK(std::abs(mid(is.bound) - mid(was.bound)) <= 1e-12);
            CHECK(subset(was.bound, is.bound));
        }
    }
}

TEST_CASE("how far bounds grew is rounded up, whatever their middles are") {
    auto p = small_campaign::problem();
    auto const wider = loosened(p, {}, 3);
    auto const growth = bound_growth::of(p, {});
    CHECK(growth.between(p, p) == 0);
    CHECK(growth.between(p, wider) >= 2);
    CHECK(growth.between(p, wider) <= 2 * (1 + 1e-9));
    CHECK(growth.greatest_share(p) >= 1);
    CHECK(growth.greatest_share(p) <= 1 + 1e-15);
    // Beside a large middle a double says little of a small bound.
    auto& m = p.experiments[0].measurements[0].bound;
    double const x = 1e9, step = std::ldexp(1.0, -23);
    m = interval(x, x + step);
    CHECK(bound_growth::of(p, {}).between(p, loosened(p, {0, {0}}, 3)) >= 2);
    m = interval(x);
    CHECK(bound_growth::of(p, {}).between(p, wider) == detail::infinity);
}
