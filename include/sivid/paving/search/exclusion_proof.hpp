// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_EXCLUSION_PROOF_HPP
#define SIVID_PAVING_SEARCH_EXCLUSION_PROOF_HPP

#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// How a measurement takes part in a proof: with |value|, against its middle in the sign's
/// direction.
struct measurement_weight {
    std::size_t experiment = 0;
    std::size_t output = 0; ///< in the order of time
    double value = 0;
};

/// One step of the way in which a search excluded what it excluded, told of a current box, the
/// prior at first. Nothing in it is to be trusted: each step names something that can be proved.
struct proof_step {
    enum class kind {
        run,   ///< an experiment is to be enclosed over the box
        cut,   ///< what lies beyond a place holds nothing: the box ends there from now on
        empty, ///< the box holds nothing; it is done
        split, ///< its lower part is next, with all that becomes of it, then its upper part
        leaf   ///< nothing more is known of the box; it is done
    };
    /// Weighted measurements, at least one of which nobody meets in what is cut off. Groups may
    /// share no measurement of experiments that allow outliers, and there is a group more than
    /// outliers. Empty where the search did not say.
    using groups = std::vector<std::vector<measurement_weight>>;

    kind what = kind::leaf;
    std::size_t index = 0; ///< of the experiment; of the side
    bool upper = false;    ///< whether the upper end of the side is cut off, else the lower one
    double at = 0;
    groups why = {};

    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = sizeof(proof_step);
        for (auto const& g : why) sum += sizeof g + g.size() * sizeof(measurement_weight);
        return sum;
    }
};

/// Steps that lead from the prior to all that is not excluded: the tree of a search, in the order
/// in which it is walked.
using exclusion_proof = std::vector<proof_step>;

/// The part beyond a cut, or nothing. @given  the side exists
[[nodiscard]] inline box beyond(box const& x, proof_step const& cut) {
    using traits = interval_traits<interval>;
    auto part = x;
    auto const& side = x[cut.index];
    bool const any = cut.upper ? cut.at < side.upper() : side.lower() < cut.at;
    part[cut.index] = !any        ? traits::empty()
                      : cut.upper ? traits::bounds(std::max(cut.at, side.lower()), side.upper())
                                  : traits::bounds(side.lower(), std::min(cut.at, side.upper()));
    return part;
}
/// The part before a cut, or nothing. @given  the side exists
[[nodiscard]] inline box before(box const& x, proof_step const& cut) {
    using traits = interval_traits<interval>;
    auto part = x;
    auto const& side = x[cut.index];
    bool const any = cut.upper ? side.lower() <= cut.at : cut.at <= side.upper();
    part[cut.index] = !any        ? traits::empty()
                      : cut.upper ? traits::bounds(side.lower(), std::min(cut.at, side.upper()))
                                  : traits::bounds(std::max(cut.at, side.lower()), side.upper());
    return part;
}

/// Adds cuts that lead from a box to a part of it, without weights.
inline void add_cuts(exclusion_proof& proof, box const& from, box const& to) {
    for (std::size_t j = 0; j < from.size(); ++j) {
        if (from[j].lower() < to[j].lower()) {
            proof.push_back({proof_step::kind::cut, j, false, to[j].lower()});
        }
        if (to[j].upper() < from[j].upper()) {
            proof.push_back({proof_step::kind::cut, j, true, to[j].upper()});
        }
    }
}

/// Remembers what became of the boxes of a search, and tells it as a proof.
class proof_log {
public:
    /// @param most  bytes; boxes that come when so many are held are left as they are
    explicit proof_log(std::size_t most) : most_(most) {}

    /// @param steps  what is known of the box
    /// @param rest   what it leaves of the box; nothing: none of it. What is told of `rest` comes
    ///   next
    /// @param side   along which the rest is halved
    void add(box const& of, exclusion_proof steps, std::optional<box> const& rest,
             std::optional<std::size_t> side = std::nullopt) {
        auto left = of;
        for (auto const& s : steps) {
            if (s.what == proof_step::kind::cut) left = before(left, s);
        }
        bool const over = !steps.empty() && steps.back().what == proof_step::kind::empty;
        if (rest) add_cuts(steps, left, *rest);
        if (!rest && !over) steps.push_back({proof_step::kind::empty});
        if (rest && side) {
            steps.push_back({proof_step::kind::split, *side, false, mid((*rest)[*side])});
        }
        keep(of, std::move(steps));
    }

    [[nodiscard]] exclusion_proof proof_from(box const& prior) const {
        exclusion_proof proof;
        std::vector<box> waiting{prior};
        while (!waiting.empty()) {
            auto cell = std::move(waiting.back());
            waiting.pop_back();
            for (bool over = false; !over;) {
                auto const of = ends_of(cell);
                auto const found = steps_.find(of);
                for (std::size_t k = 0; found != steps_.end() && k < found->second.size(); ++k) {
                    auto const& s = found->second[k];
                    proof.push_back(s);
                    if (s.what == proof_step::kind::cut) cell = before(cell, s);
                    over = s.what == proof_step::kind::empty || s.what == proof_step::kind::split;
                    if (s.what == proof_step::kind::split) {
                        auto [low, high] = bisect(cell, s.index, s.at);
                        waiting.push_back(std::move(high));
                        waiting.push_back(std::move(low));
                    }
                }
                if (over || ends_of(cell) != of)
                    continue; // what is left of it may be known under its own name
                proof.push_back({});
                over = true;
            }
        }
        return proof;
    }
    /// Remembers a proof that was told before, as far as it makes sense.
    void take_up(exclusion_proof const& proof, box const& prior) {
        std::vector<box> waiting{prior};
        exclusion_proof steps;
        for (auto const& s : proof) {
            if (waiting.empty() || (s.what != proof_step::kind::run && s.index >= prior.size())) {
                return;
            }
            auto cell = waiting.back();
            if (s.what != proof_step::kind::leaf) steps.push_back(s);
            if (s.what == proof_step::kind::run || s.what == proof_step::kind::cut) continue;
            waiting.pop_back();
            auto const of = cell;
            for (auto const& t : steps) {
                if (t.what == proof_step::kind::cut) cell = before(cell, t);
            }
            if (is_empty(cell)) return;
            if (s.what == proof_step::kind::split) {
                if (!contains(cell[s.index], s.at)) return;
                auto [low, high] = bisect(cell, s.index, s.at);
                waiting.push_back(std::move(high));
                waiting.push_back(std::move(low));
            }
            keep(of, std::exchange(steps, {}));
        }
    }

private:
    void keep(box const& of, exclusion_proof steps) {
        std::size_t bytes = 2 * of.size() * sizeof(double);
        for (auto const& s : steps) bytes += s.bytes();
        if (steps.empty() || bytes_ + bytes > most_) return;
        bytes_ += bytes;
        steps_[ends_of(of)] = std::move(steps);
    }
    std::size_t most_, bytes_ = 0;
    std::map<std::vector<double>, exclusion_proof> steps_;
};

} // namespace sivid

#endif
