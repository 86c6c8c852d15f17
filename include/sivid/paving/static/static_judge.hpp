// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_STATIC_JUDGE_HPP
#define SIVID_PAVING_STATIC_STATIC_JUDGE_HPP

#include <sivid/number/pack.hpp>
#include <sivid/paving/static/detail/static_block.hpp>
#include <sivid/paving/static/mean_value_cut.hpp>
#include <sivid/paving/static/static_program.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// Tests W boxes at once against at most 64 measurements of a static problem.
///   outside: more than q are violated throughout; inside: at least n - q hold throughout. Of an
///   open measurement the range is enclosed by the graph; where the channel is differentiable by
///   the mean-value form \f$ g(m) + \nabla g(x) (x - m) \f$ too, which also contracts: the box to
///   what may be feasible, and its core to what may be infeasible.
/// @guarantee  sound for each box, whatever its lane's neighbours
/// @cost  only open measurements of a batch are evaluated
template <std::size_t W>
class static_judge {
    using I = pack<W>;
    using traits = interval_traits<I>;
    using mask = typename traits::mask;
    static_assert(box_chunk::capacity % W == 0);

public:
    /// @param program, samples  of one problem; kept by reference
    static_judge(static_program const& program, static_samples const& samples, std::size_t outliers)
        : program_(program),
          samples_(samples),
          outliers_(outliers),
          memory_(program.memory<I>()),
          cut_(program),
          slope_(program.parameters()) {
        sides_.resize(program_.parameters());
        core_lower_.resize(program_.parameters());
        core_upper_.resize(program_.parameters());
    }

    struct finding {
        std::uint64_t outside = 0, inside = 0; ///< a bit for each lane
    };

    /// Boxes first .. first + W - 1 of a block; contracts them and closes what is decided.
    [[nodiscard]] finding operator()(static_block& l, std::size_t first) {
        if (l.list != list_) prepare(l.list);
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            sides_[j] = I::load(l.boxes.lower(j) + first, l.boxes.upper(j) + first);
        }
        program_.start(memory_, [this](std::size_t j) { return sides_[j]; });
        finding found;
        std::uint64_t all = 0;
        for (std::size_t n = 0; n < W; ++n) all |= l.open[first + n];
        asked_ += W * static_cast<std::size_t>(std::popcount(all));
        for (auto rest = all; rest != 0; rest &= rest - 1) {
            auto& e = entries_[static_cast<std::size_t>(std::countr_zero(rest))];
            memory_.time = e.time_undefined;
            restore(program_.timed(e.channel), e.timed);
            e.undefined = 0;
            auto const& y = program_.value(memory_, e.channel, e.undefined);
            save(program_.kept(e.channel), e.kept);
            close(l, first, rest & (~rest + 1), traits::subset(y, e.bound) & ~e.undefined,
                  traits::disjoint(y, e.bound));
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
    /// Measurements that were looked at, lane by lane, so far.
    [[nodiscard]] std::size_t asked() const { return asked_; }

private:
    /// A measurement of the list.
    struct entry {
        std::size_t channel = 0;
        I bound;
        mask time_undefined{}, undefined{}; ///< by its time alone; where it was evaluated last
        std::vector<I> timed,
            kept; ///< what its time alone decides; what its gradient needs besides
    };

    void prepare(static_list const& list) {
        list_ = list;
        entries_.resize(list->size());
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            auto const k = (*list)[i];
            auto& e = entries_[i];
            e.channel = samples_.channel(k);
            e.bound = traits::bounds(samples_.lower[k], samples_.upper[k]);
            program_.at(memory_, e.channel, traits::point(samples_.time[k]));
            e.time_undefined = memory_.time;
            e.timed.resize(program_.timed(e.channel).size());
            e.kept.resize(program_.kept(e.channel).size());
            save(program_.timed(e.channel), e.timed);
        }
    }
    /// Measurements of a channel share a program, each has what it needs of it for itself.
    void save(std::vector<node_id> const& nodes, std::vector<I>& to) const {
        for (std::size_t i = 0; i < nodes.size(); ++i) to[i] = memory_.values[nodes[i]];
    }
    void restore(std::vector<node_id> const& nodes, std::vector<I> const& from) {
        for (std::size_t i = 0; i < nodes.size(); ++i) memory_.values[nodes[i]] = from[i];
    }

    void close(static_block& l, std::size_t first, std::uint64_t bit, mask hit, mask miss) const {
        auto const decided = hit | miss;
        for (auto rest = decided; rest != 0; rest &= rest - 1) {
            auto const n = static_cast<std::size_t>(std::countr_zero(rest));
            auto& open = l.open[first + n];
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
        std::array<mask, static_block::most_open> whose{};
        std::uint64_t all = 0;
        for (auto lanes = open; lanes != 0; lanes &= lanes - 1) {
            auto const n = static_cast<std::size_t>(std::countr_zero(lanes));
            auto const own = l.open[first + n];
            all |= own;
            for (auto rest = own; rest != 0; rest &= rest - 1) {
                whose[static_cast<std::size_t>(std::countr_zero(rest))] |= mask{1} << n;
            }
        }
        for (auto rest = all; rest != 0; rest &= rest - 1) {
            auto const k = static_cast<std::size_t>(std::countr_zero(rest));
            auto const& e = entries_[k];
            mask undefined = e.undefined;
            memory_.time = e.time_undefined;
            restore(program_.timed(e.channel), e.timed);
            restore(program_.kept(e.channel), e.kept);
            program_.differentiate_at(memory_, e.channel, undefined);
            add_slopes(e.channel, whose[k]);
            if (!program_.differentiable(e.channel)) continue;
            auto const says = cut_.use(program_, memory_, e.channel, e.bound, whose[k] & ~undefined,
                                       outer_, inner_);
            close(l, first, std::uint64_t{1} << k, says.hit, says.miss);
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
    [[nodiscard]] static std::size_t count_open(static_block const& l, std::size_t i) {
        return static_cast<std::size_t>(std::popcount(l.open[i]));
    }

    void add_slopes(std::size_t c, mask whose) {
        std::array<double, W> own{}, lo{}, hi{};
        for (std::size_t n = 0; n < W; ++n) own[n] = static_cast<double>((whose >> n) & 1U);
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            program_.slope(memory_, c, j).store(lo.data(), hi.data());
            for (std::size_t n = 0; n < W; ++n) {
                double const size = own[n] * std::max(std::abs(lo[n]), std::abs(hi[n]));
                slope_[j][n] = std::max(slope_[j][n], size);
            }
        }
    }

    static_program const& program_;
    static_samples const& samples_;
    std::size_t outliers_;
    static_memory<I> memory_;
    mean_value_cut<W> cut_;
    static_list list_;
    std::vector<entry> entries_;
    std::vector<I> sides_;
    mask outer_ = 0, inner_ = 0;
    std::size_t asked_ = 0;
    std::vector<std::array<double, W>> slope_, core_lower_, core_upper_;
};

} // namespace sivid

#endif
