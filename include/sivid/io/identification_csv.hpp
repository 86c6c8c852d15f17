// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IDENTIFICATION_CSV_HPP
#define SIVID_IO_IDENTIFICATION_CSV_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/paving/identify.hpp>

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// A text as a cell: in quotes where a comma or a quote would break the row.
inline std::string cell(std::string const& text) {
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char const c : text) quoted += c == '"' ? std::string{"\"\""} : std::string(1, c);
    return quoted + "\"";
}

/// Decimals for a side of a box that the proof covers: inward for an inside box (never more than
/// was proved), outward for the others (nothing that was not excluded is left out).
inline std::pair<std::string, std::string> side_text(interval const& side, bool inside) {
    if (!inside) return {to_decimal_lower(side.lower()), to_decimal_upper(side.upper())};
    auto low = to_decimal_upper(side.lower());
    auto high = to_decimal_lower(side.upper());
    // A side of no width, or nearly: inward decimals may pass each other; the doubles' own digits
    // (written in full) cannot.
    if (*exact_decimal::parse(high) < *exact_decimal::parse(low)) {
        low = exact_decimal::of(side.lower()).text();
        high = exact_decimal::of(side.upper()).text();
    }
    return {std::move(low), std::move(high)};
}

/// The first line of outputs.csv.
inline constexpr std::string_view output_headings =
    "scenario,t,channel,unit,measured_lower,measured_upper,model_lower,model_upper,state";

/// What the rows of outputs.csv begin with: each measurement with its bound, by experiment, in the
/// order of time.
[[nodiscard]] SIVID_DECL std::vector<std::vector<std::string>>
measurement_cells(identification_problem const& problem);

/// One row for each box that is not proved outside.
inline std::string paving_csv(std::vector<std::string> const& names, subpaving const& paving) {
    auto text = paving_headings(names) + "\n";
    for (auto const& b : paving.boxes()) {
        if (b.verdict == box_verdict::outside) continue;
        text += to_string(b.verdict);
        for (auto const& side : b.set) {
            auto const [low, high] = side_text(side, b.verdict == box_verdict::inside);
            text += std::string{","} + low + "," + high;
        }
        text += "\n";
    }
    return text;
}

} // namespace io_detail

/// The text of `boxes.csv`: one row for each inside, undecided or pending box. What no row covers
/// of the prior is proved infeasible.
/// @guarantee  as decimals: every point of an `inside` row is feasible; every feasible point of the
/// prior lies in some row read outward to doubles (between neighbouring inside rows, which are
/// printed inward, less than two floats are in none)
[[nodiscard]] SIVID_DECL std::string boxes_csv(identification_problem const& problem,
                                               identification const& found);

/// The text of `products.csv`: the paving of products from which `boxes.csv` was drawn, in the same
/// form; the columns bear the formulas of the products. Empty when the search ran in the parameters
/// themselves.
/// @guarantee  as for `boxes_csv`, of the products' ranges over the prior
[[nodiscard]] SIVID_DECL std::string products_csv(identification const& found);

/// The text of `outputs.csv`: each measurement with its bound, and the proven enclosure of the
/// model's output for the parameters of `motion`; `state` is `forced_outlier` when every feasible
/// parameter violates it, `witness_outlier` when the witness does, else empty.
[[nodiscard]] SIVID_DECL std::string outputs_csv(identification_problem const& problem,
                                                 identification const& found,
                                                 explaining_motion const* motion);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/identification_csv.ipp>
#endif

#endif // SIVID_IO_IDENTIFICATION_CSV_HPP
