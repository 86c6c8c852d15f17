// SPDX-License-Identifier: MIT
#include <sivid/number/cancellation.hpp>

#include "number/support.hpp"

#include <cfenv>

using namespace sivid;

TEST_CASE("cancellation undoes addition") {
    CHECK(equal(cancel_minus(make(3, 7), make(1, 2)), make(2, 5)));
    CHECK(equal(cancel_plus(make(3, 7), make(-2, -1)), make(2, 5)));
    CHECK(equal(cancel_minus(make(1, 2), make(3, 7)), everything())); // y is wider
    CHECK(equal(cancel_minus(make(1, 2), make(1, 2)), make(0, 0)));
    CHECK(is_empty(cancel_minus(nothing(), make(1, 2))));
    CHECK(is_empty(cancel_minus(nothing(), nothing())));
    CHECK(equal(cancel_minus(make(1, 2), nothing()), everything()));
    CHECK(equal(cancel_minus(nothing(), everything()), everything()));
    CHECK(equal(cancel_minus(make(1, inf), make(1, 2)), everything()));
}

TEST_CASE("cancellation compares widths exactly") {
    // Widths 1 + 2^-60 and 1 + 2^-61: equal when rounded.
    interval const wide = make(-0x1p-60, 1), narrow = make(-0x1p-61, 1);
    CHECK(is_bounded(cancel_minus(wide, narrow)));
    CHECK(equal(cancel_minus(narrow, wide), everything()));
    // Widths that overflow.
    CHECK(is_bounded(cancel_minus(make(-greatest, greatest), make(-greatest, greatest))));
    CHECK(equal(cancel_minus(make(-greatest, 0x1p1023), make(-greatest, greatest)), everything()));
    CHECK(is_bounded(cancel_minus(make(-greatest, greatest), make(-tiny, 0))));
}

TEST_CASE("what is cancelled comes back, in every rounding mode") {
    oracle::inputs in{9};
    for (int i = 0; i < 20'000; ++i) {
        auto const draw = [&] {
            double const a = in.mixed(), b = in.mixed();
            return a < b ? make(a, b) : make(b, a);
        };
        interval const x = draw(), y = draw();
        int const mode = i % 3 == 0 ? FE_TONEAREST : i % 3 == 1 ? FE_UPWARD : FE_DOWNWARD;
        std::fesetround(mode);
        interval const z = cancel_minus(x, y);
        bool const kept = std::fegetround() == mode;
        std::fesetround(FE_TONEAREST);
        REQUIRE(kept);
        REQUIRE(subset(x, detail::add(y, z)));
        if (is_bounded(z)) {
            REQUIRE(lower(z) == oracle::at(mpfr_sub, lower(x), lower(y)).below);
            REQUIRE(upper(z) == oracle::at(mpfr_sub, upper(x), upper(y)).above);
        }
    }
}
