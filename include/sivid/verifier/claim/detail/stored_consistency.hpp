// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_STORED_CONSISTENCY_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_STORED_CONSISTENCY_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/result/same_problem.hpp>
#include <sivid/verifier/claim/detail/identification_consistency.hpp>
#include <sivid/verifier/claim/detail/product_check.hpp>
#include <sivid/verifier/claim/detail/stored_products.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sivid::io_detail {

/// Whether one of the rows that are left meets an image of products.
inline bool met_by(std::vector<paved_box> const& rows, box const& image) {
    return std::any_of(rows.begin(), rows.end(), [&](paved_box const& row) {
        return row.verdict != box_verdict::outside && !is_empty(intersect(row.set, image));
    });
}

inline box image_of(stored_products const& rebuilt, box const& x) {
    box image(rebuilt.sides.size());
    for (std::size_t k = 0; k < image.size(); ++k)
        image[k] = rebuilt.sides[k].over(x).value_or(interval_traits<interval>::entire());
    return image;
}

/// What the boxes of parameters and of products say of each other.
/// @cost  rows of the one times rows of the other, at most
inline std::string drawing_fault(stored_identification const& stored,
                                 stored_products const& rebuilt) {
    for (auto const& row : stored.rows) {
        if (row.verdict != box_verdict::outside &&
            !met_by(stored.products->rows, image_of(rebuilt, row.set)))
            return "a box of parameters has products in no box of products";
    }
    return {};
}

/// What the boxes say of the witness.
/// @param rebuilt  null where there are no products
inline std::string witness_fault(stored_identification const& stored,
                                 stored_products const* rebuilt) {
    if (!stored.witness) return {};
    box at(stored.parameters.size());
    for (std::size_t j = 0; j < at.size(); ++j) {
        auto const own = stored.witness->parameters.find(stored.parameters[j].name);
        if (own == stored.witness->parameters.end()) return "the witness lacks a parameter";
        at[j] = interval(own->second);
    }
    if (!met_by(stored.rows, at)) return "the witness lies in no box";
    if (rebuilt != nullptr && !met_by(stored.products->rows, image_of(*rebuilt, at)))
        return "the witness lies in no box of products";
    return {};
}

/// Refuses a result that is not one of this problem, or contradicts itself. That its claims are
/// true is for a check to say.
/// @throws input_error
inline void require_consistent(identification_problem const& data,
                               stored_identification const& stored,
                               std::filesystem::path const& file) {
    using outcome = check_finding::outcome;
    auto const refuse = [&](std::string const& what) {
        throw input_error{{.file = file.string()}, what, "identify the data anew"};
    };
    auto const contradicts = [&](std::string const& fault) {
        if (!fault.empty()) refuse("the result contradicts itself: " + fault);
    };
    auto const contradicted = [&](check_finding const& found) {
        if (found.found == outcome::refuted) contradicts(found.what + ": " + found.detail);
    };
    require_same_problem(data, stored, file);
    for (auto const& e : data.experiments) {
        if (e.outliers >= e.measurements.size() && !e.measurements.empty())
            refuse("all measurements of " + in_quotes(e.name) +
                   " may violate their bounds: nothing is known from them");
    }
    if (stored.problem.empty())
        refuse("the result does not say which problem was identified: an earlier version wrote it");
    if (stored.problem != problem_digest(data))
        throw input_error{{.file = file.string()},
                          "this is not the problem that was identified: the model, its constants, "
                          "effects, data or "
                          "budgets of outliers differ (SHA-256)",
                          "give the model and the data set that were identified, or identify anew"};
    if (stored.stated_files.empty()) refuse("the result does not state the SHA-256 of its tables");
    contradicted(check_files(stored));
    auto const inputs = input_assumption(data.experiments);
    if (std::find(stored.assumptions.begin(), stored.assumptions.end(), inputs) ==
        stored.assumptions.end())
        contradicts("it does not assume '" + inputs + "'");
    contradicted(check_rows(data, stored));
    contradicted(check_verdict(stored));
    if (stored.products) {
        auto const rebuilt = rebuild_products<interval>(data, stored.products->sides);
        contradicted(check_products(rebuilt, *stored.products));
        contradicted(check_hull_of_products<interval>(data, stored, rebuilt));
        contradicted(check_combinations_of_products(stored));
        contradicts(drawing_fault(stored, rebuilt));
        contradicts(witness_fault(stored, &rebuilt));
    } else {
        contradicts(witness_fault(stored, nullptr));
        contradicted(check_hull(data, stored));
        contradicted(check_volumes(data, stored));
        contradicted(check_combinations<interval>(data, stored));
    }
    if (stored.verdict == verdict::inconsistent)
        throw input_error{{.file = file.string()},
                          "no parameter is left: the model contradicts the data",
                          "ask `diagnose` what the model lacks"};
}

} // namespace sivid::io_detail

#endif
