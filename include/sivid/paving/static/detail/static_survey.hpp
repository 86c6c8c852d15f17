// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_DETAIL_STATIC_SURVEY_HPP
#define SIVID_PAVING_STATIC_DETAIL_STATIC_SURVEY_HPP

#include <sivid/number/pack.hpp>
#include <sivid/paving/static/detail/mean_value_program.hpp>
#include <sivid/paving/static/mean_value_cut.hpp>
#include <sivid/paving/static/static_judge.hpp>
#include <sivid/paving/verdict.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// A box with the measurements that are open for it; others hold, but for `missed` ones.
struct static_box {
    box set;
    static_list open;
    std::size_t missed = 0;

    /// Memory that it takes; a list counts for each box that has it.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof *this + set.size() * sizeof(interval) +
               open->size() * sizeof(static_samples::index);
    }
};

/// Tests one box at a time against any number of measurements, W of them at once: ranges,
/// mean-value forms and linear programs over them (`mean_value_program`).
///   A few measurements are asked first, then sixteen times as many, and so on while what was asked
///   narrows the box or is mostly decided; all are asked last. What they decide for the box is not
///   asked again for its parts.
/// @guarantee  outside: more than q measurements are violated throughout; inside: all but q hold
///   throughout; what is cut off the box has no feasible point
/// @cost  O(open measurements) at most; memory for `most_rows` mean-value forms
template <std::size_t W = 8>
class static_survey {
    using I = pack<W>;
    using traits = interval_traits<I>;
    using mask = typename traits::mask;
    using index = static_samples::index;

public:
    static constexpr std::size_t first_asked = 512, most_rows = 4096;

    /// @param program, samples  of one problem; kept by reference
    /// @param seek  `points` are to begin with one deep inside, where there are no outliers
    static_survey(static_program const& program, static_samples const& samples,
                  std::size_t outliers, bool seek = false)
        : seek_(seek),
          program_(program),
          samples_(samples),
          outliers_(outliers),
          memory_(program.memory<I>()),
          cut_(program),
          sides_(program.parameters()),
          slope_(program.parameters()) {}

    /// @param whole  all measurements are asked even where a few say that the box is too large
    [[nodiscard]] box_verdict operator()(static_box& b, bool whole = true) {
        programs_helped_ = false;
        points_.clear();
        auto const& all = *b.open;
        std::size_t stride = all.size() > 2 * first_asked ? all.size() / first_asked : 1;
        std::vector<index> asked;
        for (; stride > 1; stride /= 16) {
            asked.clear();
            // Steps of no even length, lest they fit a period of the data.
            for (std::size_t i = 0, k = 0; i < all.size(); i += stride, ++k) {
                auto const place = i + k * 2654435761U % stride;
                if (place < all.size()) asked.push_back(all[place]);
            }
            auto open = asked;
            std::size_t missed = b.missed;
            if (!narrow(b.set, open, missed)) return box_verdict::outside;
            if (!whole && 2 * open.size() > asked.size()) return box_verdict::undecided;
        }
        auto open = all;
        auto missed = b.missed;
        if (!narrow(b.set, open, missed)) return box_verdict::outside;
        bool const inside = missed + open.size() <= outliers_;
        if (worth_a_list(open.size(), all.size())) {
            b.missed = missed;
            b.open = listed(std::move(open));
        }
        return inside ? box_verdict::inside : box_verdict::undecided;
    }
    /// Whether a point of a box is feasible.
    /// @guarantee  true is a proof
    [[nodiscard]] bool explains(static_box const& b, std::vector<double> const& p) {
        auto const x = point_box(p);
        begin(x);
        std::size_t missed = b.missed;
        auto const spare = outliers_;
        each_group(*b.open, [&](std::size_t c, std::size_t, mask lanes) {
            mask undefined{};
            auto const& y = program_.value(memory_, c, undefined);
            auto const hit = traits::subset(y, bound_) & ~undefined;
            missed += static_cast<std::size_t>(std::popcount(lanes & ~hit));
            return missed <= spare;
        });
        return missed <= spare;
    }

    /// The steepest slope by parameter j of what was open.
    [[nodiscard]] double slope(std::size_t j) const { return slope_[j]; }
    /// Whether linear programs took half of the last box away.
    [[nodiscard]] bool programs_helped() const { return programs_helped_; }
    /// About the corners of what is left of the last box.
    [[nodiscard]] std::vector<std::vector<double>> const& points() const { return points_; }
    /// Measurements that were looked at, in all boxes so far.
    [[nodiscard]] std::size_t asked() const { return asked_; }

private:
    /// Lists of many boxes together stay within a few times the data.
    [[nodiscard]] bool worth_a_list(std::size_t size, std::size_t former) const {
        if (size <= static_block::most_open) return size < former;
        return 4 * size <= 3 * former && *listed_ + size <= 4 * samples_.size() + 1'000'000;
    }
    [[nodiscard]] static_list listed(std::vector<index> list) const {
        list.shrink_to_fit();
        *listed_ += list.size();
        return {new std::vector<index>(std::move(list)), [total = listed_](auto const* p) {
                    *total -= p->size();
                    delete p;
                }};
    }
    void begin(box const& x) {
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            sides_[j] = traits::bounds(x[j].lower(), x[j].upper());
        }
        program_.start(memory_, [this](std::size_t j) { return sides_[j]; });
    }
    /// Calls `use` (channel, place of the first, its lanes) for measurements of one channel, W at a
    /// time, with their times and bounds in place, until it says no.
    template <class Use>
    void each_group(std::vector<index> const& list, Use const& use) {
        std::array<double, W> time{}, lower{}, upper{};
        for (std::size_t i = 0, c = 0; i < list.size();) {
            while (list[i] >= samples_.end[c]) ++c;
            std::size_t n = 0;
            for (; n < W && i + n < list.size() && list[i + n] < samples_.end[c]; ++n) {
                auto const k = list[i + n];
                time[n] = samples_.time[k];
                lower[n] = samples_.lower[k];
                upper[n] = samples_.upper[k];
            }
            for (auto l = n; l < W; ++l) {
                time[l] = time[0];
                lower[l] = lower[0];
                upper[l] = upper[0];
            }
            bound_ = I::load(lower.data(), upper.data());
            program_.at(memory_, c, I::load(time.data(), time.data()));
            asked_ += n;
            if (!use(c, i, traits::all_lanes >> (W - n))) return;
            i += n;
        }
    }

    /// Contracts a box by some measurements until little changes, and keeps the open ones of them.
    /// @returns false when nothing is left
    [[nodiscard]] bool narrow(box& x, std::vector<index>& open, std::size_t& missed) {
        for (int round = 0; round < 8; ++round) {
            auto const before = x;
            if (!ask(x, open, missed)) return false;
            if (missed + open.size() <= outliers_ || !cut_.used()) break;
            if (x.size() > 1) {
                auto const contracted = x;
                if (!programs_(x, outliers_ - missed, seek_)) return false;
                double left = 1;
                for (std::size_t j = 0; j < x.size(); ++j) {
                    if (width(contracted[j]) > 0) left *= width(x[j]) / width(contracted[j]);
                }
                programs_helped_ = programs_helped_ || left < 0.5;
                points_ = programs_.points();
            }
            bool moved = false;
            for (std::size_t j = 0; j < x.size(); ++j) {
                moved = moved || width(x[j]) < 0.9 * width(before[j]);
            }
            if (!moved) break;
            if (programs_.sharp() && programs_.size() < most_rows) return ask(x, open, missed);
        }
        return true;
    }

    /// Looks at measurements once.
    [[nodiscard]] bool ask(box& x, std::vector<index>& list, std::size_t& missed) {
        std::fill(slope_.begin(), slope_.end(), 0.0);
        begin(x);
        cut_.begin(sides_);
        bool begun = false;
        mask const outer = missed == outliers_ ? traits::all_lanes : 0;
        std::size_t kept = 0;
        bool possible = true;
        each_group(list, [&](std::size_t c, std::size_t i, mask lanes) {
            mask undefined{};
            auto const& y = program_.value(memory_, c, undefined);
            auto hit = traits::subset(y, bound_) & ~undefined & lanes;
            auto miss = traits::disjoint(y, bound_) & lanes;
            auto open = lanes & ~(hit | miss);
            mask proved = 0;
            if (open != 0) {
                program_.differentiate_at(memory_, c, undefined);
                if (program_.differentiable(c)) {
                    auto const says =
                        cut_.use(program_, memory_, c, bound_, open & ~undefined, outer, 0);
                    hit |= says.hit;
                    miss |= says.miss;
                    open &= ~(says.hit | says.miss);
                    proved = says.proved & open;
                }
            }
            missed += static_cast<std::size_t>(std::popcount(miss));
            possible = missed <= outliers_;
            if (!possible) return false;
            if (open != 0) add_slopes(c, open);
            if (proved != 0 && x.size() > 1) {
                if (!std::exchange(begun, true)) begin_rows(x);
                add_rows(c, proved);
            }
            for (; open != 0; open &= open - 1) {
                list[kept++] = list[i + static_cast<std::size_t>(std::countr_zero(open))];
            }
            return true;
        });
        if (!possible) return false;
        list.resize(kept);
        if (!begun) programs_.begin(x, mid(x));
        if (!cut_.used()) return true;
        for (std::size_t j = 0; j < x.size(); ++j) {
            std::array<double, W> lo{}, hi{};
            cut_.rest(j).store(lo.data(), hi.data());
            for (std::size_t n = 0; n < W; ++n) {
                x[j] = interval_traits<interval>::intersect(
                    x[j], interval_traits<interval>::bounds(lo[n], hi[n]));
                if (is_empty(x[j])) return false;
            }
        }
        return true;
    }

    void begin_rows(box const& x) {
        std::vector<double> middle;
        for (std::size_t j = 0; j < x.size(); ++j) middle.push_back(cut_.middle(j).lower(0));
        programs_.begin(x, std::move(middle));
    }
    void add_rows(std::size_t c, mask lanes) {
        for (; lanes != 0 && programs_.size() < most_rows; lanes &= lanes - 1) {
            auto const n = static_cast<std::size_t>(std::countr_zero(lanes));
            programs_.add(bound_[n], cut_.centre_value(program_, c)[n],
                          [&](std::size_t j) { return program_.slope(memory_, c, j)[n]; });
        }
    }
    void add_slopes(std::size_t c, mask lanes) {
        std::array<double, W> lo{}, hi{};
        for (std::size_t j = 0; j < sides_.size(); ++j) {
            program_.slope(memory_, c, j).store(lo.data(), hi.data());
            for (std::size_t n = 0; n < W; ++n) {
                if (((lanes >> n) & 1U) == 0) continue;
                slope_[j] = std::max({slope_[j], std::abs(lo[n]), std::abs(hi[n])});
            }
        }
    }

    bool seek_;
    static_program const& program_;
    static_samples const& samples_;
    std::size_t outliers_;
    static_memory<I> memory_;
    mean_value_cut<W> cut_;
    mean_value_program programs_;
    I bound_;
    std::vector<I> sides_;
    std::vector<double> slope_;
    std::vector<std::vector<double>> points_;
    std::shared_ptr<std::size_t> listed_ = std::make_shared<std::size_t>(0);
    std::size_t asked_ = 0;
    bool programs_helped_ = false;
};

} // namespace sivid

#endif
