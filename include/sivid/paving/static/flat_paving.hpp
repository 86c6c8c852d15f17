// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_FLAT_PAVING_HPP
#define SIVID_PAVING_STATIC_FLAT_PAVING_HPP

#include <sivid/model/prior_end.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/paving/verdict.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Room for so many boxes of one dimension, side by side: all lower bounds of a side, then all
/// upper ones. Small enough to stay in the cache and in the allocator.
class box_chunk {
public:
    static constexpr std::size_t capacity = 256;

    explicit box_chunk(std::size_t sides) : bounds_(2 * sides * capacity) {}

    [[nodiscard]] double const* lower(std::size_t side) const { return at(2 * side); }
    [[nodiscard]] double const* upper(std::size_t side) const { return at(2 * side + 1); }
    double* lower(std::size_t side) { return bounds_.data() + 2 * side * capacity; }
    double* upper(std::size_t side) { return bounds_.data() + (2 * side + 1) * capacity; }
    /// Takes box i of another chunk of the same dimension as box `to`.
    void copy(box_chunk const& from, std::size_t i, std::size_t to) {
        for (std::size_t row = 0; row < bounds_.size(); row += capacity) {
            bounds_[row + to] = from.bounds_[row + i];
        }
    }

private:
    [[nodiscard]] double const* at(std::size_t row) const {
        return bounds_.data() + row * capacity;
    }
    std::vector<double> bounds_;
};

/// Many boxes of one dimension, without an allocation for each.
class flat_boxes {
public:
    explicit flat_boxes(std::size_t sides) : sides_(sides) {}

    [[nodiscard]] std::size_t sides() const { return sides_; }
    [[nodiscard]] std::size_t size() const { return count_; }
    /// Memory that they take.
    [[nodiscard]] std::size_t bytes() const {
        return chunks_.size() *
               (sizeof(box_chunk) + 2 * sides_ * box_chunk::capacity * sizeof(double));
    }
    [[nodiscard]] double lower(std::size_t i, std::size_t side) const {
        return chunks_[i / box_chunk::capacity].lower(side)[i % box_chunk::capacity];
    }
    [[nodiscard]] double upper(std::size_t i, std::size_t side) const {
        return chunks_[i / box_chunk::capacity].upper(side)[i % box_chunk::capacity];
    }
    void add(box const& x) {
        box_chunk own(sides_);
        for (std::size_t j = 0; j < sides_; ++j) {
            own.lower(j)[0] = x[j].lower();
            own.upper(j)[0] = x[j].upper();
        }
        add(own, 0);
    }
    /// Appends box i of a chunk.
    void add(box_chunk const& from, std::size_t i) {
        auto const place = count_ % box_chunk::capacity;
        if (place == 0) chunks_.emplace_back(sides_);
        chunks_.back().copy(from, i, place);
        ++count_;
    }
    [[nodiscard]] box at(std::size_t i) const {
        box x(sides_);
        for (std::size_t j = 0; j < sides_; ++j) x[j] = interval(lower(i, j), upper(i, j));
        return x;
    }
    /// What contains them all; empty sides when there are none.
    [[nodiscard]] box hull() const {
        box x = empty_box(sides_);
        for (std::size_t j = 0; j < sides_ && count_ > 0; ++j) {
            double lo = lower(0, j), hi = upper(0, j);
            for (std::size_t i = 1; i < count_; ++i) {
                lo = std::min(lo, lower(i, j));
                hi = std::max(hi, upper(i, j));
            }
            x[j] = interval(lo, hi);
        }
        return x;
    }
    /// Their volumes relative to a whole, summed.
    /// @guarantee  encloses the exact sum
    [[nodiscard]] interval relative_volume(box const& whole) const {
        using traits = interval_traits<interval>;
        auto const length = [](double lo, double hi) {
            return traits::sub(traits::point(hi), traits::point(lo));
        };
        interval sum{0.0};
        for (std::size_t i = 0; i < count_; ++i) {
            interval product{1.0};
            for (std::size_t j = 0; j < sides_; ++j) {
                if (traits::is_point(whole[j])) continue;
                product = traits::mul(product, length(lower(i, j), upper(i, j)));
            }
            sum = traits::add(sum, product);
        }
        bool undefined = false;
        for (auto const& side : whole) {
            if (traits::is_point(side)) continue;
            sum = traits::div(sum, length(side.lower(), side.upper()), undefined);
        }
        return sum;
    }

private:
    std::size_t sides_;
    std::size_t count_ = 0;
    std::vector<box_chunk> chunks_;
};

/// An end of the prior that the feasible set reaches, or may: what lies beyond was not looked at.
struct reached_end {
    std::size_t side = 0;
    prior_end end = prior_end::none;
    bool proved = false; ///< a feasible point sits there; else only what is open does
};

/// A measurement of which the formula may have no value somewhere in what is open: no such box can
/// be proved feasible, however small it is.
struct undefined_output {
    std::size_t measurement = 0; ///< of the problem's record
    box where;                   ///< one of the open boxes
};

/// What a set inversion found, as flat lists. What neither `inside` nor `open` covers of the prior
/// is proved outside.
struct flat_paving {
    explicit flat_paving(box whole)
        : prior(std::move(whole)), inside(prior.size()), open(prior.size()) {}

    box prior;
    flat_boxes inside; ///< proved feasible throughout
    flat_boxes open;   ///< undecided, or still waiting when the work ended
    stop_reason reason = stop_reason::decided;
    /// Measurements of the problem's record that every feasible parameter violates, where some
    /// parameter may be feasible and outliers are allowed.
    std::vector<std::size_t> forced{};
    std::vector<undefined_output> undefined{}; ///< of each channel that has one, the first
    std::size_t tested = 0;                    ///< boxes tested
    std::size_t asked = 0;                     ///< measurements looked at, summed over them
    double seconds = 0;

    /// What contains all feasible parameters of the prior; empty when there are none.
    [[nodiscard]] box hull() const {
        if (inside.size() == 0) return open.hull();
        return open.size() == 0 ? inside.hull() : sivid::hull(inside.hull(), open.hull());
    }
    /// The ends of the prior that it reaches, side by side.
    [[nodiscard]] std::vector<reached_end> ends() const {
        std::vector<reached_end> result;
        auto const all = hull(), feasible = inside.hull();
        for (std::size_t j = 0; j < prior.size(); ++j) {
            double const low = prior[j].lower(), high = prior[j].upper();
            if (!(low < high) || is_empty(all)) continue;
            bool const some = inside.size() > 0;
            if (all[j].lower() <= low)
                result.push_back({j, prior_end::lower, some && feasible[j].lower() <= low});
            if (all[j].upper() >= high)
                result.push_back({j, prior_end::upper, some && feasible[j].upper() >= high});
        }
        return result;
    }
    /// Volume that is neither proved inside nor outside, relative to the prior.
    [[nodiscard]] interval uncertain_volume() const { return open.relative_volume(prior); }
    [[nodiscard]] interval inner_volume() const { return inside.relative_volume(prior); }
    /// The same as the general type. @cost an allocation a box
    [[nodiscard]] subpaving boxes() const {
        subpaving result(prior);
        for (std::size_t i = 0; i < inside.size(); ++i) {
            result.add(inside.at(i), box_verdict::inside);
        }
        for (std::size_t i = 0; i < open.size(); ++i) {
            result.add(open.at(i), box_verdict::undecided);
        }
        return result;
    }
};

/// What a set inversion proves of the whole prior.
[[nodiscard]] inline verdict proved_verdict(flat_paving const& found) {
    if (found.inside.size() > 0) return verdict::consistent;
    return found.open.size() > 0 ? verdict::undecided : verdict::inconsistent;
}

} // namespace sivid

#endif
