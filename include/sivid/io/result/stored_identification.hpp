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
    /// A parameter and its hull; an empty range where the file says null.
    struct bound {
        std::string name;
        interval range;
        std::string unit{};
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
        std::vector<std::string> sides; ///< formulas
        std::vector<paved_box> rows;    ///< of products.csv, the very boxes
    };

    /// The motion whose outputs outputs.csv encloses, as result.json says.
    struct shown_motion {
        std::string source; ///< as `to_string(motion_source)`; "" where the table shows none
        std::map<std::string, interval> parameters;                     ///< the very doubles
        std::map<std::string, std::map<std::string, interval>> initial; ///< the same
    };

    std::string dataset;
    std::string source_folder; ///< the data set, as seen from the folder of the result; may be ""
    std::string source_digest; ///< of `dataset_digest`; "" when the file has none
    std::string problem;       ///< of `problem_digest`; "" when the file has none
    std::vector<std::string> effects; ///< joined to the data set's model, by name
    allowed_disturbances disturbances;
    sivid::verdict verdict = sivid::verdict::undecided;
    stop_reason reason = stop_reason::decided;
    bool searched = false; ///< else measurements came one by one
    /// Of certificates.csv: how the exclusions of the products, or else of the boxes, are proved.
    /// Empty where there is no such file.
    exclusion_proof proof;
    double tolerance = 0; ///< of the search's enclosures; 0 when the result does not say
    std::vector<std::string> assumptions;
    /// What follows from the boxes, the witness and the problem, as it is stated: the text of each
    /// number and word of result.json by its place there.
    std::map<std::string, std::string> stated;
    std::vector<bound> parameters;
    std::optional<product_boxes> products;
    std::optional<witness_point> witness;
    std::map<std::string, std::size_t> budget; ///< of outliers, by scenario
    std::vector<outlier> forced;
    /// How many outliers are needed, in all and by scenario; nothing when the result does not say.
    std::optional<proved_count> fewest;
    std::map<std::string, proved_count> fewest_alone;
    /// The unknowns for which it is said what data can tell, the very doubles.
    std::optional<std::map<std::string, interval>> identifiable_at;
    std::vector<paved_box> rows;       ///< of boxes.csv, the very boxes
    std::optional<shown_motion> shown; ///< nothing where the result does not say
    std::string outputs;               ///< the text of outputs.csv; "" where there is none
};

namespace io_detail {

/// The first line of a table of boxes.
[[nodiscard]] inline std::string paving_headings(std::vector<std::string> const& names) {
    std::string text = "verdict";
    for (auto const& name : names) text += std::string{","} + name + "_lower," + name + "_upper";
    return text;
}

} // namespace io_detail

} // namespace sivid

#endif
