// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_PROBLEM_FROM_DATASET_IPP
#define SIVID_IO_IMPL_PROBLEM_FROM_DATASET_IPP

#include <sivid/io/problem_from_dataset.hpp>

namespace sivid {

SIVID_DECL identification_problem problem_from_dataset(
    dataset const& data, recorded_model model, std::optional<outlier_rule> const& outliers) {
    auto const fail = [](std::string const& what) {
        throw std::invalid_argument(std::string{"problem_from_dataset: "} + what);
    };
    if (data.model != model.about.name) {
        fail(std::string{"the data are of the model '"} + data.model + "', not '" +
             model.about.name + "'");
    }
    identification_problem problem{std::move(model), {}, box(data.parameters.size()), {}};
    auto const& about = problem.model.about;
    for (std::size_t j = 0; j < data.parameters.size(); ++j) {
        problem.choice.unknown.push_back(data.parameters[j].name);
        problem.prior[j] = data.parameters[j].prior.enclosure;
    }
    for (auto const& f : data.fixed) {
        if (f.constant >= about.constants.size()) fail("a fixed constant that the model lacks");
        problem.choice.fixed[about.constants[f.constant].name] = f.value;
    }
    problem.experiments = io_detail::experiments_of(data, about, scenario_role::fit, outliers);
    return problem;
}

SIVID_DECL holdout holdout_from_dataset(dataset const& data, model_description const& about) {
    return holdout(io_detail::experiments_of(data, about, scenario_role::holdout, std::nullopt));
}

} // namespace sivid

#endif
