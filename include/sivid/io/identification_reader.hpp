// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IDENTIFICATION_READER_HPP
#define SIVID_IO_IDENTIFICATION_READER_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/result/stored_identification.hpp>

#include <filesystem>

namespace sivid {

/// Reads result.json, boxes.csv and, where there are such, products.csv and certificates.csv of a
/// folder.
///   Boxes are read as the very doubles that were printed: what is proved of them is proved of the
///   decimals, whoever wrote these.
/// @throws input_error  for what is missing or malformed; that it is true is for others to check
[[nodiscard]] SIVID_DECL stored_identification
read_identification(std::filesystem::path const& folder);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/identification_reader.ipp>
#endif

#endif // SIVID_IO_IDENTIFICATION_READER_HPP
