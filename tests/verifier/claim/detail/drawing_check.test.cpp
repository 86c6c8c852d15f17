// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/paving_check.hpp>

#include <sivid/paving/products/dependence.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

struct drawn {
    identification_problem problem;
    stored_identification stored = io_support::stored_result(problem).read();

    /// @param thin  b is a decimal: its prior is one float wide
    explicit drawn(bool thin = false) : problem(posed(thin)) {}
    static identification_problem posed(bool thin) {
        auto result = io_support::two_rates_problem();
        if (thin) result.prior[1] = interval(0.5, std::nextafter(0.5, 1.0));
        return result;
    }

    [[nodiscard]] outcome excluded() const { return check(false); }
    [[nodiscard]] outcome inside() const { return check(true); }

private:
    [[nodiscard]] static std::vector<box> gaps(box const& prior,
                                               std::vector<paved_box> const& rows) {
        std::vector<box> sets;
        for (auto const& row : rows) sets.push_back(row.set);
        return cover(prior, sets).gaps;
    }
    [[nodiscard]] outcome check(bool inside_boxes) const {
        auto const map = coordinates_of(problem).value();
        subpaving products(map.problem().prior);
        for (auto const& row : stored.products->rows) products.add(row.set, row.verdict);
        for (auto& gap : gaps(products.prior(), stored.products->rows))
            products.add(gap, box_verdict::outside);
        drawing_check drawing(map, products, problem.prior, nullptr);
        return inside_boxes
                   ? drawing.inside("", stored.rows).found
                   : drawing.excluded("", stored.rows, gaps(problem.prior, stored.rows)).found;
    }
};

} // namespace

TEST_CASE("boxes that were drawn from products follow from them") {
    for (bool const thin : {false, true}) {
        drawn const d(thin);
        CAPTURE(thin);
        if (!d.stored.products) continue; // nothing to reduce
        CHECK(d.excluded() == outcome::verified);
        CHECK(d.inside() == outcome::verified);
    }
    REQUIRE(drawn().stored.products);
}

TEST_CASE("boxes that do not follow from the products are seen") {
    drawn d(GENERATE(false, true));
    if (!d.stored.products) return;
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
