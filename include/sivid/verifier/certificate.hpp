// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CERTIFICATE_HPP
#define SIVID_VERIFIER_CERTIFICATE_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sivid {

/// What a certificate quotes beside the problem and its result.
struct certificate_source {
    std::filesystem::path folder; ///< of the data set
    std::filesystem::path result; ///< result.json
    std::string model_name;       ///< of the model's file
    std::string model_text;       ///< for people to read; the equations stand in operations
};

struct certificate_limits {
    double seconds = 20;
    std::size_t boxes = 5000; ///< that are tried to exclude
    double margin = 0.04;     ///< on each side of the result's hull, as a share of its width
    std::function<bool()> keep_going = nullptr; ///< once false, no further box is tried
};

/// A result with its data, model, assumptions and proofs in one text (sivid-certificate-1) that a
/// program without sivid checks: examples/certificate/check_certificate.c.
struct certificate {
    std::string text;
    std::vector<std::string> claimed, unproved; ///< in words: for the checker; said by the result
    std::size_t excluded = 0;                   ///< boxes that cover what is claimed to be excluded
    bool whole = false; ///< the verdict is claimed, and the hull with its margin
};

/// Writes the certificate of a stored identification. What it claims was proved here by runs of
/// first order, boxes with measurement bounds 2 % wider than stated; the rest is `unproved`.
/// @given  `require_same_problem`; the problem has the outlier budgets of the result
/// @throws std::invalid_argument  naming what no certificate can hold: delays, plays, rate limits,
///         uncertain or switched inputs, implicit equations, kinks (abs, sign, min, max), atan and
///         log, tables with comments, more than 12 states and parameters; input_error where the
///         data are not those of `stored`
/// @cost  a validated run for each box that is tried
[[nodiscard]] SIVID_DECL certificate make_certificate(identification_problem const& problem,
                                                      dataset const& data,
                                                      stored_identification const& stored,
                                                      certificate_source const& source,
                                                      certificate_limits const& limits = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/verifier/impl/certificate.ipp>
#endif

#endif
