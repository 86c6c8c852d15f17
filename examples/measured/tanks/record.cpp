// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "model.hpp"

#include <sivid/io/text/csv_table.hpp>

namespace tanks {

sivid::experiment read_experiment(std::filesystem::path const& file, diagnose_command const& c) {
    auto const table = sivid::csv_table::read(file);
    auto const t = table.required_column("t_s");
    auto const u = table.required_column("pump_voltage_V");
    auto const y = table.required_column("level_lower_tank_V");
    sivid::experiment e;
    e.name = file.stem().string();
    std::vector<double> times, voltages;
    for (auto const& row : table.rows()) {
        auto const time = *nearest(table.number(row, t));
        if (!times.empty() && !(times.back() < time))
            table.fail(row.line, t, "the time does not increase",
                       "correct it, or leave the row out");
        auto const level = table.number(row, y);
        auto const within = [&](sivid::exact_decimal const& bound) {
            return *sivid::enclose(level - bound, level + bound);
        };
        if (times.empty()) {
            e.begin = time;
            e.initial =
                sivid::box{sivid::interval(0, *nearest(c.upper_start)), within(c.lower_start)};
        } else {
            e.measurements.push_back({time, 0, within(c.bound)});
        }
        times.push_back(time);
        voltages.push_back(*nearest(table.number(row, u)));
    }
    if (e.measurements.empty())
        table.fail(table.heading_line(), "fewer than two rows", "give a longer record");
    e.inputs = {
        sivid::sampled_signal(std::move(times), std::move(voltages), sivid::interpolation::hold)};
    return e;
}

sivid::identification_problem tank_problem(sivid::experiment record) {
    sivid::identification_problem problem;
    problem.model = sivid::record_model(cascaded_tanks{});
    problem.choice.unknown = {"k1", "k3", "k4"};
    problem.prior = sivid::box{sivid::interval(0.02, 0.1), sivid::interval(0.02, 0.1),
                               sivid::interval(0.02, 0.1)};
    problem.experiments = {std::move(record)};
    return problem;
}

} // namespace tanks
