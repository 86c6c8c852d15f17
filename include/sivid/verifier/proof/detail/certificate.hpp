// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_CERTIFICATE_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_CERTIFICATE_HPP

#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/proof/detail/certificate_options.hpp>
#include <sivid/verifier/proof/detail/proved_campaign.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Something that a result says of a box of parameters, to be proved anew.
struct box_claim {
    enum class kind { inside, outside };
    enum class status { proved, refuted, open };

    box set;
    kind what = kind::outside;
    status found = status::open;
    std::vector<double> counterexample = {}; ///< a point that proves the contrary, when refuted
};

namespace io_detail {

/// A part of a claim's box.
struct claim_piece {
    box set;
    std::size_t claim;
    std::size_t cuts = 0; ///< of the claim's box that led to it
};

[[nodiscard]] inline box hull_of(std::vector<claim_piece> const& pieces) {
    auto region = pieces[0].set;
    for (auto const& p : pieces) region = hull(region, p.set);
    return region;
}

/// What is left to prove of claims.
struct claim_book {
    std::vector<box_claim>* claims = nullptr;
    std::vector<std::size_t> left; ///< pieces to prove, by claim
    std::vector<bool> gave_up;

    /// @param wanted  of claims that are open. @returns their boxes
    template <class Wanted>
    std::vector<claim_piece> open(std::vector<box_claim>& all, Wanted const& wanted) {
        claims = &all;
        left.assign(all.size(), 0);
        gave_up.assign(all.size(), false);
        std::vector<claim_piece> pieces;
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (all[k].found != box_claim::status::open || !wanted(all[k])) continue;
            left[k] = 1;
            pieces.push_back({all[k].set, k});
        }
        return pieces;
    }
    [[nodiscard]] box_claim& of(claim_piece const& p) const { return (*claims)[p.claim]; }
    void prove(claim_piece const& p) {
        if (--left[p.claim] == 0 && !gave_up[p.claim]) of(p).found = box_claim::status::proved;
    }
    void give_up(std::vector<claim_piece> const& pieces) {
        for (auto const& p : pieces) gave_up[p.claim] = true;
    }
};

/// The side that is widest against the prior's, of those that are wider than `least` of it.
[[nodiscard]] inline std::optional<std::size_t> widest_side(box const& x, box const& prior,
                                                            double least = -1) {
    std::optional<std::size_t> best;
    for (std::size_t j = 0; j < x.size(); ++j) {
        double const whole = width(prior[j]);
        if (is_one_number(prior[j]) || !(width(x[j]) / whole > least)) continue;
        least = width(x[j]) / whole;
        best = j;
    }
    return best;
}

} // namespace io_detail

/// Proves or refutes claims about boxes by plain runs, in subdivisions of its own.
///   Claims are run together while they lie close; what the run leaves open is split: the group
///   about its median, a single box where its outputs spread most.
/// @guarantee  `proved` and `refuted` are proofs in the arithmetic of I, from the same model and
/// data; `open` says nothing
/// @tparam I  the interval type of the runs
template <class I>
class claim_checker {
public:
    /// @param starts  where existence is to be proved from, a box per experiment; may be empty (all
    /// starts of the experiment then)
    claim_checker(identification_problem const& problem, std::vector<box> starts,
                  certificate_options options)
        : prior_(problem.prior),
          campaign_(problem, std::move(starts), options),
          options_(std::move(options)) {}

    [[nodiscard]] std::size_t runs() const { return campaign_.runs(); }

    /// Tries the claims that are open.
    void operator()(std::vector<box_claim>& claims) {
        limit_ = work_limit(options_.seconds, options_.keep_going);
        spent_.assign(claims.size(), 0);
        settle(book_.open(claims, [](box_claim const&) { return true; }));
    }

private:
    using status = box_claim::status;
    using piece = io_detail::claim_piece;
    using group = std::vector<piece>;
    using knowledge = typename proved_campaign<I>::knowledge;

    [[nodiscard]] bool is_inside(piece const& p) const {
        return book_.of(p).what == box_claim::kind::inside;
    }
    [[nodiscard]] bool over() const { return !limit_(); }
    void refute(piece const& p, std::vector<double> at) {
        book_.of(p).found = status::refuted;
        book_.of(p).counterexample = std::move(at);
    }

    /// Looks for a point inside the piece that contradicts its claim.
    void probe(piece const& p, knowledge const& known) {
        auto const wrong = is_inside(p) ? run_finding::refuted : run_finding::explained;
        auto const n = std::min<std::size_t>(p.set.size(), 4);
        for (std::size_t corner = 0; corner <= (std::size_t{1} << n); ++corner) {
            auto at = mid(p.set);
            for (std::size_t j = 0; j < n && corner > 0; ++j) {
                double const w = p.set[j].upper() - p.set[j].lower();
                double const x = at[j] + ((((corner - 1) >> j) & 1) != 0 ? 0.4 : -0.4) * w;
                if (contains(p.set[j], x)) at[j] = x;
            }
            if (campaign_.judge(known, point_box(at)) != wrong) continue;
            refute(p, at);
            return;
        }
    }

    /// The side along which the outputs of the piece spread most, if it can be cut.
    [[nodiscard]] std::optional<std::size_t> side_to_cut(box const& x,
                                                         knowledge const* known) const {
        std::optional<std::size_t> best;
        double most = -1;
        for (std::size_t j = 0; j < x.size(); ++j) {
            double const w = x[j].upper() - x[j].lower();
            double const middle = mid(x[j]);
            if (!(x[j].lower() < middle && middle < x[j].upper())) continue;
            double const spread =
                known != nullptr ? campaign_.spread(*known, x, j) : w / width(prior_[j]);
            if (spread > most) {
                most = spread;
                best = j;
            }
        }
        return best;
    }

    void settle(group pieces) {
        std::erase_if(pieces, [this](piece const& p) {
            return book_.of(p).found == status::refuted || book_.gave_up[p.claim];
        });
        if (pieces.empty()) return;
        if (over()) return book_.give_up(pieces);
        auto const region = io_detail::hull_of(pieces);
        bool wide = false;
        for (std::size_t j = 0; j < region.size(); ++j) {
            wide = wide || (!is_one_number(prior_[j]) &&
                            width(region[j]) > options_.widest_region * width(prior_[j]));
        }
        if (wide && split(pieces, region, nullptr)) return;
        bool const seek = std::any_of(pieces.begin(), pieces.end(),
                                      [this](piece const& p) { return is_inside(p); });
        auto const known = campaign_.learn(region, seek);
        group rest;
        for (auto& p : pieces) {
            auto const says = campaign_.judge(known, p.set);
            auto const right = is_inside(p) ? run_finding::explained : run_finding::refuted;
            if (says == right) {
                book_.prove(p);
            } else if (says != run_finding::open) {
                refute(p, mid(p.set));
            } else {
                rest.push_back(std::move(p));
            }
        }
        if (rest.size() == 1 && pieces.size() > 1) { // a region of its own says more
            settle(std::move(rest));
            return;
        }
        for (auto const& p : rest) probe(p, known);
        if (rest.size() == 1 && ++spent_[rest[0].claim] >= options_.runs_per_claim) {
            return book_.give_up(rest);
        }
        if (!rest.empty() && !split(rest, region, &known)) book_.give_up(rest);
    }

    /// A group by the median of its centres, one box by a cut. @returns false if neither is
    /// possible.
    bool split(group& pieces, box const& region, knowledge const* known) {
        if (pieces.size() == 1) {
            auto const side = side_to_cut(pieces[0].set, known);
            if (!side) return false;
            auto const& x = pieces[0].set;
            auto [low, high] = bisect(x, *side, mid(x[*side]));
            auto const claim = pieces[0].claim;
            ++book_.left[claim];
            settle({{std::move(low), claim}});
            settle({{std::move(high), claim}});
            return true;
        }
        auto const widest = io_detail::widest_side(region, prior_).value_or(0);
        auto const half = pieces.begin() + static_cast<std::ptrdiff_t>(pieces.size() / 2);
        std::nth_element(pieces.begin(), half, pieces.end(), [&](piece const& a, piece const& b) {
            return mid(a.set[widest]) < mid(b.set[widest]);
        });
        group upper(std::make_move_iterator(half), std::make_move_iterator(pieces.end()));
        pieces.erase(half, pieces.end());
        settle(std::move(pieces));
        settle(std::move(upper));
        return true;
    }

    box prior_;
    proved_campaign<I> campaign_;
    certificate_options options_;
    io_detail::claim_book book_;
    std::vector<std::size_t> spent_; ///< single runs, by claim
    work_limit limit_{0};
};

} // namespace sivid

#endif
