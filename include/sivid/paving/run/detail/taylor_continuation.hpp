// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_TAYLOR_CONTINUATION_HPP
#define SIVID_PAVING_RUN_DETAIL_TAYLOR_CONTINUATION_HPP

#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/paving/run/detail/continued_run_class.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Taylor models in lanes; a family keeps its lane until it ends.
class taylor_continuation final : public continued_run {
public:
    /// @param unknowns, degree  of the polynomials
    taylor_continuation(flow const& f, double begin, enclosure_options const& options,
                        std::size_t unknowns, std::size_t degree)
        : flow_(&f), begin_(begin), options_(options), unknowns_(unknowns), degree_(degree) {}

    [[nodiscard]] std::size_t at_once() const override { return width; }

    [[nodiscard]] family begin(box const& initial, box const& parameters) override {
        std::size_t b = 0, l = 0;
        auto const is_free = [&] { return !banks_[b]->lanes[l]; };
        while (b < banks_.size() && !is_free()) {
            if (++l < width) continue;
            l = 0;
            ++b;
        }
        if (b == banks_.size())
            banks_.push_back(std::make_unique<bank>(*flow_, options_, unknowns_, degree_));
        auto& own = *banks_[b];
        own.carried.begin(l, begin_, initial, parameters);
        auto& lane = own.lanes[l].emplace(normalised_unknowns(initial, parameters));
        lane.table = std::make_shared<monomial_table const>(
            monomial_table::of(*own.carried.shape().space, lane.unknowns.variables, &lane.place));
        return b * width + l;
    }
    void end(family f) override {
        banks_[f / width]->carried.end(f % width);
        banks_[f / width]->lanes[f % width].reset();
    }
    [[nodiscard]] normalised_unknowns const& unknowns(family f) const override {
        return lane_of_family(f).unknowns;
    }
    [[nodiscard]] std::shared_ptr<monomial_table const> table(family f) const override {
        return lane_of_family(f).table;
    }

    [[nodiscard]] std::vector<std::vector<output_polynomial>>
    read(std::vector<family> const& which, double time,
         std::vector<std::size_t> const& channels) override {
        std::vector<std::vector<output_polynomial>> result(which.size());
        for (std::size_t b = 0; b < banks_.size(); ++b) {
            std::array<bool, width> wanted{};
            for (auto const f : which) {
                if (f / width == b) wanted[f % width] = true;
            }
            auto& run = banks_[b]->carried;
            scalar limit(0.0);
            for (std::size_t l = 0; l < width; ++l) {
                lane_traits<scalar>::put(limit, l, wanted[l] ? time : run.time(l));
            }
            bool any = false;
            for (bool moves = true; moves;) {
                moves = any = false;
                for (std::size_t l = 0; l < width; ++l) {
                    if (!wanted[l] || run.failure(l)) continue;
                    any = true;
                    moves = moves || run.time(l) < time;
                }
                if (moves) (void)run.advance(limit);
            }
            if (!any) continue;
            auto const seen = run.outputs();
            for (std::size_t k = 0; k < which.size(); ++k) {
                auto const l = which[k] % width;
                if (which[k] / width != b || run.failure(l)) continue;
                auto const& place = banks_[b]->lanes[l]->place;
                for (auto const c : channels) {
                    auto const y = lane_of(seen[c], l);
                    auto& out = result[k].emplace_back();
                    for (auto const m : place) {
                        out.coefficients.push_back(m < y.terms() ? y.c(m) : 0.0);
                    }
                    out.radius = y.r();
                }
            }
        }
        return result;
    }

private:
    using scalar = lanes<8>;
    static constexpr std::size_t width = lane_traits<scalar>::count;

    struct occupant {
        explicit occupant(normalised_unknowns u) : unknowns(std::move(u)) {}
        normalised_unknowns unknowns;
        std::shared_ptr<monomial_table const> table;
        std::vector<std::size_t> place; ///< of the used monomials among all
    };
    struct bank {
        bank(flow const& f, enclosure_options const& options, std::size_t unknowns,
             std::size_t degree)
            : carried(f, options, unknowns, degree) {}
        parametric_flow<taylor_model<scalar>> carried;
        std::array<std::optional<occupant>, width> lanes;
    };
    [[nodiscard]] occupant const& lane_of_family(family f) const {
        return *banks_[f / width]->lanes[f % width];
    }

    flow const* flow_;
    double begin_;
    enclosure_options options_;
    std::size_t unknowns_, degree_;
    std::vector<std::unique_ptr<bank>> banks_;
};

} // namespace paving_detail

} // namespace sivid

#endif
