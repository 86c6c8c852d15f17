// SPDX-License-Identifier: MIT
#include <sivid/verifier/identification_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"
#include "support/pendulum.hpp"
#include "verifier/forgery.hpp"

#ifdef SIVID_HAS_MPFI
#include <sivid/verifier/mp_identification_check.hpp>
#endif

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

std::vector<check_finding> findings_of(identification_problem const& problem,
                                       stored_identification const& stored,
                                       identification_check_options const& options) {
#ifdef SIVID_HAS_MPFI
    return check_by_proven_functions(problem, stored, options);
#else
    return check_identification(problem, stored, options);
#endif
}

std::map<std::string, outcome> check(identification_problem const& problem,
                                     stored_identification const& stored, bool all = false,
                                     double seconds = 60) {
    identification_check_options options;
    options.all = all;
    options.seconds = seconds;
    std::map<std::string, outcome> result;
    auto const findings = findings_of(problem, stored, options);
    for (auto const& f : findings) result[f.what] = f.found;
    result["overall"] = overall(findings);
    return result;
}

} // namespace

TEST_CASE("a result is verified by sample, a forced outlier included") {
    for (bool const spoilt : {false, true}) {
        auto const problem = io_support::one_rate_problem(spoilt);
        auto found = check(problem, io_support::stored_result(problem).read());
        CHECK(found["witness"] == outcome::verified);
        CHECK(found["inside boxes"] == outcome::sampled);
        CHECK(found["excluded boxes"] == outcome::sampled);
        CHECK(found["proved outliers"] == (spoilt ? outcome::verified : outcome::nothing));
        CHECK(found["overall"] == outcome::sampled);
    }
}

TEST_CASE("inside boxes from starts that follow the parameters are verified, false ones refuted") {
    auto problem = io_support::one_rate_problem();
    problem.experiments[0].initial[0] = interval(1.9, 2.1);
    auto const good = io_support::stored_result(problem).read();
    auto found = check(problem, good, true, 20);
    CHECK(found["inside boxes"] == outcome::verified);
    CHECK(found["excluded boxes"] == outcome::verified);
    CHECK(found["overall"] == outcome::verified);
    // Rates that 2 explains as a start no longer, but 2.03 does.
    double most = 9;
    for (auto const& m : problem.experiments[0].measurements) {
        most = std::min(most, -std::log(m.bound.lower() / 2) / m.time);
    }
    auto other = good;
    auto& row = other.rows[io_support::first_row(other.rows, box_verdict::inside)].set[0];
    row = interval(2 * most + 0.002, 2 * most + 0.012);
    CHECK(check(problem, other, true, 20)["inside boxes"] == outcome::verified);
    problem.experiments[0].initial[0] = interval(2.0);
    CHECK(check(problem, other, true, 20)["inside boxes"] == outcome::refuted);
    problem.experiments[0].initial[0] = interval(1.9, 2.1);
    row = hull(row, interval(1.5));
    CHECK(check(problem, other, true, 20)["inside boxes"] == outcome::refuted);
}

TEST_CASE("what windows excluded is proved anew or left open, never refuted") {
    auto const problem = support::swinging(1, 0.2, 22, 0.2);
    auto const stored = io_support::stored_result(problem).read();
    for (auto const& [what, says] : check(problem, stored, true, 2)) {
        CAPTURE(what);
        CHECK(says != outcome::refuted);
        if (what == "witness") CHECK(says == outcome::verified);
    }
}

TEST_CASE("the paving of products is verified anew, and what is false in it refuted") {
    auto const problem = io_support::two_rates_problem();
    auto const good = io_support::stored_result(problem).read();
    REQUIRE(good.products);
    auto found = check(problem, good);
    for (auto const* const what : {"products", "hull", "volumes", "combinations", "product cover",
                                   "inside boxes", "excluded boxes"}) {
        CAPTURE(what);
        CHECK(found[what] == outcome::verified); // of the boxes: given the products
    }
    for (auto const* const what : {"inside products", "excluded products", "overall"}) {
        CAPTURE(what);
        CHECK(found[what] == outcome::sampled);
    }
    auto bad = good;
    auto& rows = bad.products->rows;
    auto const k = io_support::first_row(rows, box_verdict::inside);
    SECTION("an inside product made larger") {
        rows[k].set[0] = interval(rows[k].set[0].lower(), 0.7);
        CHECK(check(problem, bad, true, 20)["inside products"] == outcome::refuted);
    }
    SECTION("an inside product left out") {
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(k));
        CHECK(check(problem, bad, true, 20)["excluded products"] == outcome::refuted);
    }
    SECTION("products that the equations do not obey") {
        bad.products->sides[0] = "a/b";
        CHECK(check(problem, bad)["products"] != outcome::verified);
    }
}

TEST_CASE("every figure of a claim that was altered is seen") {
    auto const problem = io_support::two_rates_problem(true);
    io_support::stored_result file(problem);
    auto const text = file.json();
    std::size_t altered = 0;
    auto const seen = [&](std::string const& json) {
        file.set_json(json);
        try {
            auto const stored = file.read();
            require_same_problem(problem, stored, "result.json");
            identification_check_options none;
            none.sample = 0;
            return overall(findings_of(problem, stored, none)) == outcome::refuted;
        } catch (input_error const&) {
            return true;
        }
    };
    CHECK_FALSE(seen(text));
    // How the search went and what was tried is no claim, nor is how its certificates are best
    // evaluated; the data set is known by its digest.
    std::string member;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text.compare(at, 4, "\n  \"") == 0) {
            auto const end = text.find('"', at + 4);
            member = text.substr(at + 4, end - at - 4);
            at = text.find(':', end);
        }
        bool const number = std::isdigit(static_cast<unsigned char>(text[at])) != 0 &&
                            (text[at - 1] == ' ' || text[at - 1] == '[' || text[at - 1] == '-');
        if (!number) continue;
        auto const end = text.find_first_not_of("0123456789.e+-", at);
        if (member != "source" && member != "boxes" && member != "search" &&
            member != "enclosures" && member != "integrations" && member != "journal" &&
            member != "seconds") {
            double const x = std::stod(text.substr(at, end - at));
            bool const whole = text.substr(at, end - at).find_first_of(".e") == std::string::npos;
            auto const other = whole                 ? std::to_string(static_cast<int>(x) + 1)
                               : member == "witness" ? std::to_string(1.5 * x + 0.5)
                                                     : text.substr(at, end - at) + "1";
            CAPTURE(member, text.substr(at, end - at), other);
            // The budget of outliers is given.
            bool const given =
                member == "outliers" && text.rfind('}', at) < text.rfind("budget", at);
            if (!given) CHECK(seen(text.substr(0, at) + other + text.substr(end)));
            ++altered;
        }
        at = end;
    }
    CHECK(altered > 20);
}

TEST_CASE("an empty paving is verified: nothing in the prior explains the data") {
    auto const problem = io_support::one_rate(io_support::impossible_problem());
    auto found = check(problem, io_support::stored_result(problem).read(), true);
    CHECK(found["excluded boxes"] == outcome::verified);
    CHECK(found["overall"] == outcome::verified);
}

TEST_CASE("what was tampered with is refuted") {
    auto const problem = io_support::one_rate_problem();
    auto bad = io_support::stored_result(problem).read();
    SECTION("a digit of the witness") {
        bad.witness->parameters["a"] += 0.3;
        CHECK(check(problem, bad)["witness"] == outcome::refuted);
    }
    SECTION("the witness's start") {
        bad.witness->initial["run"]["x"] = 2.5;
        CHECK(check(problem, bad)["witness"] == outcome::refuted);
        bad.witness->initial.clear();
        CHECK(check(problem, bad)["witness"] == outcome::refuted);
    }
    SECTION("a name too many in the witness") {
        auto const good = bad;
        bad.witness->parameters["b"] = 0.5;
        CHECK(check(problem, bad)["witness"] == outcome::refuted);
        bad = good;
        bad.witness->initial["run"]["y"] = 2;
        CHECK(check(problem, bad)["witness"] == outcome::refuted);
        bad = good;
        bad.witness->initial["walk"] = good.witness->initial.at("run");
        CHECK(check(problem, bad)["witness"] == outcome::refuted);
    }
    SECTION("an inside box made larger, the sums adapted") {
        auto& row = bad.rows[io_support::first_row(bad.rows, box_verdict::inside)].set;
        row[0] = interval(row[0].lower() - 0.05, row[0].upper() + 0.05);
        bad.rows = {{row, box_verdict::inside}};
        io_support::adapt(problem, bad);
        auto found = check(problem, bad);
        CHECK(found["volumes"] == outcome::verified);
        CHECK(found["inside boxes"] == outcome::refuted);
    }
    SECTION("an excluded box listed as inside") {
        bad.rows.push_back({box{interval(1.9, 2.0)}, box_verdict::inside});
        auto found = check(problem, bad, true, 5);
        CHECK(found["volumes"] == outcome::refuted);
        CHECK(found["inside boxes"] == outcome::refuted);
    }
    SECTION("an inside box removed, the sums adapted") {
        auto const k = io_support::first_row(bad.rows, box_verdict::inside);
        bad.rows.erase(bad.rows.begin() + static_cast<std::ptrdiff_t>(k));
        io_support::adapt(problem, bad);
        auto found = check(problem, bad, true, 20);
        CHECK(found["volumes"] == outcome::verified);
        CHECK(found["excluded boxes"] == outcome::refuted);
    }
    SECTION("an outlier that is none") {
        bad.forced.push_back({"run", 1.0, "x"});
        CHECK(check(problem, bad)["proved outliers"] == outcome::refuted);
        bad.forced[0].channel = "y";
        CHECK(check(problem, bad)["proved outliers"] == outcome::refuted);
    }
    CHECK(check(problem, bad)["overall"] != outcome::nothing);
}

TEST_CASE("another data set is seen where the digest does not tell") {
    auto const stored = io_support::stored_result(io_support::one_rate_problem()).read();
    auto other = io_support::one_rate_problem();
    for (auto& m : other.experiments[0].measurements) {
        m.bound = interval(m.bound.lower() + 0.2, m.bound.upper() + 0.2);
    }
    auto found = check(other, stored);
    CHECK(found["witness"] == outcome::refuted);
    CHECK(found["inside boxes"] == outcome::refuted);
}

TEST_CASE("without a budget nothing is claimed") {
    auto const problem = io_support::one_rate_problem();
    auto found = check(problem, io_support::stored_result(problem).read(), false, -1);
    CHECK(found["inside boxes"] == outcome::undecided);
    CHECK(found["overall"] == outcome::undecided);
}

namespace {

/// x' = u - a x, a = 1/2, u = 1 within 0.05: where the state goes depends on what u does.
struct driven {
    static constexpr auto name = "driven";
    static constexpr auto states = sivid::states({{"x", "m", 10}});
    static constexpr auto inputs = sivid::inputs({{"u", "m/s"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1/s", 1_dec}});
    }();
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 1> const& c, vec<T, 1> const& u) const {
        return {u[0] - c[0] * x[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 1> const&, vec<T, 1> const&) const {
        return x;
    }
};

identification_problem driven_problem(std::vector<double> errors) {
    experiment run;
    run.name = "run";
    run.inputs = {sampled_signal({0, 3}, {1, 1}, interpolation::linear, std::move(errors))};
    run.initial = {interval(1.0)};
    for (int k = 1; k <= 6; ++k) {
        double const t = 0.5 * k, x = 2 - std::exp(-0.5 * t);
        run.measurements.push_back({t, 0, interval(x - 0.05, x + 0.05)});
    }
    return {record_model<driven>(), {{"a"}, {}}, {interval(0.25, 1.0)}, {run}};
}

} // namespace

TEST_CASE("inputs with errors: confirmed by the recorded ones, excluded for all") {
    auto const problem = driven_problem({0.05, 0.05});
    auto const stored = io_support::stored_result(problem).read();
    auto found = check(problem, stored, true);
    CHECK(found["witness"] == outcome::verified);
    CHECK(found["inside boxes"] == outcome::verified);
    CHECK(found["excluded boxes"] == outcome::verified);
    CHECK(found["overall"] == outcome::verified);
    // What exact inputs exclude, inexact ones do not.
    auto const exact = io_support::stored_result(driven_problem({})).read();
    CHECK(check(driven_problem({}), exact, true)["overall"] == outcome::verified);
    CHECK(check(problem, exact, true, 3)["excluded boxes"] != outcome::verified);
}
