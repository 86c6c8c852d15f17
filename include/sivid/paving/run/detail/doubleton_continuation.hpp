// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_DOUBLETON_CONTINUATION_HPP
#define SIVID_PAVING_RUN_DETAIL_DOUBLETON_CONTINUATION_HPP

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/trajectory.hpp>
#include <sivid/paving/response/detail/affine_output.hpp>
#include <sivid/paving/run/detail/continued_run_class.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Sets of first order.
class doubleton_continuation final : public continued_run {
public:
    doubleton_continuation(flow const& f, double begin, enclosure_options const& options)
        : flow_(&f), begin_(begin), options_(options) {}

    [[nodiscard]] family begin(box const& initial, box const& parameters) override {
        family f = 0;
        while (f < all_.size() && all_[f]) ++f;
        if (f == all_.size()) all_.emplace_back();
        all_[f] = std::make_unique<one>(*flow_, options_, initial, parameters);
        all_[f]->run.begin(begin_, initial, parameters);
        all_[f]->look.set_ensemble(all_[f]->run.ensemble());
        return f;
    }
    void end(family f) override { all_[f].reset(); }
    [[nodiscard]] normalised_unknowns const& unknowns(family f) const override {
        return all_[f]->unknowns;
    }
    [[nodiscard]] std::shared_ptr<monomial_table const> table(family f) const override {
        return all_[f]->table;
    }
    [[nodiscard]] std::vector<std::vector<output_polynomial>>
    read(std::vector<family> const& which, double time,
         std::vector<std::size_t> const& channels) override {
        std::vector<std::vector<output_polynomial>> result;
        for (auto const f : which) {
            auto& own = *all_[f];
            auto& out = result.emplace_back();
            while (own.run.time() < time && own.run.step(time)) {
            }
            if (own.run.time() < time) continue;
            auto const seen = own.look(own.run.set());
            for (auto const c : channels) {
                out.push_back(affine_output(seen[c], own.unknowns, own.run.ensemble().deviation));
            }
        }
        return result;
    }

private:
    struct one {
        one(flow const& f, enclosure_options const& options, box const& initial, box const& p)
            : run(f, options),
              look(f),
              unknowns(initial, p),
              table(linear_table(unknowns.variables)) {}
        trajectory<interval> run;
        observer<interval> look;
        normalised_unknowns unknowns;
        std::shared_ptr<monomial_table const> table;
    };

    flow const* flow_;
    double begin_;
    enclosure_options options_;
    std::vector<std::unique_ptr<one>> all_;
};

} // namespace paving_detail

} // namespace sivid

#endif
