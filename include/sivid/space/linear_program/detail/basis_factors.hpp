// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_LINEAR_PROGRAM_DETAIL_BASIS_FACTORS_HPP
#define SIVID_SPACE_LINEAR_PROGRAM_DETAIL_BASIS_FACTORS_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// A square matrix of doubles, factorised (P B = L U), whose columns are replaced one by one. No
/// proof.
/// @cost  O(n^3) once, O(n^2) for a replacement or a solution
class basis_factors {
public:
    /// @param matrix  by rows, n times n
    /// @returns false when it is singular, or holds numbers that are none
    [[nodiscard]] bool factorise(std::vector<double> const& matrix, std::size_t n) {
        n_ = n;
        lu_ = matrix;
        rows_.resize(n);
        for (std::size_t i = 0; i < n; ++i) rows_[i] = i;
        replaced_.clear();
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t at = k;
            for (std::size_t i = k + 1; i < n; ++i) {
                if (std::abs(lu_[i * n + k]) > std::abs(lu_[at * n + k])) at = i;
            }
            if (at != k) {
                std::swap_ranges(&lu_[k * n], &lu_[k * n] + n, &lu_[at * n]);
                std::swap(rows_[k], rows_[at]);
            }
            double const pivot = lu_[k * n + k];
            if (!(std::abs(pivot) > 0) || !std::isfinite(pivot)) return false;
            double const* const above = &lu_[k * n];
            for (std::size_t i = k + 1; i < n; ++i) {
                double* const row = &lu_[i * n];
                double const factor = row[k] / pivot;
                row[k] = factor;
                if (factor == 0) continue;
                for (std::size_t j = k + 1; j < n; ++j) row[j] -= factor * above[j];
            }
        }
        return true;
    }
    /// Puts another column in place of the one at k.
    /// @param solved  the new column after `solve`
    /// @returns false, and changes nothing, when that would lose digits: factorise anew
    [[nodiscard]] bool replace(std::size_t k, std::vector<double> const& solved) {
        double largest = 0;
        for (double const v : solved) largest = std::max(largest, std::abs(v));
        // Each replacement may lose as many digits; ends of programs are solved anew, and proved.
        if (!(std::abs(solved[k]) > 1e-5 * largest)) return false;
        replaced_.push_back({k, solved});
        return true;
    }
    /// b becomes \f$ B^{-1} b \f$.
    void solve(std::vector<double>& b) const {
        work_.resize(n_);
        for (std::size_t i = 0; i < n_; ++i) work_[i] = b[rows_[i]];
        for (std::size_t i = 0; i < n_; ++i) {
            work_[i] -= product(lu_.data() + i * n_, work_.data(), i);
        }
        for (std::size_t i = n_; i-- > 0;) {
            double const* const row = lu_.data() + i * n_;
            auto const next = i + 1;
            auto const sum = product(row + next, work_.data() + next, n_ - next);
            work_[i] = (work_[i] - sum) / row[i];
        }
        for (auto const& [k, column] : replaced_) {
            double const own = work_[k] / column[k];
            for (std::size_t i = 0; i < n_; ++i) work_[i] -= column[i] * own;
            work_[k] = own;
        }
        b.swap(work_);
    }
    /// b becomes \f$ B^{-T} b \f$.
    void solve_transposed(std::vector<double>& b) const {
        work_ = b;
        for (std::size_t r = replaced_.size(); r-- > 0;) {
            auto const& [k, column] = replaced_[r];
            double sum = work_[k];
            for (std::size_t i = 0; i < n_; ++i) {
                if (i != k) sum -= column[i] * work_[i];
            }
            work_[k] = sum / column[k];
        }
        for (std::size_t i = 0; i < n_; ++i) {
            double const v = work_[i] / lu_[i * n_ + i];
            work_[i] = v;
            if (v == 0) continue;
            double const* const row = lu_.data() + i * n_;
            for (std::size_t j = i + 1; j < n_; ++j) work_[j] -= row[j] * v;
        }
        for (std::size_t i = n_; i-- > 0;) {
            double const v = work_[i];
            if (v == 0) continue;
            double const* const row = lu_.data() + i * n_;
            for (std::size_t j = 0; j < i; ++j) work_[j] -= row[j] * v;
        }
        b.resize(n_);
        for (std::size_t i = 0; i < n_; ++i) b[rows_[i]] = work_[i];
    }

private:
    /// In eight sums, which vector instructions make at once.
    [[nodiscard]] static double product(double const* a, double const* b, std::size_t n) {
        constexpr std::size_t width = 8;
        double sums[width] = {};
        std::size_t i = 0;
        for (; i + width <= n; i += width) {
            for (std::size_t k = 0; k < width; ++k) sums[k] += a[i + k] * b[i + k];
        }
        double rest = 0;
        for (; i < n; ++i) rest += a[i] * b[i];
        for (double const s : sums) rest += s;
        return rest;
    }

    std::size_t n_ = 0;
    std::vector<double> lu_; ///< by rows; L below the diagonal, which is 1
    std::vector<std::size_t> rows_;
    std::vector<std::pair<std::size_t, std::vector<double>>> replaced_;
    mutable std::vector<double> work_;
};

} // namespace sivid

#endif
