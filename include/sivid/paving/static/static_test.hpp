// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_STATIC_TEST_HPP
#define SIVID_PAVING_STATIC_STATIC_TEST_HPP

#include <sivid/paving/set_test.hpp>
#include <sivid/paving/static/static_survey.hpp>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// A static problem as a set test for `invert`: one box at a time, largest first, progress and
/// outside boxes as for identification. `invert_static` is far faster: eight boxes at once, no
/// allocation for each, nothing tested anew that a parent decided.
class static_test {
public:
    explicit static_test(static_problem const& problem, first_order use = first_order::always)
        : program_(problem),
          samples_(problem),
          all_(std::make_shared<std::vector<static_samples::index> const>(samples_.all())),
          survey_(program_, samples_, problem.outliers, use) {}
    static_test(static_test const&) = delete;
    static_test& operator=(static_test const&) = delete;

    [[nodiscard]] assessment<> operator()(box const& x) {
        static_box b{x, all_, 0};
        assessment<> result{.verdict = survey_(b), .rest = x};
        if (result.verdict == box_verdict::outside) return result;
        result.rest = std::move(b.set);
        for (std::size_t j = 0; j < x.size(); ++j) {
            result.smear.push_back(survey_.slope(j) * width(result.rest[j]));
        }
        return result;
    }

private:
    static_program program_;
    static_samples samples_;
    static_list all_;
    static_survey<> survey_;
};

static_assert(plain_set_test<static_test>);

} // namespace sivid

#endif
