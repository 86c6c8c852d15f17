// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_TAYLOR_RUN_HPP
#define SIVID_PAVING_RUN_DETAIL_TAYLOR_RUN_HPP

#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/paving/run/detail/experiment_run_class.hpp>
#include <sivid/paving/run_options.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// One family to carry: an experiment over a box of parameters, from a box of starts.
struct lane_task {
    experiment const* of;
    record const* samples; ///< of the experiment
    box const* initial;
    box const* parameters;
};

/// Taylor models, in lanes or one by one: a lane that is done takes the next family. Each lane is
/// at its own time; the inputs are those of the flow.
template <class C>
class taylor_lanes {
public:
    static constexpr std::size_t width = lane_traits<C>::count;

    /// @param unknowns, degree  of the polynomials
    taylor_lanes(flow const& f, run_options const& options, std::size_t unknowns,
                 std::size_t degree)
        : options_(options), flow_(f, options, unknowns, degree) {}

    std::vector<std::shared_ptr<response const>>
    operator()(std::vector<lane_task> const& families) {
        std::vector<std::shared_ptr<response const>> answers(families.size());
        std::array<std::optional<lane>, width> lanes;
        for (std::size_t l = 0; l < width; ++l) flow_.end(l);
        std::size_t next = 0;
        std::size_t in_work = 0;
        while (next < families.size() || in_work > 0) {
            C limit(families.front().of->begin);
            for (std::size_t l = 0; l < width; ++l) {
                while (!lanes[l] && next < families.size()) {
                    lanes[l] = begin(l, next, families[next]);
                    ++next;
                    ++in_work;
                    if (!lanes[l]->walk.done()) continue;
                    answers[next - 1] = std::move(*lanes[l]).finish();
                    lanes[l].reset();
                    --in_work;
                }
                if (lanes[l]) lane_traits<C>::put(limit, l, lanes[l]->walk.time());
            }
            (void)flow_.advance(limit);
            std::vector<taylor_model<C>> seen;
            for (std::size_t l = 0; l < width; ++l) {
                if (!lanes[l]) continue;
                auto& mine = *lanes[l];
                bool over = flow_.failure(l).has_value();
                while (!over && !mine.walk.done() && !(flow_.time(l) < mine.walk.time())) {
                    if (seen.empty()) seen = flow_.outputs();
                    mine.walk.take([&](std::size_t channel, interval const& bound) {
                        return mine.keep(lane_of(seen[channel], l), bound, options_.hopeless);
                    });
                }
                if (!over && !mine.walk.done()) continue;
                auto const index = mine.family;
                answers[index] = std::move(mine).finish();
                lanes[l].reset();
                flow_.end(l);
                --in_work;
            }
        }
        return answers;
    }

private:
    /// What is known of the family in one lane.
    struct lane {
        std::size_t family = 0;
        measurement_walk walk;
        std::shared_ptr<response> answer;
        std::vector<std::size_t> const* place; ///< of the used monomials among all
        response_builder collected;

        kept_output keep(taylor_model<double> const& y, interval const& bound, double hopeless) {
            collected.add(
                [&](std::size_t m) { return (*place)[m] < y.terms() ? y.c((*place)[m]) : 0.0; },
                y.r(), bound);
            auto const value = rough_range(y);
            return {interval_traits<interval>::disjoint(value, bound),
                    is_hopeless(y.r(), y.spread(), bound, hopeless)};
        }
        std::shared_ptr<response const> finish() && {
            std::move(collected).finish(*answer);
            return answer;
        }
    };

    lane begin(std::size_t l, std::size_t index, lane_task const& mine) {
        auto answer = start_response(*mine.of, *mine.samples, *mine.initial, *mine.parameters);
        flow_.begin(l, mine.of->begin, *mine.initial, *mine.parameters);
        auto& [table, place] = tables_[answer->unknowns.variables];
        if (!table) {
            table = std::make_shared<monomial_table const>(
                monomial_table::of(*flow_.shape().space, answer->unknowns.variables, &place));
        }
        answer->table = table;
        auto const allowed = answer->allowed;
        return {index, measurement_walk(*mine.samples, allowed), std::move(answer), &place,
                response_builder(place.size())};
    }

    run_options options_;
    parametric_flow<taylor_model<C>> flow_;
    /// For each number of unknowns, and where their monomials are among those of the flow.
    std::map<std::size_t,
             std::pair<std::shared_ptr<monomial_table const>, std::vector<std::size_t>>>
        tables_;
};

/// One experiment over boxes of parameters.
template <class C>
class taylor_run final : public experiment_run {
public:
    using maker = std::function<std::unique_ptr<experiment_run>()>;

    /// @param unknowns, degree  of the polynomials
    /// @param single  runs a box alone: lanes that stand idle cost as much as those that run;
    ///                nothing: lanes do
    taylor_run(flow const& f, experiment const& e, record const& samples,
               run_options const& options, std::size_t unknowns, std::size_t degree,
               maker single = nullptr)
        : experiment_(&e),
          samples_(&samples),
          lanes_(f, options, unknowns, degree),
          make_single_(std::move(single)) {}

    using experiment_run::operator();
    [[nodiscard]] std::size_t at_once() const override { return lanes_.width; }

    std::vector<std::shared_ptr<response const>>
    operator()(box const& initial, std::vector<box> const& parameters) override {
        if (parameters.size() == 1 && make_single_) {
            if (!single_) single_ = make_single_();
            return (*single_)(initial, parameters);
        }
        std::vector<lane_task> families;
        for (auto const& p : parameters) {
            families.push_back({experiment_, samples_, &initial, &p});
        }
        return lanes_(families);
    }

private:
    experiment const* experiment_;
    record const* samples_;
    taylor_lanes<C> lanes_;
    maker make_single_;
    std::unique_ptr<experiment_run> single_; ///< made when it is first asked for
};

} // namespace paving_detail

} // namespace sivid

#endif
