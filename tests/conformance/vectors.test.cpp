// SPDX-License-Identifier: MIT
#include "conformance/vectors.hpp"
#include "conformance/types.hpp"
#include "support/catch.hpp"

#include <concepts>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace {

using conformance::vector_line;
using sivid::interval;

/// Both files together.
std::vector<vector_line> all_vectors() {
    std::vector<vector_line> lines;
    for (char const* name : {"itf1788.txt", "mpfi_elem.txt"}) {
        auto const more =
            conformance::read_vectors(std::string{SIVID_SOURCE_DIR "/tests/data/vectors/"} + name);
        lines.insert(lines.end(), more.begin(), more.end());
    }
    return lines;
}

void require_clean(conformance::report const& r) {
    for (auto const& line : r.unsound) UNSCOPED_INFO("unsound: " << line);
    for (auto const& line : r.loose) UNSCOPED_INFO("not tight: " << line);
    CHECK(r.unsound.empty());
    CHECK(r.loose.empty());
}

bool same(double a, double b) { return a == b || (a != a && b != b); }

} // namespace

TEMPLATE_TEST_CASE("vectors: every interval function contains, arithmetic is tight", "",
                   SIVID_TESTED_TYPES SIVID_PROVEN_TYPES) {
    auto const lines = all_vectors();
    conformance::report r;
    conformance::run_vectors<TestType>(lines, r);
    require_clean(r);
    CHECK(r.run > 5900);
}

TEMPLATE_TEST_CASE("vectors: numbers and relations by the traits", "",
                   SIVID_TESTED_TYPES SIVID_PROVEN_TYPES) {
    auto const lines = all_vectors();
    using tr = sivid::interval_traits<TestType>;
    using I = TestType;
    constexpr std::size_t last = tr::lanes - 1;
    std::map<std::string, double (*)(I const&)> const numbers{
        {"width", [](I const& x) { return tr::width(x, last); }},
        {"mid", [](I const& x) { return tr::mid(x, last); }},
        {"rad", [](I const& x) { return tr::rad(x, last); }},
        {"mag", [](I const& x) { return tr::mag(x, last); }},
        {"mig", [](I const& x) { return tr::mig(x, last); }}};
    using mask = typename tr::mask;
    std::map<std::string, mask (*)(I const&, I const&)> const relations{
        {"subset", [](I const& a, I const& b) { return tr::subset(a, b); }},
        {"interior", [](I const& a, I const& b) { return tr::interior(a, b); }},
        {"disjoint", [](I const& a, I const& b) { return tr::disjoint(a, b); }}};
    std::map<std::string, mask (*)(I const&)> const predicates{
        {"isempty", [](I const& x) { return tr::is_empty(x); }},
        {"issingleton", [](I const& x) { return tr::is_point(x); }}};
    auto const all_or_none = [](mask m, bool expected) {
        if constexpr (tr::lanes == 1 && std::same_as<mask, bool>)
            return m == expected;
        else
            return m == (expected ? tr::all_lanes : mask{});
    };
    std::size_t run = 0;
    for (auto const& line : lines) {
        auto const at = [&](std::size_t i) {
            return tr::bounds(line.argument(i), line.argument(i + 1));
        };
        bool const expected = line.results.at(0) == "true";
        INFO(line.text);
        if (auto const f = numbers.find(line.operation); f != numbers.end())
            CHECK(same(f->second(at(0)), line.result(0)));
        else if (auto const g = relations.find(line.operation); g != relations.end())
            CHECK(all_or_none(g->second(at(0), at(2)), expected));
        else if (auto const h = predicates.find(line.operation); h != predicates.end())
            CHECK(all_or_none(h->second(at(0)), expected));
        else if (line.operation == "ismember")
            CHECK(all_or_none(tr::contains(at(1), line.argument(0)), expected));
        else
            continue;
        ++run;
    }
    CHECK(run > 110);
}

TEST_CASE("vectors: numbers and relations of the vocabulary type") {
    auto const lines = all_vectors();
    using tr = sivid::interval_traits<interval>;
    std::map<std::string, std::function<double(interval)>> const numbers{
        {"inf", [](interval x) { return sivid::is_empty(x) ? conformance::inf : lower(x); }},
        {"sup", [](interval x) { return sivid::is_empty(x) ? -conformance::inf : upper(x); }},
        {"width", [](interval x) { return sivid::width(x); }},
        {"mid", [](interval x) { return sivid::mid(x); }},
        {"rad", [](interval x) { return sivid::rad(x); }},
        {"mag", [](interval x) { return sivid::mag(x); }},
        {"mig", [](interval x) { return sivid::mig(x); }}};
    std::map<std::string, std::function<bool(interval, interval)>> const relations{
        {"subset", [](interval a, interval b) { return sivid::subset(a, b); }},
        {"interior", [](interval a, interval b) { return sivid::interior(a, b); }},
        {"equal", [](interval a, interval b) { return sivid::equal(a, b); }},
        {"disjoint", [](interval a, interval b) { return sivid::disjoint(a, b); }}};
    std::map<std::string, std::function<bool(interval)>> const predicates{
        {"isempty", [](interval x) { return sivid::is_empty(x); }},
        {"isentire", [](interval x) { return sivid::is_entire(x); }},
        {"issingleton", [](interval x) { return sivid::is_point(x); }},
        {"iscommon", [](interval x) { return sivid::is_bounded(x); }}};
    std::size_t run = 0;
    for (auto const& line : lines) {
        INFO(line.text);
        if (auto const f = numbers.find(line.operation); f != numbers.end()) {
            CHECK(same(f->second(tr::bounds(line.argument(0), line.argument(1))), line.result(0)));
        } else if (auto const g = relations.find(line.operation); g != relations.end()) {
            bool const got = g->second(tr::bounds(line.argument(0), line.argument(1)),
                                       tr::bounds(line.argument(2), line.argument(3)));
            CHECK(got == (line.results.at(0) == "true"));
        } else if (auto const h = predicates.find(line.operation); h != predicates.end()) {
            CHECK(h->second(tr::bounds(line.argument(0), line.argument(1))) ==
                  (line.results.at(0) == "true"));
        } else if (line.operation == "ismember") {
            CHECK(sivid::contains(tr::bounds(line.argument(1), line.argument(2)),
                                  line.argument(0)) == (line.results.at(0) == "true"));
        } else {
            continue;
        }
        ++run;
    }
    CHECK(run > 150);
}

TEST_CASE("vectors: every operation of the files is known") {
    // A vector of an operation without a name here would be passed over in silence.
    auto const unary = conformance::unary_operations<interval>();
    auto const binary = conformance::binary_operations<interval>();
    // Cancellation and the order relations are not offered.
    std::set<std::string> const others{
        "cancelminus", "cancelplus", "fma",      "pown",        "inf",      "sup",
        "width",       "mid",        "rad",      "mag",         "mig",      "subset",
        "interior",    "equal",      "less",     "strictless",  "precedes", "strictprecedes",
        "disjoint",    "isempty",    "isentire", "issingleton", "iscommon", "ismember"};
    for (auto const& line : all_vectors()) {
        INFO(line.text);
        CHECK((unary.contains(line.operation) || binary.contains(line.operation) ||
               others.contains(line.operation)));
    }
}

TEST_CASE("vectors: the operators of the vocabulary type contain") {
    auto const lines = all_vectors();
    std::map<std::string, std::function<interval(interval, interval)>> const operators{
        {"add", [](interval a, interval b) { return a + b; }},
        {"sub", [](interval a, interval b) { return a - b; }},
        {"mul", [](interval a, interval b) { return a * b; }},
        {"div", [](interval a, interval b) { return a / b; }}};
    conformance::report r;
    for (auto const& line : lines) {
        auto const f = operators.find(line.operation);
        if (f == operators.end()) continue;
        using tr = sivid::interval_traits<interval>;
        r.result(line.text.c_str(),
                 f->second(tr::bounds(line.argument(0), line.argument(1)),
                           tr::bounds(line.argument(2), line.argument(3))),
                 line.result(0), line.result(1), line.operation != "div");
    }
    require_clean(r);
    CHECK(r.run > 900);
}
