// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_CONFIDENCE_IPP
#define SIVID_APP_IMPL_CONFIDENCE_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/paving/confidence_region.hpp>
#include <sivid/report/stored_page.hpp>

#include <string>
#include <vector>

namespace sivid::app {

namespace detail {

inline std::string probability_words(confident_region const& region) {
    return report::exact_text(100 * region.probability()) + " % (exactly 1 - " +
           std::to_string(region.above) + "/" + std::to_string(region.sums) + ")";
}

/// All that makes the region again: signs follow from the seed, weights are listed.
inline std::string confidence_json(confidence_command const& c,
                                   identification_problem const& problem,
                                   std::string const& dataset, confident_region const& region) {
    auto const& found = region.found;
    json_writer json;
    json.begin_object().members("format", "sivid-confidence-1", "dataset", dataset);
    write_source(json, c, problem).members("accuracy", c.accuracy);
    json.members("probability", region.probability(), "sums", region.sums, "above", region.above,
                 "seed", region.seed, "stopped", to_string(found.reason));
    json.named("nominal", region.names, region.nominal);
    json.named("prior", region.names, found.paving.prior());
    json.named("hull", region.names, found.paving.outer_hull());
    json.members("inner_volume", found.paving.inner_volume(), "outer_volume",
                 found.paving.outer_volume(), "assumptions", region.assumptions, "remarks",
                 region.remarks, "boxes", found.tested, "integrations", found.cost);
    json.members("seconds", found.seconds, "measured", region.measured);
    json.list("weights", region.weights.rowwise(), [&](auto const& w) { json.value(w); });
    return json.end_object().text();
}

/// The region, with all that it rests on.
inline confident_region region_of(robot const& r, confidence_command const& c, dataset const& data,
                                  identification_problem const& problem,
                                  confidence_options options) {
    options.seed = c.seed;
    options.sums = c.sums;
    apply(c.how, options.test);
    options.search.accuracy = c.accuracy.value_or(0.003);
    if (c.accuracy) options.search.sufficient_ratio = 1;
    options.search.seconds = c.budget;
    options.search.keep_going = wanted;
    auto region = confidence_region(problem, c.probability, options);
    for (auto const& words : assumptions_of(r, data, c.effects, {}, problem))
        region.assumptions.push_back(words);
    if (!region.found.paving.has_outer())
        region.remarks.push_back("nothing of the prior is in the region: the truth lies elsewhere, "
                                 "or the model is wrong, or this is one of the rare records");
    return region;
}

} // namespace detail

/// Prints ranges and volumes, and writes confidence.html, confidence.json and confidence.csv, its
/// boxes. Done where the search came to its end, undecided where a budget ended it.
SIVID_DECL int run(robot const& r, confidence_command const& c) {
    if (!r.disturbances.equations.empty())
        throw bad_request("the model allows for disturbances of equations, which the theorem does "
                          "not cover: leave its table [disturbance] out");
    auto const data = read_data(r, c.dataset);
    auto const problem = posed(r, data, c.effects, {});
    prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    confidence_options options;
    options.search.progress = [&](auto const& p) { return progress.show(paving_words(p)), true; };
    for (auto const& [name, value] : ranges_from(c.nominal, "--nominal"))
        options.nominal[name] = mid(value);
    auto const region = detail::region_of(r, c, data, problem, options);
    progress.finish();
    auto const title = title_of(data, c.effects, {}, problem.model);
    auto const& paving = region.found.paving;
    file_set files(c.out);
    std::vector<report::axis> sides;
    for (std::size_t s = 0; s < region.names.size(); ++s)
        sides.push_back({region.names[s], region.units[s], paving.prior()[s]});
    bool const complete = is_complete(region.found.reason);
    std::string const reason(to_string(region.found.reason));
    report::confidence_page(title, detail::probability_words(region), reason, complete, sides,
                            paving, region.assumptions, region.remarks, page_footer(c.command_line))
        .add_to(files);
    files.add("confidence.csv", io_detail::paving_csv(region.names, paving));
    files.add("confidence.json", detail::confidence_json(c, problem, data.id, region));
    files.commit();
    result_stream() << title << ": the truth is in the region with a probability of "
                    << detail::probability_words(region)
                    << ", if errors are independent and symmetric\n";
    for (std::size_t s = 0; s < region.names.size() && paving.has_outer(); ++s)
        result_stream() << "  " << region.names[s] << " in "
                        << report::outward_text(paving.outer_hull()[s]) << " " << region.units[s]
                        << "\n";
    result_stream() << "  of the prior's volume: inside at least "
                    << report::at_least_percent(paving.inner_volume().lower())
                    << ", not excluded at most "
                    << report::at_most_percent(paving.outer_volume().upper()) << "\n";
    for (auto const& words : region.remarks) result_stream() << "  " << words << "\n";
    result_stream() << "  " << reason << ", seed " << region.seed << ", "
                    << report::duration_text(region.found.seconds)
                    << "\n  written: " << (c.out / "confidence.html").string()
                    << " and confidence.json, confidence.csv\n";
    return complete ? done : undecided;
}

} // namespace sivid::app

#endif
