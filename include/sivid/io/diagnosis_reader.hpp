// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DIAGNOSIS_READER_HPP
#define SIVID_IO_DIAGNOSIS_READER_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/io/diagnosis_json.hpp>

#include <filesystem>
#include <string>

namespace sivid {

/// A diagnosis as its file states it; nothing in it is trusted.
struct stored_diagnosis {
    std::string dataset;
    diagnosis_source source; ///< empty texts where the file does not say
    /// What is claimed or rests on claims. Not read: `reach`, `next`, `withdrawn`, `tried`, `score`
    /// and other records of the work.
    diagnosis claims;
};

/// Reads diagnosis.json of a folder. Bounds are read outward, witnesses as the very doubles.
/// @throws input_error  for what is missing or malformed; that it is true is for others to check
[[nodiscard]] SIVID_DECL stored_diagnosis read_diagnosis(std::filesystem::path const& folder);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/diagnosis_reader.ipp>
#endif

#endif
