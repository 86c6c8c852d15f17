// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/program.hpp"

#include <sivid/io/dataset_writer.hpp>
#include <sivid/io/json_writer.hpp>

#include <iostream>

namespace hovercraft_example {

namespace {

/// What was hidden in the data, for the one who wants to check an answer.
std::string truth_json(generated const& made, generate_command const& c) {
    using layout = sivid::json_writer::layout;
    sivid::json_writer json;
    json.begin_object();
    json.key("format").string("hovercraft-truth-1");
    json.key("seed").integer(c.options.seed);
    json.key("parameters").begin_object(layout::one_line);
    for (auto const& [name, value] : made.truth) json.key(name).decimal(value);
    json.end_object();
    json.key("outliers").begin_array();
    for (auto const& o : made.outliers) {
        json.begin_object(layout::one_line).key("scenario").string(o.scenario);
        json.key("t").nearest(o.time).key("channel").string(o.channel).end_object();
    }
    json.end_array().end_object();
    return json.text();
}

} // namespace

int run(generate_command const& c) {
    auto const model = sivid::record_model(c.craft);
    auto const names = sivid::names_of(model.about);
    auto const made = generate(model, find_scenarios(c.scenario, names), c.options);
    console::prepare_folder(c.out);
    sivid::write_atomically(c.out / "truth.json", truth_json(made, c));
    sivid::write_dataset(made.data, names, c.out);
    for (auto const& s : made.data.scenarios)
        std::cout << s.name << ": " << s.measurements.size() << " measurements over " << s.duration
                  << " s\n";
    if (made.left_out > 0)
        std::cout << made.left_out
                  << " samples near zero were left out: a relative bound says nothing there; use "
                     "--absolute or --combined\n";
    if (!made.outliers.empty())
        std::cout << made.outliers.size() << " outliers planted, fraction allowed "
                  << made.data.max_outlier_fraction.text() << "\n";
    std::cout << "written: " << (c.out / "dataset.json").string()
              << " (the planted truth is in truth.json)\n";
    return 0;
}

} // namespace hovercraft_example
