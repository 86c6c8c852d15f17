// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_RESPONSE_SEARCH_HPP
#define SIVID_PAVING_JUDGE_DETAIL_RESPONSE_SEARCH_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sivid {

/// What a `response_search` asks: which of two boxes is looked at first, which are of no interest
/// any more, and what the responses tell of one. `judge` may raise bounds, contract the box, say
/// which experiments are stale and which sides smear; the responses are of a box around it, and all
/// are known.
template <class P>
concept response_policy = std::derived_from<typename P::node, explored_box> &&
    requires(P& policy, typename P::node& x, typename P::node const& a, typename P::node const& b) {
    { policy.before(a, b) } -> std::convertible_to<bool>;
    { policy.drops(a) } -> std::convertible_to<bool>;
    policy.judge(x);
};

/// Branch and bound over boxes of parameters, best first: a heap, unless the policy says that its
/// order changes while boxes wait (`changes_order`), then each look goes over all of them.
///   A box hands its responses to its halves, which re-expand them; an experiment is integrated
///   anew for a part when the policy calls it stale. Blind boxes are integrated over together, as
///   many as a pack takes.
/// @guarantee  every parameter of the start lies in a box that waits or is stuck, or in one that
///             the policy dropped
template <response_policy Policy>
class response_search {
public:
    using node = typename Policy::node;

    /// @param known  what holds all over the start
    response_search(identification_problem const& problem, feasibility_test_options const& options,
                    Policy policy, box start, node known = {})
        : policy_(std::move(policy)), explorer_(problem, options) {
        wait(explorer_.unknown(std::move(start), std::move(known)));
    }

    [[nodiscard]] Policy& policy() { return policy_; }
    [[nodiscard]] Policy const& policy() const { return policy_; }
    /// Boxes that may be looked at; some may have become uninteresting since.
    [[nodiscard]] std::vector<node> const& waiting() const { return waiting_; }
    /// Boxes that are too small to be split.
    [[nodiscard]] std::vector<node> const& stuck() const { return stuck_; }
    [[nodiscard]] std::size_t tested() const { return tested_; }
    [[nodiscard]] std::size_t integrations() const { return explorer_.integrations(); }
    /// Bytes of boxes and of what is known of them.
    [[nodiscard]] std::size_t bytes() const {
        auto sum = explorer_.bytes();
        for (auto const* list : {&waiting_, &stuck_})
            for (auto const& x : *list) sum += x.bytes();
        return sum;
    }

    /// The box that comes first; null when none is of interest.
    [[nodiscard]] node const* next() const {
        auto const at = first();
        return at == waiting_.end() || policy_.drops(*at) ? nullptr : &*at;
    }

    /// Splits the next box, or integrates over several.
    /// @param go_on  false ends an integration between two experiments
    /// @given  next()
    void step(std::function<bool()> const& go_on) {
        auto next = take();
        if (!next.is_blind()) {
            auto parts = explorer_.halves(next);
            if (parts.empty()) stuck_.push_back(std::move(next));
            for (auto& half : parts) look(std::move(half));
            return;
        }
        auto const wanted = explorer_.at_once();
        std::vector<node> blind, others;
        blind.push_back(std::move(next));
        for (std::size_t looked = 0;
             looked < 2 * wanted && blind.size() < wanted && this->next() != nullptr; ++looked) {
            auto other = take();
            (other.is_blind() ? blind : others).push_back(std::move(other));
        }
        for (auto& other : others) wait(std::move(other));
        explorer_.learn(blind, go_on);
        for (auto& b : blind) b.fresh ? look(std::move(b)) : wait(std::move(b));
    }

private:
    static constexpr bool heaped = !requires { requires Policy::changes_order; };

    [[nodiscard]] auto after() const {
        return [this](node const& a, node const& b) { return policy_.before(b, a); };
    }
    [[nodiscard]] typename std::vector<node>::const_iterator first() const {
        if constexpr (heaped) return waiting_.begin();
        return std::max_element(waiting_.begin(), waiting_.end(), after());
    }
    void wait(node x) {
        waiting_.push_back(std::move(x));
        if constexpr (heaped) std::push_heap(waiting_.begin(), waiting_.end(), after());
    }
    [[nodiscard]] node take() {
        if constexpr (heaped) {
            std::pop_heap(waiting_.begin(), waiting_.end(), after());
        } else {
            auto const at = waiting_.begin() + (first() - waiting_.cbegin());
            std::iter_swap(at, waiting_.end() - 1);
        }
        auto x = std::move(waiting_.back());
        waiting_.pop_back();
        return x;
    }
    void look(node x) {
        ++tested_;
        if (std::find(x.known.begin(), x.known.end(), nullptr) == x.known.end()) policy_.judge(x);
        if (!policy_.drops(x)) wait(std::move(x));
    }

    Policy policy_;
    box_explorer explorer_;
    std::vector<node> waiting_, stuck_;
    std::size_t tested_ = 0;
};

} // namespace sivid

#endif
