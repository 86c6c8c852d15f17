// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_PRIOR_CONTRACTOR_HPP
#define SIVID_PAVING_STRATEGY_PRIOR_CONTRACTOR_HPP

#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/inquiry.hpp>

#include <functional>
#include <string>
#include <utility>

namespace sivid {

/// A contractor by a function of a problem that returns what is left of its prior.
///   strategy.steps.push_back({{std::make_shared<prior_contractor>("energy",
///   contract_by_energy)}});
class prior_contractor : public contractor {
public:
    /// Asked now and then while it works; false ends it with what is proved until then.
    using go_on = std::function<bool()>;
    using function = std::function<box(identification_problem const&, go_on const&)>;

    /// @param contract  keeps every parameter that explains the data; models with delays are not
    ///                  given to it
    prior_contractor(std::string name, function contract)
        : name_(std::move(name)), contract_(std::move(contract)) {}

    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] std::string obstacle(identification_problem const& problem) const override {
        return problem.model.has_memory() ? "the model has delays" : "";
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record&) const override {
        return {contract_(asked.problem(), limit)};
    }

private:
    std::string name_;
    function contract_;
};

} // namespace sivid

#endif
