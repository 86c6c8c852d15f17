// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_DETAIL_ERROR_SEQUENCE_HPP
#define SIVID_DIAGNOSIS_GAP_DETAIL_ERROR_SEQUENCE_HPP

#include <sivid/diagnosis/diagnosis.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// Errors of one channel in one record, in order of time.
struct error_sequence {
    std::vector<double> times, errors;
};

/// Whether errors follow their neighbours: the correlation of each error with the next one,
///     \f$ r = \sum e_k e_{k+1} / \sum e_k^2 \f$,
/// over all records, and the time -dt / ln r in which it falls to 1/e, dt between neighbours in the
/// median. Independent errors have |r| below 1/sqrt(n) mostly.
/// @returns  nothing where r is below 0.2, or less than `clearly` times 1/sqrt(n)
/// @guarantee  none: an estimate, too short where the fit takes up what is slow
[[nodiscard]] inline std::optional<error_correlation>
correlation_of(std::vector<error_sequence> const& records, double clearly = 5) {
    double together = 0, alone = 0;
    std::vector<double> gaps;
    for (auto const& r : records) {
        for (std::size_t k = 0; k < r.errors.size(); ++k) {
            alone += r.errors[k] * r.errors[k];
            if (k + 1 == r.errors.size()) continue;
            together += r.errors[k] * r.errors[k + 1];
            gaps.push_back(r.times[k + 1] - r.times[k]);
        }
    }
    if (gaps.empty() || !(alone > 0)) return std::nullopt;
    double const r = together / alone;
    if (!(r >= 0.2 && r < 1 && r * std::sqrt(static_cast<double>(gaps.size())) > clearly))
        return std::nullopt;
    auto const middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::nth_element(gaps.begin(), middle, gaps.end());
    return error_correlation{r, -*middle / std::log(r)};
}

} // namespace sivid

#endif
