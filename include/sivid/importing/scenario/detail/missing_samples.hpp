// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_MISSING_SAMPLES_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_MISSING_SAMPLES_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace sivid {

/// How many samples a series lacks before each of its own: where more than half of its steps are
/// nearly alike, a step that is nearer to two of them or more has so many less one missing.
/// Elsewhere nobody can tell: 0.
/// @param steps  from each sample to the next one, 0 or more
/// @param alike  within this share of the usual step
/// @param regular  whether the steps are alike
[[nodiscard]] inline std::vector<std::size_t> missing_by_steps(std::vector<double> const& steps,
                                                               double alike, bool& regular) {
    constexpr double most = 1e9; // samples of one gap, so that counts stay counts
    std::vector<std::size_t> result(steps.size(), 0);
    std::vector<double> sorted;
    std::copy_if(steps.begin(), steps.end(), std::back_inserter(sorted),
                 [](double s) { return s > 0; });
    regular = false;
    if (sorted.empty()) return result;
    auto const middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    double const usual = *middle;
    auto const same = std::count_if(sorted.begin(), sorted.end(),
                                    [&](double s) { return std::abs(s - usual) <= alike * usual; });
    regular = 2 * static_cast<std::size_t>(same) > sorted.size();
    if (!regular) return result;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        double const n = std::round(std::min(steps[i] / usual, most));
        if (n >= 2) result[i] = static_cast<std::size_t>(n) - 1;
    }
    return result;
}

/// Counts the rows between the samples of one column, in the order of the record: an input that has
/// a reading in every tenth row lacks none, where every tenth has one.
class sample_rows {
public:
    /// The next row.
    /// @param lost  lines above it that may have been rows
    /// @param read  it has a reading
    /// @param kept  which is a sample; otherwise it was dropped as wrong
    void add(std::size_t lost, bool read, bool kept) {
        lost_ += lost;
        ++rows_;
        if (read && !kept) ++wrong_;
        if (!kept) return;
        steps_.push_back(static_cast<double>(rows_));
        wrongs_.push_back(wrong_);
        losts_.push_back(lost_);
        rows_ = wrong_ = lost_ = 0;
        counted_ = false;
    }

    /// Samples that rows without them, or with wrong ones, tell to be missing before sample i.
    [[nodiscard]] std::size_t missing_before(std::size_t i) {
        if (i == 0) return 0;
        if (!counted_) {
            bool regular = false;
            missing_ = missing_by_steps({steps_.begin() + 1, steps_.end()}, 0.25, regular);
            if (!regular) std::copy(wrongs_.begin() + 1, wrongs_.end(), missing_.begin());
            counted_ = true;
        }
        return missing_[i - 1];
    }
    /// Lines that were lost before sample i: each may have held one.
    [[nodiscard]] std::size_t lost_before(std::size_t i) const { return i == 0 ? 0 : losts_[i]; }

private:
    std::size_t rows_ = 0, wrong_ = 0, lost_ = 0;
    std::vector<double> steps_;
    std::vector<std::size_t> wrongs_, losts_, missing_;
    bool counted_ = false;
};

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_MISSING_SAMPLES_HPP
