// SPDX-License-Identifier: MIT
// A contractor and an inclusion test of one's own in the search: the ring  1 <= x^2 + y^2 <= 2.
#include <sivid/number/decimal_output.hpp>
#include <sivid/paving/invert.hpp>

#include <iostream>

using namespace sivid;

struct ring {
    interval const bounds{1, 2};

    assessment<> operator()(box const& b) const {
        assessment<> says{.rest = b};
        interval const square = sqr(b[0]) + sqr(b[1]);
        if (subset(square, bounds)) says.verdict = box_verdict::inside;
        if (disjoint(square, bounds)) says.verdict = box_verdict::outside;
        for (std::size_t i : {0u, 1u}) { // |x| <= sqrt(2 - min y^2): no point beyond is in the set
            double const most = sqrt(bounds - sqr(b[1 - i])).upper();
            says.rest[i] = intersect(b[i], hull(interval(-most), interval(most)));
        }
        return says;
    }
};

int main() {
    ring test;
    auto const found = invert(test, {interval(-5, 5), interval(-5, 5)},
                              {.accuracy = 2e-4,        // of the prior's sides
                               .sufficient_ratio = 1}); // do not stop before that
    auto const share = hull(found.paving.inner_volume(), found.paving.outer_volume());
    std::cout << "area in " << to_string(100 * share, 4) << " (pi by hand) after " << found.tested
              << " boxes\n";
}
