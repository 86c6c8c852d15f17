// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_TEST_HPP
#define SIVID_PAVING_STATIC_TEST_HPP

#include <sivid/paving/set_test.hpp>
#include <sivid/paving/static_judge.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// A static problem as a set test for `invert`: one box at a time, largest first, progress and
/// outside boxes as for identification. `invert_static` is far faster: eight boxes at once, no
/// allocation for each, nothing tested anew that a parent decided.
class static_test {
public:
    explicit static_test(static_problem const& problem, first_order use = first_order::always)
        : judge_(problem, use), block_(problem.prior.size(), judge_.words()) {
        block_.count = 1;
    }

    [[nodiscard]] assessment<> operator()(box const& x) {
        for (std::size_t j = 0; j < x.size(); ++j) {
            block_.boxes.lower(j)[0] = x[j].lower();
            block_.boxes.upper(j)[0] = x[j].upper();
        }
        judge_.open_all(block_, 0);
        auto const found = judge_(block_, 0);
        assessment<> result{.rest = x};
        if ((found.outside & 1U) != 0) {
            result.verdict = box_verdict::outside;
            return result;
        }
        for (std::size_t j = 0; j < x.size(); ++j) {
            result.rest[j] = interval(block_.boxes.lower(j)[0], block_.boxes.upper(j)[0]);
            result.smear.push_back(judge_.slope(j, 0) * width(result.rest[j]));
        }
        if ((found.inside & 1U) != 0) result.verdict = box_verdict::inside;
        return result;
    }

private:
    static_judge<1> judge_;
    static_block block_;
};

static_assert(plain_set_test<static_test>);

} // namespace sivid

#endif
