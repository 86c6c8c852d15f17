// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_DETAIL_SPLIT_RULE_HPP
#define SIVID_PAVING_SEARCH_DETAIL_SPLIT_RULE_HPP

#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/search/frontier.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// Boxes in what is left, as small as some that a search ends with: one in the middle, others where
/// most is excluded first, in corners.
/// @param share  of the sides of `whole`
[[nodiscard]] inline std::vector<box> smallest_boxes(box const& left, box const& whole,
                                                     double share) {
    std::vector<box> result(8, left);
    for (std::size_t k = 0; k < result.size(); ++k) {
        for (std::size_t i = 0; i < left.size(); ++i) {
            double const least = std::min(share * width(whole[i]), width(left[i]));
            double const from = k == 0                ? mid(left[i]) - least / 2
                                : (k >> (i % 3)) & 1U ? left[i].upper() - least
                                                      : left[i].lower();
            result[k][i] = intersect(interval(from, from + least), left[i]);
        }
    }
    return result;
}

/// Which side of a box is split: none where all are as narrow as was asked for.
struct split_rule {
    box whole;                   ///< what the accuracy is a fraction of
    std::size_t measured_at = 0; ///< so many tests

    /// @param hull  of all that is left, `x` included; called where the old one is of no use
    template <class Hull>
    [[nodiscard]] std::optional<std::size_t>
    operator()(box const& x, std::vector<double> const& smear, inversion_options const& options,
               std::size_t tested, Hull const& hull) {
        auto const side = side_to_split(x, whole, smear, options.accuracy);
        // Where an old hull rules out the best side, those that say nothing would be halved.
        bool const best = side && side == side_to_split(x, whole, smear, 0);
        if (best || !options.accuracy_of_hull || 4 * tested < 5 * measured_at) return side;
        measure(hull(), tested);
        return side_to_split(x, whole, smear, options.accuracy);
    }
    void measure(box hull, std::size_t tested) {
        whole = std::move(hull);
        measured_at = tested;
    }
};

} // namespace sivid::paving_detail

#endif
