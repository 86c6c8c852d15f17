// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_DETAIL_STATIC_FINDINGS_HPP
#define SIVID_PAVING_STATIC_DETAIL_STATIC_FINDINGS_HPP

#include <sivid/number/pack.hpp>
#include <sivid/paving/static/flat_paving.hpp>
#include <sivid/paving/static/static_program.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sivid {

/// What the boxes of a set inversion say of single measurements, W boxes at a time.
template <std::size_t W>
class static_findings {
    using I = pack<W>;
    using traits = interval_traits<I>;
    using mask = typename traits::mask;

public:
    /// @param problem, found  that belong together; kept by reference, findings are added
    /// @param limit  where it ends the work, fewer are
    static_findings(static_problem const& problem, flat_paving& found, work_limit const& limit)
        : problem_(problem),
          found_(found),
          limit_(limit),
          program_(problem),
          memory_(program_.memory<I>()) {}

    void operator()() {
        if (problem_.outliers > 0) find_forced();
        find_undefined();
    }

private:
    /// A lane of a box, or of a box beyond the last: of the last one.
    void start(flat_boxes const& boxes, std::size_t first) {
        program_.start(memory_, [&](std::size_t j) {
            auto const box_of = [&](std::size_t lane) {
                return std::min(first + lane, boxes.size() - 1);
            };
            double lower[W], upper[W];
            for (std::size_t n = 0; n < W; ++n) {
                lower[n] = boxes.lower(box_of(n), j);
                upper[n] = boxes.upper(box_of(n), j);
            }
            return I::load(lower, upper);
        });
    }
    /// @param undefined  receives the lanes where it may have no value
    [[nodiscard]] I const& output(std::size_t k, mask& undefined) {
        auto const& m = problem_.measurements[k];
        program_.at(memory_, m.channel, traits::point(m.time));
        return program_.value(memory_, m.channel, undefined);
    }

    /// Those that are violated all over every box. After the first boxes few are left: of no box
    /// more are violated than outliers are allowed.
    void find_forced() {
        std::vector<std::size_t> left(problem_.measurements.size());
        for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
        bool any = false;
        for (auto const* boxes : {&found_.inside, &found_.open}) {
            for (std::size_t i = 0; i < boxes->size() && !left.empty(); i += W) {
                if (!limit_()) return;
                any = true;
                start(*boxes, i);
                std::erase_if(left, [this](std::size_t k) {
                    auto const& bound = problem_.measurements[k].bound;
                    mask undefined{};
                    auto const& y = output(k, undefined);
                    auto const miss =
                        traits::disjoint(y, traits::bounds(bound.lower(), bound.upper()));
                    return miss != traits::all_lanes;
                });
            }
        }
        if (any) found_.forced = std::move(left);
    }

    void find_undefined() {
        auto const& model = problem_.model;
        for (std::size_t c = 0; c < model.observe.size(); ++c)
            if (!model.g.total(model.observe[c])) find_undefined(c);
    }
    /// The first measurement of the channel, and the first box in which it may have no value.
    void find_undefined(std::size_t c) {
        if (found_.open.size() == 0) return;
        std::vector<std::size_t> own;
        flat_boxes whole(found_.prior.size());
        whole.add(found_.open.hull());
        start(whole, 0);
        for (std::size_t k = 0; k < problem_.measurements.size(); ++k) {
            if (problem_.measurements[k].channel != c) continue;
            mask undefined{};
            (void)output(k, undefined);
            if (undefined != 0) own.push_back(k); // else in no box
        }
        for (std::size_t i = 0; i < found_.open.size() && !own.empty(); i += W) {
            if (!limit_()) return;
            start(found_.open, i);
            for (auto const k : own) {
                mask undefined{};
                (void)output(k, undefined);
                for (std::size_t n = 0; n < std::min(W, found_.open.size() - i); ++n) {
                    if (((undefined >> n) & 1U) == 0) continue;
                    found_.undefined.push_back({k, found_.open.at(i + n)});
                    return;
                }
            }
        }
    }

    static_problem const& problem_;
    flat_paving& found_;
    work_limit const& limit_;
    static_program program_;
    static_memory<I> memory_;
};

/// Adds them to what a set inversion found, in what is left of its time or a tenth more.
inline void add_static_findings(static_problem const& problem, flat_paving& found, double seconds,
                                std::function<bool()> const& keep_going) {
    work_limit const limit(std::max(0.1 * seconds, seconds - found.seconds), keep_going);
    static_findings<8>(problem, found, limit)();
}

} // namespace sivid

#endif
