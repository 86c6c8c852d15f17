// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_PRODUCT_VOLUME_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_PRODUCT_VOLUME_HPP

#include <sivid/space/box.hpp>
#include <sivid/verifier/claim/detail/stored_products.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <utility>
#include <vector>

namespace sivid {

/// The share of a prior whose products lie in given boxes, box by box:
///   where it is known which ends of a pivot's range are those of its prior, the volume is an
///   integral of powers of the factors, in closed form; where that changes, the prior of the
///   factors is cut. It shares no code with `preimage_volume`.
/// @tparam I  the interval type of all sums and integrals
template <class I>
class product_volume {
    using traits = interval_traits<I>;

public:
    product_volume(stored_products const& products, box const& prior)
        : products_(&products), prior_(prior), is_factor_(prior.size(), false) {
        for (std::size_t k = 0; k < products.sides.size(); ++k) {
            for (std::size_t j = 0; j < prior.size(); ++j) {
                if (j != products.pivots[k] && products.sides[k].exponents()[j] != 0) {
                    is_factor_[j] = true;
                }
            }
        }
    }

    /// @param boxes  of the products, which overlap in faces only
    /// @param cells  parts of the factors' prior for one box, at most
    /// @param keep_going  once false, the answer is that it is no more than all; may be empty
    [[nodiscard]] I operator()(std::vector<box> const& boxes, std::size_t cells,
                               std::function<bool()> const& keep_going = {}) const {
        I sum = traits::point(0.0);
        for (auto const& r : boxes) {
            if (keep_going && !keep_going()) return traits::bounds(0.0, 1.0);
            sum = traits::add(sum, share(r, cells));
        }
        return sum;
    }

private:
    struct part {
        box set; ///< of the prior; only factors are cut
        I volume;
        double gap = 0;
    };

    [[nodiscard]] static I length(interval const& x) {
        return traits::sub(traits::point(x.upper()), traits::point(x.lower()));
    }
    [[nodiscard]] static I divided(I const& a, I const& b) {
        typename traits::mask undefined{};
        return traits::div(a, b, undefined);
    }

    [[nodiscard]] I share(box const& r, std::size_t cells) const {
        auto const narrower = [](part const& a, part const& b) { return a.gap < b.gap; };
        std::vector<part> parts{measured(r, prior_)};
        double most = traits::upper(parts[0].volume), gap = parts[0].gap;
        while (gap > 1e-7 * most && parts.size() < cells) {
            std::pop_heap(parts.begin(), parts.end(), narrower);
            auto const worst = std::move(parts.back());
            parts.pop_back();
            auto const j = widest(worst.set);
            if (j == prior_.size()) {
                parts.push_back(worst);
                break;
            }
            auto const [low, high] = bisect(worst.set, j, mid(worst.set[j]));
            gap -= worst.gap;
            most -= traits::upper(worst.volume);
            for (auto const* half : {&low, &high}) {
                parts.push_back(measured(r, *half));
                gap += parts.back().gap;
                most += traits::upper(parts.back().volume);
                std::push_heap(parts.begin(), parts.end(), narrower);
            }
        }
        I sum = traits::point(0.0);
        for (auto const& p : parts) sum = traits::add(sum, p.volume);
        return sum;
    }

    /// \f$ c \prod_j |o_j|^{n_j} \f$
    struct term {
        I coefficient;
        std::vector<int> powers;
    };
    /// One end of what a pivot may be: that of its prior, or of the product divided by the factors.
    enum class end { own, quotient, open };

    /// The volume of what maps into r from a part of the prior, relative to the whole prior: the
    /// integral of the product, over the sides, of what the pivots may be.
    [[nodiscard]] part measured(box const& r, box const& set) const {
        std::vector<term> terms{{traits::point(1.0), std::vector<int>(prior_.size(), 0)}};
        bool exact = true;
        for (std::size_t k = 0; k < r.size(); ++k) {
            auto const& e = products_->sides[k].exponents();
            auto const pivot = products_->pivots[k];
            auto const own = io_detail::in<I>(prior_[pivot]);
            I factors = traits::point(1.0);
            for (std::size_t j = 0; j < set.size(); ++j) {
                if (j == pivot || e[j] == 0) continue;
                typename traits::mask undefined{};
                I const power = traits::pown(io_detail::in<I>(set[j]), std::abs(e[j]), undefined);
                factors = e[j] > 0 ? traits::mul(factors, power) : divided(factors, power);
            }
            auto const image = traits::mul(own, factors);
            if (traits::subset(image, io_detail::in<I>(r[k]))) continue; // all of the pivot's prior
            if (traits::disjoint(image, io_detail::in<I>(r[k])))
                return {set, traits::point(0.0), 0};
            if (!(traits::mig(factors) > 0) || !(traits::mag(factors) < HUGE_VAL) ||
                !(width(prior_[pivot]) > 0)) {
                exact = false;
                continue;
            }
            bool const negative = traits::upper(factors) < 0;
            double const from = negative ? r[k].upper() : r[k].lower();
            double const to = negative ? r[k].lower() : r[k].upper();
            double const least = prior_[pivot].lower(), most = prior_[pivot].upper();
            I const low = divided(traits::point(from), factors);
            I const high = divided(traits::point(to), factors);
            if (traits::lower(low) >= most || traits::upper(high) <= least) {
                return {set, traits::point(0.0), 0};
            }
            auto const lower = traits::upper(low) <= least ? end::own
                               : traits::lower(low) >= least && traits::upper(low) <= most
                                   ? end::quotient
                                   : end::open;
            auto const upper = traits::lower(high) >= most ? end::own
                               : traits::upper(high) <= most && traits::lower(high) >= least
                                   ? end::quotient
                                   : end::open;
            if (lower == end::open || upper == end::open) {
                exact = false;
                continue;
            }
            // (upper - lower) / length of the prior, as constant + slope / |factors|.
            I constant = traits::point(0.0), slope = traits::point(0.0);
            auto const add = [&](end what, double bound, double quotient, double sign) {
                I& sum = what == end::own ? constant : slope;
                double const s = what == end::quotient && negative ? -sign : sign;
                sum = traits::add(sum, traits::point(s * (what == end::own ? bound : quotient)));
            };
            add(upper, most, to, 1);
            add(lower, least, from, -1);
            std::vector<term> next;
            for (auto const& t : terms) {
                next.push_back(
                    {traits::mul(t.coefficient, divided(constant, length(prior_[pivot]))),
                     t.powers});
                auto steep = t;
                steep.coefficient =
                    traits::mul(t.coefficient, divided(slope, length(prior_[pivot])));
                for (std::size_t j = 0; j < set.size(); ++j) {
                    if (j != pivot) steep.powers[j] -= e[j];
                }
                next.push_back(std::move(steep));
            }
            terms = std::move(next);
        }
        I volume = traits::point(0.0);
        for (auto const& t : terms) {
            if (traits::mag(t.coefficient) == 0) continue;
            I one = t.coefficient;
            for (std::size_t j = 0; j < set.size(); ++j) {
                if (!is_factor_[j]) continue;
                if (!(width(prior_[j]) > 0)) {
                    one = traits::mul(one, power_of(set[j], t.powers[j]));
                    continue;
                }
                one = traits::mul(one, divided(integral(set[j], t.powers[j]), length(prior_[j])));
            }
            volume = traits::add(volume, one);
        }
        if (exact) return {set, volume, 0};
        double const most = std::clamp(traits::upper(volume), 0.0, 1.0);
        return {set, traits::bounds(0.0, most), most};
    }

    /// \f$ |o|^n \f$
    [[nodiscard]] static I power_of(interval const& o, int n) {
        typename traits::mask undefined{};
        I const size = traits::pown(traits::abs(io_detail::in<I>(o)), std::abs(n), undefined);
        return n < 0 ? divided(traits::point(1.0), size) : size;
    }

    /// \f$ \int |o|^n do \f$ over an interval without 0 (or n >= 0 and any).
    [[nodiscard]] static I integral(interval const& o, int n) {
        if (n == 0) return length(o);
        if (n < 0 && contains(o, 0.0)) return traits::bounds(0.0, HUGE_VAL);
        typename traits::mask undefined{};
        auto const a = traits::abs(traits::point(o.lower()));
        auto const b = traits::abs(traits::point(o.upper()));
        if (n == -1) return traits::abs(traits::log(divided(b, a), undefined));
        // d |o|^(n+1) / (n+1), with the sign of o.
        auto const primitive = [&](I const& x) {
            I const power = traits::pown(x, std::abs(n + 1), undefined);
            I const whole = n + 1 > 0 ? power : divided(traits::point(1.0), power);
            return divided(whole, traits::point(static_cast<double>(n + 1)));
        };
        auto const signed_at = [&](double end, I const& size) {
            return end < 0 ? traits::neg(primitive(size)) : primitive(size);
        };
        return traits::sub(signed_at(o.upper(), b), signed_at(o.lower(), a));
    }

    [[nodiscard]] std::size_t widest(box const& set) const {
        std::size_t best = prior_.size();
        double most = 1e-12;
        for (std::size_t j = 0; j < set.size(); ++j) {
            if (!is_factor_[j]) continue;
            double const spread = width(set[j]) / std::max(mag(set[j]), 1e-3 * width(prior_[j]));
            if (spread > most) {
                most = spread;
                best = j;
            }
        }
        return best;
    }

    stored_products const* products_;
    box prior_;
    std::vector<bool> is_factor_;
};

} // namespace sivid

#endif // SIVID_VERIFIER_CLAIM_DETAIL_PRODUCT_VOLUME_HPP
