// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_DRAWING_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_DRAWING_CHECK_HPP

#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/claim/detail/identification_consistency.hpp>
#include <sivid/verifier/claim/detail/stored_products.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Checks that the boxes of a result follow from its paving of products: what they leave of the
/// prior has products in no row of products, and inside boxes have products in inside rows alone.
/// Nothing is integrated: what is proved of the products is proved of the boxes.
///   Up to the last digits, in which the tables are rounded: contacts thinner than that count as
///   none.
/// @tparam I  in which products are evaluated
template <class I>
class drawing_check {
    using outcome = check_finding::outcome;

public:
    /// @param pieces  of boxes that are looked at before a claim is left open
    /// @param keep_going  once false, claims are left open; may be empty
    drawing_check(identification_problem const& problem, stored_identification const& stored,
                  stored_products const& rebuilt, std::size_t pieces = 400'000,
                  std::function<bool()> keep_going = nullptr)
        : problem_(&problem),
          stored_(&stored),
          rebuilt_(&rebuilt),
          most_(pieces),
          keep_going_(std::move(keep_going)) {
        auto const n = problem.prior.size();
        faces_.resize(n);
        for (auto const& row : stored.rows) {
            for (std::size_t j = 0; j < n; ++j) {
                faces_[j].push_back(row.set[j].lower());
                faces_[j].push_back(row.set[j].upper());
            }
        }
        for (auto& list : faces_) {
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
        }
    }

    /// @param gaps  what the rows leave of the prior, without slivers
    [[nodiscard]] check_finding excluded(std::string what, std::vector<box> const& gaps) {
        if (gaps.empty()) return {std::move(what), outcome::nothing, ""};
        std::size_t open = 0;
        for (auto const& gap : gaps) open += is_excluded(gap) ? 0 : 1;
        return finding(std::move(what), gaps.size(), open);
    }
    [[nodiscard]] check_finding inside(std::string what) {
        std::vector<box> rows;
        for (auto const& row : stored_->products->rows) {
            if (row.verdict == box_verdict::inside) rows.push_back(row.set);
        }
        std::size_t count = 0, open = 0;
        for (auto const& row : stored_->rows) {
            if (row.verdict != box_verdict::inside) continue;
            ++count;
            auto const image = image_of(intersect(row.set, problem_->prior));
            bool proved = image.has_value();
            if (proved) {
                auto left = cover(*image, rows, 2e-15, keep_going_).gaps;
                io_detail::drop_slivers(left, *image);
                proved = left.empty();
            }
            open += proved ? 0 : 1;
        }
        if (count == 0) return {std::move(what), outcome::nothing, ""};
        return finding(std::move(what), count, open);
    }

private:
    [[nodiscard]] static check_finding finding(std::string what, std::size_t count,
                                               std::size_t open) {
        auto detail = std::to_string(count - open) + " of " + std::to_string(count) +
                      " follow from the products";
        return {std::move(what), open == 0 ? outcome::verified : outcome::undecided,
                std::move(detail)};
    }
    /// The products over a box, outward.
    [[nodiscard]] std::optional<box> image_of(box const& x) const {
        auto const p = io_detail::in<I>(x);
        box result(rebuilt_->sides.size());
        for (std::size_t k = 0; k < result.size(); ++k) {
            auto const value = rebuilt_->sides[k].over(p);
            if (!value) return std::nullopt;
            result[k] = io_detail::in_doubles(*value);
        }
        return result;
    }
    /// Whether a row has more than a rounding error in common with an image.
    [[nodiscard]] bool meets(box const& row, box const& image) const {
        for (std::size_t k = 0; k < row.size(); ++k) {
            double const common = std::min(row[k].upper(), image[k].upper()) -
                                  std::max(row[k].lower(), image[k].lower());
            auto const& whole = rebuilt_->problem.prior[k];
            if (io_detail::is_sliver(common, mag(row[k]), whole) && row[k].lower() < row[k].upper())
                return false;
            if (common < 0) return false;
        }
        return true;
    }

    [[nodiscard]] bool late() const { return keep_going_ && !keep_going_(); }

    [[nodiscard]] bool is_excluded(box const& gap) {
        if (late()) return false;
        struct piece {
            box set;
            std::vector<std::size_t> near;
        };
        std::vector<piece> waiting{{gap, {}}};
        for (std::size_t k = 0; k < stored_->products->rows.size(); ++k) {
            waiting[0].near.push_back(k);
        }
        while (!waiting.empty()) {
            auto const next = std::move(waiting.back());
            waiting.pop_back();
            auto const image = image_of(next.set);
            std::vector<std::size_t> near;
            for (auto const k : next.near) {
                if (!image || meets(stored_->products->rows[k].set, *image)) near.push_back(k);
            }
            if (near.empty()) continue;
            auto const cut = place_to_cut(next.set);
            if (!cut || spent_++ >= most_ || late()) return false;
            auto [low, high] = bisect(next.set, cut->first, cut->second);
            waiting.push_back({std::move(low), near});
            waiting.push_back({std::move(high), std::move(near)});
        }
        return true;
    }

    /// The face of a row next to the middle of a side, the middle where there is none; the side
    /// that is widest against the prior's, those with faces first.
    [[nodiscard]] std::optional<std::pair<std::size_t, double>> place_to_cut(box const& x) const {
        std::optional<std::pair<std::size_t, double>> best;
        double most = 0;
        for (std::size_t j = 0; j < x.size(); ++j) {
            double const whole = width(problem_->prior[j]);
            double const w = x[j].upper() - x[j].lower(), middle = mid(x[j]);
            if (!acts(j) || !(whole > 0) || !(w > 1e-13 * whole) || !(w > 0x1p-48 * mag(x[j]))) {
                continue;
            }
            auto const next = std::lower_bound(faces_[j].begin(), faces_[j].end(), middle);
            std::optional<double> face;
            auto const look = [&](double f) {
                double const room = 0x1p-50 * mag(x[j]);
                if (!(f > x[j].lower() + room) || !(f < x[j].upper() - room)) return;
                if (!face || std::abs(f - middle) < std::abs(*face - middle)) face = f;
            };
            if (next != faces_[j].end()) look(*next);
            if (next != faces_[j].begin()) look(*std::prev(next));
            double const rank = w / whole + (face ? 2 : 0);
            if (rank <= most) continue;
            most = rank;
            best = {j, face.value_or(middle)};
        }
        return best;
    }
    [[nodiscard]] bool acts(std::size_t j) const {
        return std::any_of(rebuilt_->sides.begin(), rebuilt_->sides.end(),
                           [j](auto const& side) { return side.exponents()[j] != 0; });
    }

    identification_problem const* problem_;
    stored_identification const* stored_;
    stored_products const* rebuilt_;
    std::vector<std::vector<double>> faces_; ///< of the rows, by side
    std::size_t most_, spent_ = 0;
    std::function<bool()> keep_going_;
};

} // namespace sivid

#endif // SIVID_VERIFIER_CLAIM_DETAIL_DRAWING_CHECK_HPP
