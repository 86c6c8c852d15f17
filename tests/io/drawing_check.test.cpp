// SPDX-License-Identifier: MIT
#include <sivid/io/drawing_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

struct drawn {
    identification_problem problem = io_support::two_rates_problem();
    stored_identification stored = io_support::stored_result(problem).read();

    [[nodiscard]] std::vector<box> gaps() const {
        std::vector<box> sets;
        for (auto const& row : stored.rows) sets.push_back(row.set);
        return cover(problem.prior, sets).gaps;
    }
    [[nodiscard]] outcome excluded() const {
        auto const rebuilt = rebuild_products<interval>(problem, stored.products->sides);
        return drawing_check<interval>(problem, stored, rebuilt).excluded("", gaps()).found;
    }
    [[nodiscard]] outcome inside() const {
        auto const rebuilt = rebuild_products<interval>(problem, stored.products->sides);
        return drawing_check<interval>(problem, stored, rebuilt).inside("").found;
    }
};

} // namespace

TEST_CASE("boxes that were drawn from products follow from them") {
    drawn const d;
    REQUIRE(d.stored.products);
    CHECK(d.excluded() == outcome::verified);
    CHECK(d.inside() == outcome::verified);
}

TEST_CASE("boxes that do not follow from the products are seen") {
    drawn d;
    auto const good = d.stored;
    SECTION("any row that was dropped") {
        std::size_t seen = 0;
        for (std::size_t k = 0; k < good.rows.size(); k += 7) {
            d.stored = good;
            d.stored.rows.erase(d.stored.rows.begin() + static_cast<std::ptrdiff_t>(k));
            seen += d.excluded() != outcome::verified ? 1 : 0;
        }
        CHECK(seen >= (good.rows.size() + 6) / 7 - 1);
    }
    SECTION("a row that was made thinner") {
        auto& side = d.stored.rows[good.rows.size() / 2].set[0];
        side = interval(side.lower(), side.lower() + 0.9 * (side.upper() - side.lower()));
        CHECK(d.excluded() != outcome::verified);
    }
    SECTION("an open row called inside") {
        for (auto& row : d.stored.rows) row.verdict = box_verdict::inside;
        CHECK(d.inside() != outcome::verified);
    }
    SECTION("a product that is more than the rows hold") {
        auto& row = d.stored.products->rows[0].set[0];
        row = interval(row.lower() - 0.05, row.upper() + 0.05);
        CHECK(d.excluded() != outcome::verified);
    }
}
