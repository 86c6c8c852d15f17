// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_JUDGE_HPP
#define SIVID_PAVING_STATIC_JUDGE_HPP

#include <sivid/number/pack_traits.hpp>
#include <sivid/paving/flat_paving.hpp>
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

/// Boxes that wait, with the measurements that are still open for each.
struct static_block {
    static_block(std::size_t sides, std::size_t words)
        : boxes(sides), open(box_chunk::capacity * words), missed(box_chunk::capacity) {}

    box_chunk boxes;
    std::vector<std::uint64_t> open;   ///< by box and word: bit k is set while k is not decided
    std::vector<std::uint32_t> missed; ///< by box: measurements that are certainly violated
    std::size_t count = 0;

    [[nodiscard]] bool full() const { return count == box_chunk::capacity; }
    void copy(static_block const& from, std::size_t i, std::size_t to) {
        boxes.copy(from.boxes, i, to);
        missed[to] = from.missed[i];
        auto const words = open.size() / box_chunk::capacity;
        for (std::size_t w = 0; w < words; ++w) open[to * words + w] = from.open[i * words + w];
    }
    /// Copies of the last box up to a multiple of the lanes.
    void pad(std::size_t lanes) {
        for (auto i = count; i % lanes != 0; ++i) copy(*this, count - 1, i);
    }
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
          centre_(memory_),
          words_((program_.outputs() + 63) / 64),
          smear_(program_.parameters()) {
        for (std::size_t k = 0; k < program_.outputs(); ++k) {
            auto const& b = problem.measurements[k].bound;
            bounds_.push_back(traits::bounds(b.lower(), b.upper()));
            mean_value_.push_back(program_.differentiable(k) &&
                                  (use == first_order::always ||
                                   (use == first_order::where_it_helps && program_.repeats(k))));
        }
        for (auto* v : {&sides_, &core_, &whole_, &middle_, &deviation_, &terms_}) {
            v->resize(program_.parameters());
        }
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
    /// How far side j of the box in a lane spreads the outputs that were open, in widths of their
    /// bounds.
    [[nodiscard]] double smear(std::size_t j, std::size_t lane) const { return smear_[j][lane]; }

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
        for (auto& s : smear_) s.fill(0);
        find_roles(l, first, open);
        core_ = whole_ = sides_;
        bool centred = false;
        mask centre_cut{};
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
                add_smear(k, whose[bit]);
                if (!mean_value_[k]) continue;
                if (!centred) centre_cut = centre();
                centred = true;
                mask bad = undefined | centre_cut;
                auto const value = program_.value(centre_, k, bad);
                contract(l, first, k, value, whose[bit] & ~bad);
            }
        }
        if (!centred) return;
        conclude(l, first, found);
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            found.outside |= traits::is_empty(sides_[j]) & open;
            found.inside |= traits::is_empty(core_[j]) & open;
            core_[j] = traits::intersect(core_[j], sides_[j]);
            found.inside |= traits::is_empty(core_[j]) & open & ~found.outside;
            sides_[j].store(l.boxes.lower(j) + first, l.boxes.upper(j) + first);
            core_[j].store(core_lower_[j].data(), core_upper_[j].data());
        }
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

    void add_smear(std::size_t k, mask whose) {
        std::array<double, W> own{}, lo{}, hi{}, from{}, to{};
        for (std::size_t n = 0; n < W; ++n) own[n] = static_cast<double>((whose >> n) & 1U);
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            program_.slope(memory_, k, j).store(lo.data(), hi.data());
            whole_[j].store(from.data(), to.data());
            for (std::size_t n = 0; n < W; ++n) {
                double const size = std::max(std::abs(lo[n]), std::abs(hi[n]));
                double const spread = own[n] * size * (to[n] - from[n]);
                smear_[j][n] = std::max(smear_[j][n], spread);
            }
        }
    }

    /// Midpoints of the sides into `centre_`. @returns where the common part is not defined there
    mask centre() {
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            std::array<double, W> lo{}, hi{};
            whole_[j].store(lo.data(), hi.data());
            for (std::size_t n = 0; n < W; ++n) lo[n] += 0.5 * (hi[n] - lo[n]);
            middle_[j] = I::load(lo.data(), lo.data());
            deviation_[j] = traits::sub(whole_[j], middle_[j]);
        }
        return program_.start(centre_, [this](std::size_t j) { return middle_[j]; });
    }

    /// \f$ g_k(p) = g_k(m) + \sum_j d_j (p_j - m_j) \f$ with some d in the gradient over the box:
    /// closes k where that decides, keeps in `sides_` what may satisfy it and in `core_` what may
    /// violate it, in the lanes `use`.
    void contract(static_block& l, std::size_t first, std::size_t k, I const& value, mask use) {
        I y = value;
        for (std::size_t j = 0; j < terms_.size(); ++j) {
            terms_[j] = traits::mul(program_.slope(memory_, k, j), deviation_[j]);
            y = traits::add(y, terms_[j]);
        }
        y = traits::intersect(y, program_.last_value(memory_, k));
        auto const& b = bounds_[k];
        close(l, first, k / 64, std::uint64_t{1} << (k % 64), traits::subset(y, b) & use,
              traits::disjoint(y, b) & use);
        if ((outer_ & use) != 0) shrink(sides_, traits::sub(b, value), k, outer_ & use);
        if ((inner_ & use) == 0) return;
        // What violates: above the bound where y is not below it, and the other way round.
        std::array<double, W> lo{}, hi{}, from{}, to{};
        y.store(lo.data(), hi.data());
        b.store(from.data(), to.data());
        for (std::size_t n = 0; n < W; ++n) {
            bool const only_above = lo[n] >= from[n], only_below = hi[n] <= to[n];
            lo[n] = only_above ? to[n] : -HUGE_VAL;
            hi[n] = only_below && !only_above ? from[n] : HUGE_VAL;
        }
        shrink(core_, traits::sub(I::load(lo.data(), hi.data()), value), k, inner_ & use);
    }

    /// Contracts x, in some lanes, to what may have \f$ \sum_j d_j (p_j - m_j) \in target \f$.
    void shrink(std::vector<I>& x, I const& target, std::size_t k, mask use) {
        for (std::size_t j = 0; j < x.size(); ++j) {
            I others = target;
            for (std::size_t i = 0; i < x.size(); ++i) {
                if (i != j) others = traits::sub(others, terms_[i]);
            }
            mask undefined{};
            I allowed = traits::add(traits::div(others, program_.slope(memory_, k, j), undefined),
                                    middle_[j]);
            auto const lanes = use & ~undefined; // a slope of 0 excludes nothing
            if (lanes == 0) continue;
            if (lanes != traits::all_lanes) {
                auto const kept = [lanes](double bound) {
                    return [lanes, bound](std::size_t n) {
                        return ((lanes >> n) & 1U) != 0 ? std::nan("") : bound;
                    };
                };
                allowed =
                    traits::hull(allowed, traits::from_lanes(kept(-HUGE_VAL), kept(HUGE_VAL)));
            }
            x[j] = traits::intersect(x[j], allowed);
        }
    }

    static_program program_;
    std::size_t outliers_;
    std::vector<I> memory_, centre_;
    std::size_t words_;
    std::vector<I> bounds_, sides_, core_, whole_, middle_, deviation_, terms_;
    mask outer_ = 0, inner_ = 0;
    std::vector<mask> undefined_; ///< of the outputs that were evaluated last
    std::vector<bool> mean_value_;
    std::vector<std::array<double, W>> smear_, core_lower_, core_upper_;
};

} // namespace sivid

#endif
