// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_CONFIDENCE_IPP
#define SIVID_APP_IMPL_CONFIDENCE_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/paving/confidence_region.hpp>
#include <sivid/report/identification_page.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace sivid::app {

namespace detail {

inline std::string probability_words(confident_region const& region) {
    return report::exact_text(100 * region.probability()) + " % (exactly 1 - " +
           std::to_string(region.above) + "/" + std::to_string(region.sums) + ")";
}

/// All that makes the region again: signs follow from the seed, weights are listed.
inline std::string confidence_json(confidence_command const& c, std::string const& dataset,
                                   confident_region const& region) {
    auto const& found = region.found;
    json_writer json;
    json.begin_object().members("format", "sivid-confidence-1", "dataset", dataset, "sha256",
                                dataset_digest(c.dataset), "effects", c.effects);
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

inline std::string confidence_page(std::string const& title, confidence_command const& c,
                                   confident_region const& region) {
    auto const& paving = region.found.paving;
    report::named_paving named{.paving = &paving};
    report::table hulls{report::columns("*unknown|#range|#prior|~unit")};
    for (std::size_t s = 0; s < region.names.size(); ++s) {
        named.sides.push_back({region.names[s], region.units[s], paving.prior()[s]});
        named.hull.push_back(paving.outer_hull()[s]);
        hulls.rows.push_back({region.names[s], report::outward_text(paving.outer_hull()[s]),
                              report::outward_text(paving.prior()[s]), region.units[s]});
    }
    report::page page({"Confidence region", title,
                       "Where the truth is with a probability of " + probability_words(region)});
    page.banner(is_complete(region.found.reason) ? report::outcome::proved
                                                 : report::outcome::undecided,
                probability_words(region),
                "For independent errors that are symmetric about zero, of any distribution and "
                "size. Inner and outer boxes are proved; " +
                    std::string(to_string(region.found.reason)) + ".");
    page.section("Ranges that hold the region").add(hulls).section("The region");
    page.add(report::detail::paving_figure(
        report::projections(named, {}, 6), "Projections of the region.",
        std::string(report::projection_rule),
        {.inside = "inside: proved in the region", .outside = "outside: proved not in it"}));
    page.assumptions(region.assumptions, "The probability rests on these assumptions");
    page.warnings(region.remarks).footer(page_footer(c.command_line));
    return page.str();
}

} // namespace detail

/// Prints ranges and volumes, and writes confidence.html, confidence.json and confidence.csv, its
/// boxes. Done where the search came to its end, undecided where a budget ended it.
SIVID_DECL int run(robot const& r, confidence_command const& c) {
    auto const data = read_data(r, c.dataset);
    auto const problem = posed(r, data, c.effects, {});
    prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    confidence_options options{.seed = c.seed, .sums = c.sums};
    apply(c.how, options.test);
    options.search.accuracy = c.accuracy.value_or(0.003);
    if (c.accuracy) options.search.sufficient_ratio = 1;
    options.search.seconds = c.budget;
    options.search.keep_going = wanted;
    options.search.progress = [&](auto const& p) { return progress.show(paving_words(p)), true; };
    for (auto const& [name, value] : ranges_from(c.nominal, "--nominal"))
        options.nominal[name] = mid(value);
    auto region = confidence_region(problem, c.probability, options);
    progress.finish();
    for (auto const& words : assumptions_of(r, data, c.effects, {}, problem.model))
        region.assumptions.push_back(words);
    if (!region.found.paving.has_outer())
        region.remarks.push_back("nothing of the prior is in the region: the truth lies elsewhere, "
                                 "or the model is wrong, or this is one of the rare records");
    auto const title = title_of(data, c.effects, {}, problem.model);
    auto const& paving = region.found.paving;
    file_set files(c.out);
    files.add("confidence.html", detail::confidence_page(title, c, region));
    files.add("confidence.csv", io_detail::paving_csv(region.names, paving));
    files.add("confidence.json", detail::confidence_json(c, data.id, region));
    files.commit();
    std::cout << title << ": the truth is in the region with a probability of "
              << detail::probability_words(region) << ", if errors are independent and symmetric\n";
    for (std::size_t s = 0; s < region.names.size() && paving.has_outer(); ++s)
        std::cout << "  " << region.names[s] << " in "
                  << report::outward_text(paving.outer_hull()[s]) << " " << region.units[s] << "\n";
    std::cout << "  of the prior's volume: inside at least "
              << report::at_least_percent(paving.inner_volume().lower())
              << ", not excluded at most " << report::at_most_percent(paving.outer_volume().upper())
              << "\n";
    for (auto const& words : region.remarks) std::cout << "  " << words << "\n";
    std::cout << "  " << to_string(region.found.reason) << ", seed " << region.seed << ", "
              << report::duration_text(region.found.seconds)
              << "\n  written: " << (c.out / "confidence.html").string()
              << " and confidence.json, confidence.csv\n";
    return is_complete(region.found.reason) ? done : undecided;
}

} // namespace sivid::app

#endif
