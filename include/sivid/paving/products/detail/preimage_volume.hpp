// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PRODUCTS_DETAIL_PREIMAGE_VOLUME_HPP
#define SIVID_PAVING_PRODUCTS_DETAIL_PREIMAGE_VOLUME_HPP

#include <sivid/paving/products/reduction.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sivid {

/// Into how many parts the prior of the factors is cut to measure the preimage of so many boxes.
[[nodiscard]] inline std::size_t volume_cells(std::size_t boxes) {
    return std::clamp<std::size_t>(400'000 / (boxes + 1), 8, 200);
}

/// Encloses the volume of all original parameters that a reduction maps into boxes of the reduced
/// ones, relative to the prior:
///   \f$ \int \prod_k |[r_k] / m_k(o) \cap [p_k]| \, do \f$, where the pivot p_k stands with power
///   one in the product \f$ p_k m_k(o) \f$ and the factors o run through the prior. The prior of o
///   is subdivided where the enclosure is widest.
class preimage_volume {
    using traits = interval_traits<interval>;

public:
    preimage_volume(reduction const& map, box prior) : map_(&map), prior_(std::move(prior)) {
        std::vector<bool> is_factor(prior_.size(), false);
        for (auto const& s : map.sides()) {
            if (!s.product) continue;
            for (std::size_t j = 0; j < prior_.size(); ++j) {
                if (s.product->exponents[j] != 0) is_factor[j] = true;
            }
        }
        for (auto const& s : map.sides()) is_factor[s.parameter] = false;
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            if (is_factor[j] && width(prior_[j]) > 0) factors_.push_back(j);
        }
    }

    /// @param boxes  of the reduced parameters, which overlap in faces only
    /// @param cells  parts of the prior of the factors, at most
    /// @returns in a time O(cells * boxes)
    /// @param keep_going  once false, the parts stay as they are: wider, as sound; may be empty
    [[nodiscard]] interval operator()(std::vector<box> const& boxes, std::size_t cells = 200,
                                      double accuracy = 2e-3,
                                      std::function<bool()> const& keep_going = {}) const {
        std::vector<interval> plain;
        for (auto const& r : boxes) plain.push_back(plain_share(r));
        auto const cell_at = [&](box p) {
            cell c{traits::point(0.0), std::move(p)};
            for (std::size_t b = 0; b < boxes.size(); ++b) {
                c.volume = traits::add(c.volume, traits::mul(plain[b], share(boxes[b], c.part)));
            }
            for (auto const j : factors_) {
                c.volume = traits::mul(c.volume, length_ratio(c.part[j], prior_[j]));
            }
            return c;
        };
        auto const narrower = [](cell const& a, cell const& b) {
            return width(a.volume) < width(b.volume);
        };
        std::vector<cell> heap{cell_at(prior_)};
        double most = upper(heap[0].volume);
        double gap = width(heap[0].volume);
        while (!factors_.empty() && heap.size() < cells && gap > accuracy * most &&
               (!keep_going || keep_going())) {
            std::pop_heap(heap.begin(), heap.end(), narrower);
            auto const worst = std::move(heap.back());
            heap.pop_back();
            auto const j = widest_factor(worst.part);
            double const cut = mid(worst.part[j]);
            gap -= width(worst.volume);
            most -= upper(worst.volume);
            auto [low, high] = bisect(worst.part, j, cut);
            for (auto* half : {&low, &high}) {
                heap.push_back(cell_at(std::move(*half)));
                gap += width(heap.back().volume);
                most += upper(heap.back().volume);
                std::push_heap(heap.begin(), heap.end(), narrower);
            }
        }
        auto total = traits::point(0.0);
        for (auto const& c : heap) total = traits::add(total, c.volume);
        return traits::intersect(total, traits::bounds(0.0, 1.0));
    }

private:
    struct cell {
        interval volume;
        box part; ///< of the prior; only the factors are cut
    };

    [[nodiscard]] static interval length(interval const& x) {
        return traits::sub(traits::point(x.upper()), traits::point(x.lower()));
    }
    [[nodiscard]] static interval length_ratio(interval const& part, interval const& whole) {
        bool undefined = false;
        return traits::div(length(part), length(whole), undefined);
    }

    /// The share of the sides that are parameters themselves.
    [[nodiscard]] interval plain_share(box const& r) const {
        auto result = traits::point(1.0);
        for (std::size_t k = 0; k < r.size(); ++k) {
            auto const& s = map_->sides()[k];
            if (s.product || !(width(prior_[s.parameter]) > 0)) continue;
            result = traits::mul(result, length_ratio(traits::intersect(r[k], prior_[s.parameter]),
                                                      prior_[s.parameter]));
        }
        return result;
    }
    /// Encloses the share of the pivots for all factors in a cell.
    [[nodiscard]] interval share(box const& r, box const& p) const {
        auto result = traits::point(1.0);
        for (std::size_t k = 0; k < r.size(); ++k) {
            auto const& s = map_->sides()[k];
            if (s.product) result = traits::mul(result, pivot_share(s, r[k], p));
        }
        return result;
    }
    [[nodiscard]] interval pivot_share(reduction::side const& s, interval const& r,
                                       box const& p) const {
        auto const unknown = traits::bounds(0.0, 1.0);
        auto const& pivot = prior_[s.parameter];
        auto others = *s.product;
        others.exponents[s.parameter] = 0;
        auto const m = others.over(p);
        if (!(width(pivot) > 0)) {
            auto const product = traits::mul(pivot, m);
            if (traits::subset(product, r)) return traits::point(1.0);
            return disjoint(product, r) ? traits::point(0.0) : unknown;
        }
        if (!(mig(m) > 0) || !is_bounded(m)) return unknown;
        bool undefined = false;
        auto from = traits::div(traits::point(r.lower()), m, undefined);
        auto to = traits::div(traits::point(r.upper()), m, undefined);
        if (upper(m) < 0) std::swap(from, to);
        if (undefined) return unknown;
        double const lo = pivot.lower();
        double const hi = pivot.upper();
        auto const difference = [](double a, double b) {
            return traits::sub(traits::point(a), traits::point(b));
        };
        double const most =
            difference(std::min(to.upper(), hi), std::max(from.lower(), lo)).upper();
        double const least =
            difference(std::min(to.lower(), hi), std::max(from.upper(), lo)).lower();
        auto size = traits::bounds(std::max(least, 0.0), std::max({most, least, 0.0}));
        // Whole lengths know how both ends move together.
        auto const whole = traits::abs(traits::div(length(r), m, undefined));
        bool const fits = lo <= from.lower() && to.upper() <= hi;
        size = traits::intersect(size, fits ? whole : traits::bounds(0.0, whole.upper()));
        return traits::intersect(traits::div(size, length(pivot), undefined), unknown);
    }

    [[nodiscard]] std::size_t widest_factor(box const& p) const {
        auto const spread = [&](std::size_t j) {
            return width(p[j]) / std::max(mag(p[j]), 1e-3 * width(prior_[j]));
        };
        return *std::max_element(factors_.begin(), factors_.end(),
                                 [&](auto a, auto b) { return spread(a) < spread(b); });
    }

    reduction const* map_;
    box prior_;
    std::vector<std::size_t> factors_; ///< parameters of products that are no pivots
};

} // namespace sivid

#endif
