// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_IDENTIFICATION_CSV_IPP
#define SIVID_IO_IMPL_IDENTIFICATION_CSV_IPP

#include <sivid/io/identification_csv.hpp>

namespace sivid {

SIVID_DECL std::string boxes_csv(identification_problem const& problem,
                                 identification const& found) {
    return io_detail::paving_csv(problem.choice.unknown, found.paving);
}

SIVID_DECL std::string products_csv(identification const& found) {
    if (!found.products) return {};
    return io_detail::paving_csv(found.products->map.side_names(), found.products->paving);
}

SIVID_DECL std::string outputs_csv(identification_problem const& problem,
                                   identification const& found, explaining_motion const* motion) {
    auto const& channels = problem.model.about.channels;
    std::set<std::pair<std::size_t, std::size_t>> forced;
    for (auto const& f : found.forced) forced.insert({f.experiment, f.measurement});
    std::string text = "scenario,t,channel,unit,measured_lower,measured_upper,model_lower,"
                       "model_upper,state\n";
    auto const no_bound = interval_traits<interval>::entire();
    auto const lower_text = [](interval const& x) {
        return std::isfinite(x.lower()) ? to_decimal_lower(x.lower()) : std::string{};
    };
    auto const upper_text = [](interval const& x) {
        return std::isfinite(x.upper()) ? to_decimal_upper(x.upper()) : std::string{};
    };
    auto const add = [&text](auto const&... cells) { ((text += ',', text += cells), ...); };
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const name = io_detail::cell(problem.experiments[e].name);
        auto const samples = sorted(problem.experiments[e].measurements);
        double told = detail::not_a_number; // what `time` says: channels share their times
        std::string time;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            auto const& m = samples[i];
            if (m.time != told) time = exact_decimal::shortest(told = m.time).text();
            auto const& output = motion != nullptr ? motion->outputs[e][i] : no_bound;
            bool const violated = found.witness && i < found.witness->violated[e].size() &&
                                  found.witness->violated[e][i];
            text += name;
            add(time, channels[m.channel].name, channels[m.channel].unit,
                to_decimal_lower(m.bound.lower()), to_decimal_upper(m.bound.upper()),
                lower_text(output), upper_text(output),
                forced.count({e, i}) > 0 ? "forced_outlier"
                : violated               ? "witness_outlier"
                                         : "");
            text += '\n';
        }
    }
    return text;
}

} // namespace sivid

#endif
