// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SET_DETAIL_FRAMED_BOX_HPP
#define SIVID_ENCLOSURE_SET_DETAIL_FRAMED_BOX_HPP

#include <sivid/space/frame/detail/common_frame.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid::enclosure_detail {

/// A box in an almost orthogonal frame \f$ Q \f$ that contains \f$ \sum_j g_j(q) \xi_j \f$ for all
/// q and \f$ \xi \in [-1,1]^m \f$ (`docs/taylor_models.md`, section 2, "Reduction").
/// @tparam Model  of the entries of g_j, with radius 0
template <class Model>
class framed_box {
    using C = typename Model::scalar;
    using side_by_side = lane_traits<C>;
    using column = std::vector<Model>;

public:
    /// @param first, last  of the columns g_j, with an entry for each state
    /// @param units  one for each state: the frame is orthogonal in these. Where one is beyond
    ///               1e100, below 1e-100 or no number, 1 takes its place.
    /// @param score  sizes of directions in common, see `common_frame`
    template <class Iterator, class Score>
    framed_box(Iterator first, Iterator last, std::vector<C> const& units, Score const& score)
        : sides_(units.size()) {
        auto const n = units.size();
        for (auto const& u : units) {
            auto const fair = (u > C(1e-100)) & (u < C(1e100));
            unit_.push_back(side_by_side::select(fair, u, C(1.0)));
        }
        std::vector<std::vector<C>> directions;
        double up = 1; // enough for the sums over the terms of an entry
        std::size_t count = 0;
        for (auto g = first; g != last; ++g, ++count) {
            auto& d = directions.emplace_back(n);
            for (std::size_t i = 0; i < n; ++i) {
                d[i] = (*g)[i].c()[0] / unit_[i];
                up = std::max(up, (*g)[i].shape().up);
            }
        }
        frame_ = common_frame(std::move(directions), score);
        for (auto g = first; g != last; ++g) add(*g, up);
        for (auto& s : sides_) s = s * (1 + 8 * static_cast<double>(count + 4) * Model::unit);
    }

    /// Half the length of the side along axis k, in units.
    [[nodiscard]] C const& side(std::size_t k) const { return sides_[k]; }
    /// The vector from the middle to the side, as doubles.
    /// @param lost  for each state: what their roundings are at most is added
    [[nodiscard]] std::vector<C> edge(std::size_t k, std::vector<C>& lost) const {
        std::vector<C> e(unit_.size());
        for (std::size_t i = 0; i < e.size(); ++i) {
            e[i] = frame_.axis[k][i] * sides_[k] * unit_[i];
            lost[i] += (side_by_side::abs(e[i]) * (2 * Model::unit) + Model::tiny) *
                       (1 + 64 * Model::unit);
        }
        return e;
    }

private:
    /// The coordinates of a column in the frame are \f$ (1 + R)^{-1} Q^T g \f$ with |R| <= defect.
    /// Quotient, product and n - 1 sums of a term are rounded: by less than (n + 4) units together.
    void add(column const& g, double up) {
        auto const n = unit_.size();
        std::vector<C> along(n);
        C most_along{};
        std::size_t terms = 1;
        for (auto const& entry : g) terms = std::max(terms, entry.terms());
        for (std::size_t k = 0; k < n; ++k) {
            C sum{}, mass{};
            for (std::size_t m = 0; m < terms; ++m) {
                C c{};
                for (std::size_t i = 0; i < n; ++i) {
                    if (m < g[i].terms()) c += frame_.axis[k][i] * (g[i].c(m) / unit_[i]);
                }
                sum += side_by_side::abs(c);
            }
            for (std::size_t i = 0; i < n; ++i) {
                mass += side_by_side::abs(frame_.axis[k][i]) * (g[i].norm() / unit_[i]);
            }
            along[k] = sum * up + mass * (static_cast<double>(n + 4) * Model::unit) + Model::tiny;
            most_along = side_by_side::max(along[k], most_along);
        }
        for (std::size_t k = 0; k < n; ++k) sides_[k] += along[k] + frame_.defect * most_along;
    }

    std::vector<C> unit_;
    lane_frame<C> frame_;
    std::vector<C> sides_;
};

} // namespace sivid::enclosure_detail

#endif
