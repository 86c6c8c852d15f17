// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_STORED_IDENTIFICATION_HPP
#define SIVID_IO_RESULT_STORED_IDENTIFICATION_HPP

#include <sivid/io/allowed_disturbances.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/outliers/fewest_outliers.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/paving/verdict.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// An identification as its files state it; nothing in it is trusted.
struct stored_identification {
    /// A quantity and what it may be; an empty range where the file says null.
    struct bound {
        std::string name;
        interval range;
        std::string unit{};
        /// Of a parameter, between the ends of its range; nothing when the result does not say.
        std::optional<double> excluded_between{};
    };
    struct witness_point {
        std::map<std::string, double> parameters;
        std::map<std::string, std::map<std::string, double>> initial; ///< by scenario, by state
    };
    struct outlier {
        std::string scenario;
        double time = 0;
        std::string channel;
    };

    /// The paving of products from which hull, volumes, combinations and rows were drawn.
    struct product_boxes {
        std::vector<std::string> sides;                 ///< formulas
        std::vector<paved_box> rows;                    ///< of products.csv, read outward
        std::map<std::string, std::size_t> stated_rows; ///< how many of each kind
    };

    /// The motion whose outputs outputs.csv encloses, as result.json says.
    struct shown_motion {
        std::string source; ///< as `to_string(motion_source)`; "" where the table shows none
        std::map<std::string, interval> parameters;                     ///< the very doubles
        std::map<std::string, std::map<std::string, interval>> initial; ///< the same
        std::string digest; ///< of the table, SHA-256, as stated
    };

    /// What data can tell, where it is said, as far as it is called proved.
    struct identifiability_claims {
        std::map<std::string, interval> at; ///< the unknowns for which it holds, the very doubles
        std::vector<std::string> unknowns;
        std::size_t least_rank = 0, most_rank = 0;
        std::vector<std::string> proved; ///< free motions and fixed formulas, as `claims_of` says
    };

    std::string dataset;
    std::string source_folder; ///< the data set, as seen from the folder of the result; may be ""
    std::string source_digest; ///< of `dataset_digest`; "" when the file has none
    std::string problem;       ///< of `problem_digest`; "" when the file has none
    std::string time_unit;     ///< of the model; "" when the file has none
    std::vector<std::string> effects; ///< joined to the data set's model, by name
    allowed_disturbances disturbances;
    sivid::verdict verdict = sivid::verdict::undecided;
    std::string grounds; ///< what the verdict is said to rest on; "" in older files
    stop_reason reason = stop_reason::decided;
    bool by_clock = false; ///< the time ended something: see `identification`
    std::optional<search_effort> effort;
    /// Of certificates.csv: how the exclusions of the products, or else of the boxes, are proved.
    /// Empty where there is no such file.
    exclusion_proof proof;
    double tolerance = 0; ///< of the search's enclosures; 0 when the result does not say
    std::vector<std::string> assumptions;
    /// SHA-256 of the tables, by name: as stated, and as they are.
    std::map<std::string, std::string> stated_files, files;
    std::vector<bound> parameters;
    std::vector<bound> combinations; ///< by formula
    interval inner, outer;
    std::optional<product_boxes> products;
    std::optional<witness_point> witness;
    std::map<std::string, std::size_t> budget; ///< of outliers, by scenario
    std::vector<outlier> forced;
    /// How many outliers are needed, in all and by scenario; nothing when the result does not say.
    std::optional<proved_count> fewest;
    std::map<std::string, proved_count> fewest_alone;
    std::optional<identifiability_claims> identifiability;
    std::vector<paved_box> rows;                    ///< of boxes.csv, read outward
    std::map<std::string, std::size_t> stated_rows; ///< how many of each kind, if stated
    std::optional<shown_motion> shown;              ///< nothing where the result does not say
    std::string outputs; ///< the text of outputs.csv; "" where there is none
};

namespace io_detail {

/// The first line of a table of boxes.
[[nodiscard]] inline std::string paving_headings(std::vector<std::string> const& names) {
    std::string text = "verdict";
    for (auto const& name : names) text += std::string{","} + name + "_lower," + name + "_upper";
    return text;
}

/// How a result states a motion that no output shows: "scaling L 1, Sg -1"
[[nodiscard]] inline std::string motion_claim(std::string const& kind,
                                              std::map<std::string, long> const& weights) {
    std::string text = kind;
    for (auto const& [name, w] : weights) text += " " + name + " " + std::to_string(w);
    return text;
}

} // namespace io_detail

} // namespace sivid

#endif
