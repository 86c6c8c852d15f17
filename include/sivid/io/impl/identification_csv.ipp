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

namespace io_detail {

SIVID_DECL std::vector<std::vector<std::string>>
measurement_cells(identification_problem const& problem) {
    auto const& channels = problem.model.about.channels;
    std::vector<std::vector<std::string>> all;
    for (auto const& e : problem.experiments) {
        auto& rows = all.emplace_back();
        auto const name = cell(e.name);
        double told = detail::not_a_number; // what `time` says: channels share their times
        std::string time;
        for (auto const& m : sorted(e.measurements)) {
            if (m.time != told) time = exact_decimal::shortest(told = m.time).text();
            auto const& channel = channels[m.channel];
            rows.push_back(text_of(name, ",", time, ",", channel.name, ",", channel.unit, ",",
                                   to_decimal_lower(m.bound.lower()), ",",
                                   to_decimal_upper(m.bound.upper())));
        }
    }
    return all;
}

} // namespace io_detail

SIVID_DECL std::string outputs_csv(identification_problem const& problem,
                                   identification const& found, explaining_motion const* motion) {
    std::set<std::pair<std::size_t, std::size_t>> forced;
    for (auto const& f : found.forced) forced.insert({f.experiment, f.measurement});
    auto text = std::string{io_detail::output_headings} + "\n";
    auto const no_bound = interval_traits<interval>::entire();
    auto const lower_text = [](interval const& x) {
        return std::isfinite(x.lower()) ? to_decimal_lower(x.lower()) : std::string{};
    };
    auto const upper_text = [](interval const& x) {
        return std::isfinite(x.upper()) ? to_decimal_upper(x.upper()) : std::string{};
    };
    auto const measured = io_detail::measurement_cells(problem);
    for (std::size_t e = 0; e < measured.size(); ++e) {
        for (std::size_t i = 0; i < measured[e].size(); ++i) {
            auto const& output = motion != nullptr ? motion->outputs[e][i] : no_bound;
            bool const violated = found.witness && i < found.witness->violated[e].size() &&
                                  found.witness->violated[e][i];
            auto const* const state = forced.count({e, i}) > 0 ? "forced_outlier"
                                      : violated               ? "witness_outlier"
                                                               : "";
            text += text_of(measured[e][i], ",", lower_text(output), ",", upper_text(output), ",",
                            state, "\n");
        }
    }
    return text;
}

} // namespace sivid

#endif
