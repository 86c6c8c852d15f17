// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INVERT_HPP
#define SIVID_PAVING_INVERT_HPP

#include <sivid/number/guard.hpp>
#include <sivid/paving/frontier.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/paving/subpaving.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// The state of a running search.
struct paving_progress {
    double seconds = 0;
    std::size_t tested = 0;  ///< boxes tested
    std::size_t pending = 0; ///< boxes that wait
    double inner = 0;        ///< relative volume proved inside (approximately, for display)
    double outer = 1;        ///< relative volume not proved outside
};

struct inversion_options {
    /// A box is left undecided when no side is wider than this fraction of the prior's side.
    double accuracy = 1e-3;
    /// `accuracy` is a fraction of the hull of all that is not proved outside, instead.
    bool accuracy_of_hull = false;
    /// Stop when, since half as many boxes were tested, no side of that hull has shrunk by more
    /// than this fraction (0: never).
    double hull_gain = 0;
    /// Stop when the inner volume reaches this fraction of the outer one (1: never).
    double sufficient_ratio = 0.5;
    double seconds = 60;
    std::size_t boxes = 10'000'000;
    search_order order = search_order::largest_first;
    /// Whether proved outside boxes are kept in the result (for pictures).
    bool keep_outside = true;
    /// Called after each test; false stops the search with what is proved until then.
    std::function<bool(paving_progress const&)> progress;
};

struct inversion {
    subpaving paving;
    stop_reason reason = stop_reason::decided;
    std::size_t tested = 0;
    double seconds = 0;
};

namespace paving_detail {

template <class Test>
struct knowledge_of {
    using type = std::monostate;
};
template <learning_set_test Test>
struct knowledge_of<Test> {
    using type = typename Test::knowledge;
};

} // namespace paving_detail

/// Set inversion via interval analysis (SIVIA) over any set test: paves `prior` with boxes that are
/// proved inside, proved outside, undecided, or still pending when the budget ends.
/// @guarantee  the boxes cover the prior; every verdict is the test's proof
/// @ref  Jaulin and Walter, Automatica 29 (1993): SIVIA; Chabert and Jaulin 2009 (contractors)
template <set_test Test>
[[nodiscard]] inversion invert(Test& test, box const& prior,
                               inversion_options const& options = {}) {
    require_sound_environment();
    if (prior.size() == 0 || is_empty(prior)) throw std::invalid_argument("invert: empty prior");
    for (auto const& side : prior) {
        if (!std::isfinite(width(side))) throw std::invalid_argument("invert: unbounded prior");
    }
    auto const begin = std::chrono::steady_clock::now();
    auto const elapsed = [&begin] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    inversion result{subpaving(prior)};
    auto& paving = result.paving;
    using knowledge = typename paving_detail::knowledge_of<Test>::type;
    paving_detail::frontier<knowledge> waiting(options.order);
    auto const assess = [&test](box const& x, std::shared_ptr<knowledge const> const& known) {
        if constexpr (learning_set_test<Test>) {
            return test(x, known);
        } else {
            return test(x);
        }
    };
    auto const volume = [&prior](box const& x) { return relative_volume(x, prior).upper(); };
    auto const decide = [&](box x, box_verdict v) {
        if (v != box_verdict::outside || options.keep_outside) paving.add(std::move(x), v);
    };
    using item = typename paving_detail::frontier<knowledge>::item;
    auto whole = prior; // what the accuracy is a fraction of
    std::size_t measured_at = 0;
    auto const split_side = [&](box const& x, std::vector<double> const& smear) {
        auto side = paving_detail::side_to_split(x, whole, smear, options.accuracy);
        if (side || !options.accuracy_of_hull || 4 * result.tested < 5 * measured_at) return side;
        whole = waiting.hull(hull(paving.outer_hull(), x));
        measured_at = result.tested;
        return paving_detail::side_to_split(x, whole, smear, options.accuracy);
    };
    auto last_hull = prior;
    std::size_t next_look = 8;
    auto const hull_rests = [&] {
        if (!(options.hull_gain > 0) || result.tested < next_look) return false;
        next_look = 2 * result.tested;
        auto const now = waiting.hull(paving.outer_hull());
        bool rests = true;
        for (std::size_t i = 0; i < now.size(); ++i) {
            rests = rests && width(now[i]) >= (1 - options.hull_gain) * width(last_hull[i]);
        }
        last_hull = now;
        return rests;
    };
    // What a test found about a box goes into the paving, and its parts wait.
    auto const settle = [&](item of, auto found) {
        auto& x = of.set;
        if (found.verdict == box_verdict::outside || is_empty(found.rest)) {
            decide(std::move(x), box_verdict::outside);
            return;
        }
        for (auto& cut : difference(x, found.rest)) decide(std::move(cut), box_verdict::outside);
        if (found.verdict == box_verdict::inside) {
            decide(std::move(found.rest), box_verdict::inside);
            return;
        }
        // A box that shrank much is worth another look before it is split.
        double const after = volume(found.rest);
        if (after < 0.5 * of.volume && after > 0) {
            waiting.push(std::move(found.rest), after, std::move(found.knowledge));
            return;
        }
        auto const side = split_side(found.rest, found.smear);
        if (!side) {
            result.reason = stop_reason::accuracy_reached;
            decide(std::move(found.rest), box_verdict::undecided);
            return;
        }
        auto [low, high] = bisect(found.rest, *side, mid(found.rest[*side]));
        double const low_volume = volume(low);
        double const high_volume = volume(high);
        waiting.push(std::move(low), low_volume, found.knowledge);
        waiting.push(std::move(high), high_volume, std::move(found.knowledge));
    };
    // Replaces every box by its halves; false when one cannot be split.
    [[maybe_unused]] auto const halve = [&](std::vector<item>& items) {
        std::vector<item> halves;
        for (auto const& i : items) {
            auto const side = split_side(i.set, {});
            if (!side) return false;
            auto [low, high] = bisect(i.set, *side, mid(i.set[*side]));
            for (auto* half : {&low, &high}) {
                double const size = volume(*half);
                halves.push_back({std::move(*half), i.known, size, i.rank, i.age});
            }
        }
        items = std::move(halves);
        return true;
    };
    waiting.push(prior, 1, nullptr);
    while (!waiting.empty()) {
        double const inner = paving.inner_volume().upper();
        double const outer = paving.outer_volume().upper() + waiting.volume();
        std::optional<stop_reason> stop;
        if (options.progress &&
            !options.progress({elapsed(), result.tested, waiting.size(), inner, outer})) {
            stop = stop_reason::cancelled;
        } else if (elapsed() > options.seconds) {
            stop = stop_reason::time_budget;
        } else if (result.tested >= options.boxes) {
            stop = stop_reason::box_budget;
        } else if (hull_rests()) {
            stop = stop_reason::accuracy_reached;
        } else if (inner > 0 && inner >= options.sufficient_ratio * outer &&
                   options.sufficient_ratio < 1) {
            stop = stop_reason::accuracy_reached;
        }
        if (stop) {
            result.reason = *stop;
            while (!waiting.empty()) paving.add(waiting.pop().set, box_verdict::pending);
            break;
        }
        auto next = waiting.pop();
        if constexpr (batch_set_test<Test>) {
            auto found = test.judge(next.set, next.known);
            if (!found.blind) {
                ++result.tested;
                settle(std::move(next), std::move(found));
                continue;
            }
            // Boxes that are blind too are learnt about together.
            std::vector<item> blind, others;
            blind.push_back(std::move(next));
            auto const wanted = test.at_once();
            for (std::size_t looked = 0;
                 looked < 2 * wanted && blind.size() < wanted && !waiting.empty(); ++looked) {
                auto other = waiting.pop();
                bool const also = test.judge(other.set, other.known).blind;
                (also ? blind : others).push_back(std::move(other));
            }
            for (auto& i : others) waiting.push(std::move(i.set), i.volume, std::move(i.known));
            // While there are few the search has just begun: halves are more use than wholes.
            while (options.order == search_order::largest_first && 2 * blind.size() <= wanted &&
                   halve(blind)) {
            }
            std::vector<box> sets;
            for (auto const& i : blind) sets.push_back(i.set);
            auto learnt = test.learn(sets);
            for (std::size_t k = 0; k < blind.size(); ++k) {
                ++result.tested;
                settle(std::move(blind[k]), std::move(learnt[k]));
            }
        } else {
            auto found = assess(next.set, next.known);
            ++result.tested;
            settle(std::move(next), std::move(found));
        }
    }
    result.seconds = elapsed();
    return result;
}

} // namespace sivid

#endif
