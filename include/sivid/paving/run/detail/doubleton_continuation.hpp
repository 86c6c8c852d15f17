// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_DOUBLETON_CONTINUATION_HPP
#define SIVID_PAVING_RUN_DETAIL_DOUBLETON_CONTINUATION_HPP

#include <sivid/paving/run/detail/continued_run_class.hpp>
#include <sivid/paving/run/detail/doubleton_run.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Sets of first order that go on.
class doubleton_continuation final : public continued_run {
public:
    doubleton_continuation(flow const& f, double begin, enclosure_options const& options)
        : flow_(&f), begin_(begin), options_(options) {}

    [[nodiscard]] family begin(box const& initial, box const& parameters) override {
        family f = 0;
        while (f < all_.size() && all_[f]) ++f;
        if (f == all_.size()) all_.emplace_back();
        all_[f] = std::make_unique<doubleton_family>(*flow_, options_);
        all_[f]->begin(begin_, initial, parameters);
        return f;
    }
    void end(family f) override { all_[f].reset(); }
    [[nodiscard]] normalised_unknowns const& unknowns(family f) const override {
        return all_[f]->unknowns();
    }
    [[nodiscard]] std::shared_ptr<monomial_table const> table(family f) const override {
        return all_[f]->table();
    }
    [[nodiscard]] std::vector<std::vector<output_polynomial>>
    read(std::vector<family> const& which, double time,
         std::vector<std::size_t> const& channels) override {
        std::vector<std::vector<output_polynomial>> result;
        for (auto const f : which) {
            auto& out = result.emplace_back();
            if (!all_[f]->advance(time)) continue;
            auto const seen = all_[f]->outputs();
            for (auto const c : channels) out.push_back(all_[f]->polynomial_of(seen[c]));
        }
        return result;
    }

private:
    flow const* flow_;
    double begin_;
    enclosure_options options_;
    std::vector<std::unique_ptr<doubleton_family>> all_;
};

} // namespace paving_detail

} // namespace sivid

#endif
