// SPDX-License-Identifier: MIT
#include <sivid/paving/response/detail/growing_response.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

/// Random quadratic outputs over a box, with measurements about a planted point.
struct scene {
    box whole{between(-1, 1), between(0, 2)};
    normalised_unknowns unknowns{box{interval(0.0)}, whole};
    std::shared_ptr<monomial_table const> table;
    std::vector<growing_response::arrival> all;

    scene(draws& d, std::size_t samples, std::size_t wild) {
        table = std::make_shared<monomial_table const>(
            monomial_table::of(sivid::monomial_space::of(2, 2), 2));
        std::vector<double> const truth{d.uniform(-1, 1), d.uniform(-1, 1)};
        for (std::size_t n = 0; n < samples; ++n) {
            output_polynomial y{{}, 0.001};
            double value = 0;
            for (std::size_t m = 0; m < table->size(); ++m) {
                y.coefficients.push_back(d.uniform(-1, 1));
                double term = y.coefficients.back();
                for (std::size_t v = 0; v < 2; ++v) {
                    for (int k = 0; k < table->exponents[m][v]; ++k) term *= truth[v];
                }
                value += term;
            }
            double const e = d.uniform(0.05, 3);
            double const off = n < wild ? 5 * e : d.uniform(-0.8, 0.8) * e;
            all.push_back({n, between(value + off - e, value + off + e), y});
        }
        for (std::size_t n = all.size(); n > 1; --n) std::swap(all[n - 1], all[d.below(n)]);
    }
    /// The response of the first measurements that arrived, all at once.
    [[nodiscard]] response plain(std::size_t count, std::size_t q) const {
        response r{unknowns, table, {}, {}, {}, {}, count, q};
        response_builder rows(table->size());
        for (std::size_t k = 0; k < count; ++k) {
            auto const& y = all[k].output;
            rows.add([&](std::size_t m) { return y.coefficients[m]; }, y.radius, all[k].bound);
        }
        std::move(rows).finish(r);
        return r;
    }
};

box part_of(draws& d, box const& x) {
    auto result = x;
    for (std::size_t j = 0; j < x.size(); ++j) {
        auto const a = d.uniform(x[j].lower(), x[j].upper());
        auto const b = d.uniform(x[j].lower(), x[j].upper());
        result[j] = between(std::min(a, b), std::max(a, b));
    }
    return result;
}

} // namespace

TEST_CASE("a growing response decides parts as all measurements at once do") {
    draws d(751);
    int decided = 0, pruned = 0, unconcerned = 0;
    for (int round = 0; round < 60; ++round) {
        std::size_t const q = d.below(3);
        scene const s(d, 12, q);
        growing_response growing(s.unknowns, s.table, q);
        auto live = s.whole;
        std::size_t count = 0;
        auto const check_refuted = [&] {
            auto mine = live, theirs = live;
            CHECK(assess(s.plain(count, q), theirs).refuted);
            CHECK_FALSE(assess(*growing.known(), mine).explained);
        };
        while (count < s.all.size()) {
            std::vector<growing_response::arrival> group;
            auto const size = 1 + d.below(3);
            while (group.size() < size && count < s.all.size()) group.push_back(s.all[count++]);
            auto const before = *growing.known();
            growing.take(group, live);
            if (growing.refuted()) {
                check_refuted();
                break;
            }
            for (int k = 0; k < 6; ++k) {
                auto const part = part_of(d, live);
                auto mine = part, theirs = part, old = part;
                auto const says = assess(*growing.known(), mine);
                auto const truth = assess(s.plain(count, q), theirs);
                CHECK(says.refuted == truth.refuted);
                CHECK(says.explained == truth.explained);
                if (!says.refuted) {
                    for (std::size_t j = 0; j < 2; ++j) {
                        CHECK(std::abs(width(mine[j]) - width(theirs[j])) < 1e-9);
                    }
                }
                decided += says.refuted || says.explained ? 1 : 0;
                if (growing.concerned(part)) continue;
                ++unconcerned;
                CHECK(assess(before, old).explained == truth.explained);
            }
            if (d.below(3) == 0) {
                live = part_of(d, live);
                growing.settle(live);
                if (growing.refuted()) {
                    check_refuted();
                    break;
                }
            }
            pruned += growing.known()->measurements < count ? 1 : 0;
        }
        if (growing.refuted()) continue;
        auto const full = s.plain(s.all.size(), q);
        auto const values = output_ranges(full, live);
        for (std::size_t k = 0; k < s.all.size(); ++k) {
            auto const expected = disjoint(values[k], s.all[k].bound) ? sample_status::fails
                                  : subset(values[k], s.all[k].bound) ? sample_status::holds
                                                                      : sample_status::open;
            auto const says = growing.status(s.all[k].sample, live);
            CHECK((says == expected ||
                   (expected == sample_status::open && says != sample_status::unreached)));
        }
    }
    CHECK(decided > 100);
    CHECK(pruned > 50);
    CHECK(unconcerned > 100);
}

TEST_CASE("measurements that were not reached keep a part from being explained") {
    draws d(752);
    scene const s(d, 3, 0);
    growing_response growing(s.unknowns, s.table, 1);
    auto wide = s.all;
    for (auto& a : wide) a.bound = between(-100, 100);
    growing.take(wide, s.whole);
    auto part = s.whole;
    CHECK(assess(*growing.known(), part).explained);
    CHECK_FALSE(growing.concerned(part));
    growing.miss(7);
    CHECK(growing.concerned(part));
    CHECK(assess(*growing.known(), part).explained); // one may fail
    growing.miss(8);
    CHECK_FALSE(assess(*growing.known(), part).explained);
    CHECK(growing.status(8, part) == sample_status::unreached);
    CHECK_FALSE(growing.refuted());
}
