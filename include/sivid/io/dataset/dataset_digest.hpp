// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_DATASET_DIGEST_HPP
#define SIVID_IO_DATASET_DATASET_DIGEST_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/input_error.hpp>

#include <filesystem>
#include <string>

namespace sivid {

/// One digest of all that a data set says: SHA-256 over dataset.json and the tables that it names,
/// in its order, each with its name and length in front.
/// @guarantee  other numbers in any of these files give another digest; where the folder lies and
/// what else it holds does not matter
/// @throws input_error  for a file that is missing or malformed
[[nodiscard]] SIVID_DECL std::string dataset_digest(std::filesystem::path const& folder);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/dataset/impl/dataset_digest.ipp>
#endif

#endif
