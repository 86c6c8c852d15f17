// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_DETAIL_BOX_TEST_HPP
#define SIVID_PAVING_SEARCH_DETAIL_BOX_TEST_HPP

#include <sivid/number/text/needed_given.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box_lanes.hpp>

#include <concepts>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// What a test in the interval type I proved about a box; with packs, about the box in each lane.
template <interval_scalar I>
struct finding {
    lane_mask<I> inside{};  ///< every point of `rest`, as its bounds read, is in the set
    lane_mask<I> outside{}; ///< no point of the box does
    basic_box<I> rest;      ///< no point of the box outside `rest` does (a contraction)
};

/// A test of boxes of the interval type I against a set; sound, completeness not required.
template <class T, class I>
concept box_test = interval_scalar<I> && requires(T& test, basic_box<I> const& x) {
    { test(x) } -> std::same_as<finding<I>>;
};

/// The points that f maps into a box of doubles, as a `box_test`.
/// @tparam F  f(x, cut) encloses the images of the points of x, as a `basic_box<I>`, and sets `cut`
///   (lane by lane) where f is not defined on all of x; as the functions of `interval_traits` do
template <interval_scalar I, class F>
class image_test {
public:
    image_test(F f, box target) : f_(std::move(f)), target_(std::move(target)) {}

    /// @throws std::invalid_argument  when f has not as many values as the target has sides
    [[nodiscard]] finding<I> operator()(basic_box<I> const& x) const {
        lane_mask<I> cut{};
        basic_box<I> const y = f_(x, cut);
        if (y.size() != target_.size())
            throw std::invalid_argument("image_test: f has another size than its target" +
                                        needed_given(target_.size(), y.size()));
        finding<I> says{.rest = x};
        auto holds = every_lane<I>();
        lane_mask<I> fails{};
        for (std::size_t i = 0; i < y.size(); ++i) {
            holds &= lies_in(y[i], target_[i]);
            fails |= sivid::misses(y[i], target_[i]);
            // Nothing is mapped where f is nowhere defined; empty without a cut says nothing.
            fails |= static_cast<lane_mask<I>>(cut & interval_traits<I>::is_empty(y[i]));
        }
        says.inside = static_cast<lane_mask<I>>(holds & (every_lane<I>() ^ cut));
        says.outside = fails;
        return says;
    }

private:
    F f_;
    box target_;
};

namespace paving_detail {

/// A `box_test` as the search takes it: boxes with double bounds, which tile the prior without gaps
/// or overlaps, one for each lane at a time.
template <class I, class Test>
class box_test_in_lanes {
public:
    struct knowledge {}; // none
    explicit box_test_in_lanes(Test& test) : test_(&test) {}

    [[nodiscard]] assessment<knowledge> operator()(box const& x,
                                                   std::shared_ptr<knowledge const> const&) {
        return std::move(learn({x})[0]);
    }
    [[nodiscard]] assessment<knowledge> judge(box const& x,
                                              std::shared_ptr<knowledge const> const&) const {
        assessment<knowledge> says{.rest = x};
        says.blind = true;
        return says;
    }
    [[nodiscard]] std::vector<assessment<knowledge>> learn(std::vector<box> const& boxes) {
        auto const found = (*test_)(side_by_side<I>(boxes));
        std::vector<assessment<knowledge>> result;
        for (auto const& x : boxes) {
            auto const k = result.size();
            auto& says = result.emplace_back();
            if (found.rest.size() != x.size())
                throw std::invalid_argument(
                    "invert: the test's rest has another size than its box");
            says.rest = sivid::intersect(x, lane_of(found.rest, k));
            says.cost = 1;
            if (lane_of(found.outside, k)) {
                says.verdict = box_verdict::outside;
            } else if (lane_of(found.inside, k) &&
                       // Read outward, the rest may be more than what was proved.
                       lane_of(subset(box_in<I>(says.rest), found.rest), k)) {
                says.verdict = box_verdict::inside;
            }
        }
        return result;
    }
    [[nodiscard]] std::size_t at_once() const { return interval_traits<I>::lanes; }
    [[nodiscard]] bool cancelled() const requires requires(Test const& t) {
        { t.cancelled() } -> std::convertible_to<bool>;
    }
    { return test_->cancelled(); }

private:
    Test* test_;
};

} // namespace paving_detail

} // namespace sivid

#endif
