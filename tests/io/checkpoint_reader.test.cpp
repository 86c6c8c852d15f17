// SPDX-License-Identifier: MIT
// Checkpoints come back exactly, and what is not one is refused.
#include <sivid/io/checkpoint_reader.hpp>

#include <sivid/io/result/problem_digest.hpp>
#include <sivid/paving/identify.hpp>

#include "io/small_identification.hpp"
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/pendulum.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

using namespace sivid;
using io_support::temporary_folder;

namespace {

bool same(interval const& a, interval const& b) {
    return a.lower() == b.lower() && a.upper() == b.upper();
}
bool same(subpaving const& a, subpaving const& b) {
    bool equal = a.boxes().size() == b.boxes().size() && same(a.inner_volume(), b.inner_volume()) &&
                 same(a.outer_volume(), b.outer_volume());
    for (std::size_t k = 0; equal && k < a.boxes().size(); ++k) {
        equal = a.boxes()[k].verdict == b.boxes()[k].verdict;
        for (std::size_t i = 0; equal && i < a.prior().size(); ++i) {
            equal = same(a.boxes()[k].set[i], b.boxes()[k].set[i]);
        }
    }
    return equal;
}
void check_same(identification const& a, identification const& b) {
    CHECK(a.verdict == b.verdict);
    CHECK(a.reason == b.reason);
    CHECK(a.boxes == b.boxes);
    CHECK(a.integrations == b.integrations);
    CHECK(same(a.paving, b.paving));
    for (std::size_t j = 0; j < a.hull.size(); ++j) CHECK(same(a.hull[j], b.hull[j]));
    REQUIRE(a.witness.has_value() == b.witness.has_value());
    if (a.witness) {
        CHECK(a.witness->parameters == b.witness->parameters);
        CHECK(a.witness->starts == b.witness->starts);
    }
    REQUIRE(a.combinations.size() == b.combinations.size());
    for (std::size_t k = 0; k < a.combinations.size(); ++k) {
        CHECK(same(a.combinations[k].hull, b.combinations[k].hull));
    }
    CHECK(a.forced.size() == b.forced.size());
    REQUIRE(a.guess.has_value() == b.guess.has_value());
    if (a.guess) {
        CHECK(a.guess->residuals == b.guess->residuals);
        CHECK(a.guess->inflation == b.guess->inflation);
        CHECK(a.guess->squares == b.guess->squares);
    }
}

identify_options options_of(bool reduced) {
    identify_options o;
    o.search.accuracy = 1.0 / 256;
    o.search.sufficient_ratio = 0.97;
    o.search.boxes = 150;
    o.search.seconds = 1e9;
    o.drawn_boxes = 60;
    if (!reduced) o = by_bisection(o);
    return o;
}

/// A state with everything in it, as text.
std::string some_checkpoint(identification_problem const& problem, identify_options options) {
    auto const digest = problem_digest(problem, options);
    std::vector<std::string> saved;
    options.search.checkpoint_seconds = 0;
    options.search.boxes = 40;
    options.checkpoint = [&](identification_state const& s) {
        saved.push_back(checkpoint_text(s, digest));
    };
    (void)identify(problem, options);
    REQUIRE_FALSE(saved.empty());
    return saved.back();
}

} // namespace

TEST_CASE("an identification resumed from any checkpoint gives the result of the whole run") {
    temporary_folder const folder;
    auto const file = folder.path() / "checkpoint.txt";
    for (bool const spoilt : {false, true}) {
        for (bool const reduced : {true, false}) {
            auto const problem = io_support::two_rates_problem(spoilt);
            auto options = options_of(reduced);
            auto const digest = problem_digest(problem, options);
            auto const whole = identify(problem, options);
            std::vector<identification_state> states;
            auto saving = options;
            saving.search.checkpoint_seconds = 0;
            saving.checkpoint = [&](identification_state const& s) { states.push_back(s); };
            check_same(identify(problem, saving), whole);
            // How many that were depends on the clock; what a budget ends saves its state for
            // certain.
            for (std::size_t const boxes : {2U, 8U, 20U}) {
                saving.search.boxes = boxes;
                (void)identify(problem, saving);
            }
            REQUIRE(states.size() > 2);
            CAPTURE(spoilt, reduced, states.size());
            for (std::size_t k = 0; k < states.size(); k += 1 + states.size() / 9) {
                write_checkpoint(file, states[k], digest);
                auto const read = read_checkpoint(file, digest);
                CHECK(checkpoint_text(read, digest) == folder.read("checkpoint.txt"));
                auto resuming = options;
                resuming.resume = std::make_shared<identification_state const>(read);
                auto const found = identify(problem, resuming);
                check_same(found, whole);
                CHECK(found.seconds >= read.seconds + read.search.seconds);
            }
        }
    }
}

TEST_CASE("what windows left is resumed with the search") {
    auto const problem = support::swinging(4, 0.3, 21, 0.3);
    identify_options options;
    options.search.seconds = 1e9;
    options.search.boxes = 24;
    auto const digest = problem_digest(problem, options);
    auto const whole = identify(problem, options);
    REQUIRE_FALSE(whole.journal.empty());
    CHECK(std::ranges::any_of(whole.journal, [](auto const& r) { return r.left < 0.5; }));
    std::shared_ptr<identification_state const> state;
    auto saving = options;
    saving.search.boxes = 4;
    saving.checkpoint = [&](identification_state const& s) {
        auto const text = checkpoint_text(s, digest);
        state = std::make_shared<identification_state>(parse_checkpoint(text, "f", digest));
        CHECK(checkpoint_text(*state, digest) == text);
    };
    (void)identify(problem, saving);
    REQUIRE(state);
    REQUIRE(state->left);
    REQUIRE(state->journal.size() == whole.journal.size());
    auto going_on = options;
    going_on.resume = state;
    auto const resumed = identify(problem, going_on);
    check_same(resumed, whole);
    for (std::size_t k = 0; k < whole.journal.size(); ++k) {
        auto const &a = resumed.journal[k], &b = whole.journal[k];
        CHECK(std::tuple(a.by, a.why, a.how, a.left, a.figures) ==
              std::tuple(b.by, b.why, b.how, b.left, b.figures));
    }
    CHECK(contains(whole.hull, std::vector<double>{9, 0.3, 4}));
    auto other = std::make_shared<identification_state>(*state);
    other->journal[0] = {"my own", "why\nnot", contraction_record::outcome::cut_short, 0.5, 7};
    auto const again = parse_checkpoint(checkpoint_text(*other, digest), "f", digest).journal[0];
    CHECK(again.by == "my own");
    CHECK(again.why == "why not");
    CHECK(again.how == contraction_record::outcome::cut_short);
    CHECK(again.integrations == 7);
    // of another problem
    other->left->starts.emplace_back();
    going_on.resume = other;
    CHECK_THROWS_AS(identify(problem, going_on), std::invalid_argument);
}

TEST_CASE("a checkpoint that was cut or altered anywhere is refused") {
    auto const problem = io_support::two_rates_problem(true);
    auto const options = options_of(true);
    auto const digest = problem_digest(problem, options);
    auto const text = some_checkpoint(problem, options);
    CHECK_NOTHROW(parse_checkpoint(text, "f", digest));
    auto const refused = [&](std::string const& bad) {
        try {
            (void)parse_checkpoint(bad, "out/checkpoint.txt", digest);
        } catch (input_error const& e) {
            CHECK_THAT(e.what(),
                       StartsWith("out/checkpoint.txt") && ContainsSubstring("remove it"));
            return true;
        }
        return false;
    };
    std::size_t accepted = 0;
    for (std::size_t n = 0; n < text.size(); n += n < 400 ? 1 : 61) {
        accepted += !refused(text.substr(0, n));
    }
    for (std::size_t n = text.size() - 200; n < text.size(); ++n) {
        accepted += !refused(text.substr(0, n));
    }
    support::draws d(5201);
    for (int k = 0; k < 1500; ++k) {
        auto bad = text;
        auto const at = k < 300 ? static_cast<std::size_t>(k) : d.below(text.size());
        bad[at] = static_cast<char>(static_cast<unsigned char>(bad[at]) ^ (1u << d.below(8)));
        accepted += !refused(bad);
        bad = text;
        bad.erase(at, 1 + d.below(50));
        accepted += !refused(bad);
        bad = text;
        bad.insert(at, 1 + d.below(50), static_cast<char>(d.below(256)));
        accepted += !refused(bad);
    }
    accepted += !refused(text + "\n");
    accepted += !refused(text + text);
    accepted += !refused("");
    CHECK(accepted == 0);
}

TEST_CASE("a text with a right digest and wrong contents is refused, not believed") {
    auto const problem = io_support::two_rates_problem(true);
    auto options = options_of(true);
    options.search.proof_bytes = 0; // a proof may be altered: nobody trusts it
    auto const digest = problem_digest(problem, options);
    auto const text = some_checkpoint(problem, options);
    auto const body = text.substr(text.find('\n', text.find("sha256")) + 1);
    auto const sealed = [](std::string const& contents) {
        return "sivid-checkpoint-9\nsha256 " + sha256(contents) + "\n" + contents;
    };
    CHECK(sealed(body) == text);
    support::draws d(5202);
    // Words exchanged, lines lost and doubled, counts changed: never a crash, never an absurd
    // state.
    int refused = 0;
    for (int k = 0; k < 4000; ++k) {
        auto bad = body;
        auto const at = d.below(bad.size());
        switch (d.below(4)) {
        case 0:
            bad[at] = "0123456789abcdefx -p.\n"[d.below(22)];
            break;
        case 1:
            bad.erase(at, bad.find('\n', at) - at + 1);
            break;
        case 2:
            bad.insert(at, bad.substr(d.below(bad.size()), d.below(200)));
            break;
        default: {
            auto const digit = bad.find_first_of("123456789", at);
            if (digit != std::string::npos) bad.replace(digit, 1, "99999999999999999999");
        }
        }
        try {
            auto const state = parse_checkpoint(sealed(bad), "f", digest);
            CHECK_NOTHROW(state.search.require_valid());
        } catch (input_error const&) {
            ++refused;
        }
    }
    CHECK(refused > 3000);
}

TEST_CASE("checkpoints of other problems, options and versions are refused, with the remedy") {
    temporary_folder const folder;
    auto const problem = io_support::two_rates_problem(true);
    auto const options = options_of(true);
    auto const digest = problem_digest(problem, options);
    auto const text = some_checkpoint(problem, options);
    auto other = options;
    other.search.accuracy = 1.0 / 128;
    CHECK_THROWS_WITH(parse_checkpoint(text, "f", problem_digest(problem, other)),
                      ContainsSubstring("another problem") && ContainsSubstring("other options"));
    CHECK_THROWS_WITH(
        parse_checkpoint(text, "f", problem_digest(io_support::two_rates_problem(false), options)),
        ContainsSubstring("another problem"));
    auto body = text.substr(text.find('\n', text.find("sha256")) + 1);
    body.replace(0, body.find('\n'), "version 0.0.9");
    CHECK_THROWS_WITH(
        parse_checkpoint("sivid-checkpoint-9\nsha256 " + sha256(body) + "\n" + body, "f", digest),
        ContainsSubstring("'0.0.9'") && ContainsSubstring("begin anew"));
    for (auto const* former : {"sivid-checkpoint-3\n", "sivid-checkpoint-7\n"}) {
        CHECK_THROWS_WITH(parse_checkpoint(former, "f", digest),
                          ContainsSubstring("no checkpoint") &&
                              ContainsSubstring("another version") &&
                              ContainsSubstring("begin anew"));
    }
    CHECK_THROWS_WITH(read_checkpoint(folder.path() / "none.txt", digest),
                      ContainsSubstring("none.txt") && ContainsSubstring("no such file"));
}
