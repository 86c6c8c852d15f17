// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_HPP
#define SIVID_IO_DATASET_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/input_error.hpp>

#include <filesystem>

namespace sivid {

/// Reads a data set; everything in it was checked against the format and against the model.
/// @guarantee  every interval contains the decimals that the files state; no rounding inward
/// anywhere
/// @throws input_error  for the first defect found, with file, place and remedy
/// @cost  linear in the size of the files
[[nodiscard]] SIVID_DECL dataset read_dataset(std::filesystem::path const& folder,
                                              model_names const& model);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/dataset.ipp>
#endif

#endif
