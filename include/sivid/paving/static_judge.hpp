// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_JUDGE_HPP
#define SIVID_PAVING_STATIC_JUDGE_HPP

#include <sivid/number/pack_traits.hpp>
#include <sivid/paving/mean_value_cut.hpp>
#include <sivid/paving/static_block.hpp>
#include <sivid/paving/static_program.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// Whether boxes are contracted by mean-value forms.
enum class first_order {
    never,
    where_it_helps, ///< for outputs in which a parameter stands more than once
    always
};

/// Tests W boxes at once against the measurements of a static problem.
///   outside: more than q are violated throughout; inside: at least n - q hold throughout. Of an
///   open measurement the range is enclosed by the graph; by the mean-value form
///   \f$ g(m) + \nabla g(x) (x - m) \f$ too where asked, which also contracts: the box to what may
///   be feasible, and its core to what may be infeasible.
/// @guarantee  sound for each box, whatever its lane's neighbours
/// @cost  only open measurements of a batch are evaluated
template <std::size_t W>
class static_judge {
    using I = pack<W>;
    using traits = interval_traits<I>;
    using mask = typename traits::mask;
    static_assert(box_chunk::capacity % W == 0);

public:
    static_judge(static_problem const& problem, first_order use)
        : program_(problem),
          outliers_(problem.outliers),
          memory_(program_.template memory<I>()),
          cut_(program_),
          words_((program_.outputs() + 63) / 64),
          slope_(program_.parameters()) {
        for (std::size_t k = 0; k < program_.outputs(); ++k) {
            auto const& b = problem.measurements[k].bound;
            bounds_.push_back(traits::bounds(b.lower(), b.upper()));
            mean_value_.push_back(program_.differentiable(k) &&
                                  (use == first_order::always ||
                                   (use == first_order::where_it_helps && program_.repeats(k))));
        }
        sides_.resize(program_.parameters());
        core_lower_.resize(program_.parameters());
        core_upper_.resize(program_.parameters());
        undefined_.resize(program_.outputs());
    }

    [[nodiscard]] std::size_t words() const { return words_; }
    /// Everything is open for box i.
    void open_all(static_block& l, std::size_t i) const {
        for (std::size_t w = 0; w < words_; ++w) {
            auto const rest = program_.outputs() - 64 * w;
            l.open[i * words_ + w] =
                rest >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rest) - 1;
        }
        l.missed[i] = 0;
    }

    struct finding {
        std::uint64_t outside = 0, inside = 0; ///< a bit for each lane
    };

    /// Boxes first .. first + W - 1 of a block; contracts them and closes what is decided.
    [[nodiscard]] finding operator()(static_block& l, std::size_t first) {
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            sides_[j] = I::load(l.boxes.lower(j) + first, l.boxes.upper(j) + first);
        }
        mask const cut = program_.start(memory_, [this](std::size_t j) { return sides_[j]; });
        finding found;
        for (std::size_t w = 0; w < words_; ++w) {
            std::uint64_t all = 0;
            for (std::size_t n = 0; n < W; ++n) all |= l.open[(first + n) * words_ + w];
            for (auto rest = all; rest != 0; rest &= rest - 1) {
                auto const k = 64 * w + static_cast<std::size_t>(std::countr_zero(rest));
                auto& undefined = undefined_[k] = cut;
                auto const& y = program_.value(memory_, k, undefined);
                close(l, first, w, rest & (~rest + 1), traits::subset(y, bounds_[k]) & ~undefined,
                      traits::disjoint(y, bounds_[k]));
            }
        }
        conclude(l, first, found);
        auto const open = traits::all_lanes & ~(found.outside | found.inside);
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            sides_[j].store(core_lower_[j].data(), core_upper_[j].data());
        }
        if (open != 0) refine(l, first, open, found);
        return found;
    }

    /// The part of the box in a lane outside which the contracted box is inside.
    [[nodiscard]] double core_lower(std::size_t j, std::size_t lane) const {
        return core_lower_[j][lane];
    }
    [[nodiscard]] double core_upper(std::size_t j, std::size_t lane) const {
        return core_upper_[j][lane];
    }
    /// The steepest slope by parameter j of the outputs that were open in a lane.
    [[nodiscard]] double slope(std::size_t j, std::size_t lane) const { return slope_[j][lane]; }

private:
    void close(static_block& l, std::size_t first, std::size_t w, std::uint64_t bit, mask hit,
               mask miss) const {
        auto const decided = hit | miss;
        for (auto rest = decided; rest != 0; rest &= rest - 1) {
            auto const n = static_cast<std::size_t>(std::countr_zero(rest));
            auto& open = l.open[(first + n) * words_ + w];
            if ((open & bit) == 0) continue;
            open &= ~bit;
            l.missed[first + n] += (miss >> n) & 1U;
        }
    }
    void conclude(static_block const& l, std::size_t first, finding& found) const {
        for (std::size_t n = 0; n < W; ++n) {
            auto const bit = std::uint64_t{1} << n;
            std::size_t const missed = l.missed[first + n];
            auto const left = count_open(l, first + n);
            if (missed > outliers_) {
                found.outside |= bit;
            } else if (missed + left <= outliers_) {
                found.inside |= bit;
            }
        }
    }

    /// Gradients of what is open: where to cut, and mean-value forms.
    void refine(static_block& l, std::size_t first, mask open, finding& found) {
        for (auto& s : slope_) s.fill(0);
        find_roles(l, first, open);
        cut_.begin(sides_);
        for (std::size_t w = 0; w < words_; ++w) {
            std::array<mask, 64> whose{};
            std::uint64_t all = 0;
            for (auto lanes = open; lanes != 0; lanes &= lanes - 1) {
                auto const n = static_cast<std::size_t>(std::countr_zero(lanes));
                auto const own = l.open[(first + n) * words_ + w];
                all |= own;
                for (auto rest = own; rest != 0; rest &= rest - 1) {
                    whose[static_cast<std::size_t>(std::countr_zero(rest))] |= mask{1} << n;
                }
            }
            for (auto rest = all; rest != 0; rest &= rest - 1) {
                auto const bit = static_cast<std::size_t>(std::countr_zero(rest));
                auto const k = 64 * w + bit;
                mask undefined = undefined_[k];
                program_.differentiate_at(memory_, k, undefined);
                add_slopes(k, whose[bit]);
                if (!mean_value_[k]) continue;
                auto const says = cut_.use(program_, memory_, k, bounds_[k],
                                           whose[bit] & ~undefined, outer_, inner_);
                close(l, first, w, std::uint64_t{1} << bit, says.hit, says.miss);
            }
        }
        if (!cut_.used()) return;
        conclude(l, first, found);
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            auto const& rest = cut_.rest(j);
            found.outside |= traits::is_empty(rest) & open;
            auto const core = traits::intersect(cut_.core(j), rest);
            found.inside |= traits::is_empty(core) & open;
            rest.store(l.boxes.lower(j) + first, l.boxes.upper(j) + first);
            core.store(core_lower_[j].data(), core_upper_[j].data());
        }
        found.inside &= ~found.outside;
    }

    /// In which lanes every open measurement must hold for a point to be feasible (no violation is
    /// spare), and in which all must be violated for it not to be (one hit decides).
    void find_roles(static_block const& l, std::size_t first, mask open) {
        outer_ = inner_ = 0;
        for (auto lanes = open; lanes != 0; lanes &= lanes - 1) {
            auto const n = static_cast<std::size_t>(std::countr_zero(lanes));
            auto const spare = outliers_ - l.missed[first + n];
            if (spare == 0) outer_ |= mask{1} << n;
            if (count_open(l, first + n) == spare + 1) inner_ |= mask{1} << n;
        }
    }
    [[nodiscard]] std::size_t count_open(static_block const& l, std::size_t i) const {
        std::size_t left = 0;
        for (std::size_t w = 0; w < words_; ++w) {
            left += static_cast<std::size_t>(std::popcount(l.open[i * words_ + w]));
        }
        return left;
    }

    void add_slopes(std::size_t k, mask whose) {
        std::array<double, W> own{}, lo{}, hi{};
        for (std::size_t n = 0; n < W; ++n) own[n] = static_cast<double>((whose >> n) & 1U);
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            program_.slope(memory_, k, j).store(lo.data(), hi.data());
            for (std::size_t n = 0; n < W; ++n) {
                double const size = own[n] * std::max(std::abs(lo[n]), std::abs(hi[n]));
                slope_[j][n] = std::max(slope_[j][n], size);
            }
        }
    }

    static_program program_;
    std::size_t outliers_;
    std::vector<I> memory_;
    mean_value_cut<W> cut_;
    std::size_t words_;
    std::vector<I> bounds_, sides_;
    mask outer_ = 0, inner_ = 0;
    std::vector<mask> undefined_; ///< of the outputs that were evaluated last
    std::vector<bool> mean_value_;
    std::vector<std::array<double, W>> slope_, core_lower_, core_upper_;
};

} // namespace sivid

#endif
