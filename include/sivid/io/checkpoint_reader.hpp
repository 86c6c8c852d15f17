// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_CHECKPOINT_READER_HPP
#define SIVID_IO_CHECKPOINT_READER_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/checkpoint.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// The state that a text holds.
/// @param file     for messages
/// @param problem  `problem_digest` of what is to be resumed
/// @throws input_error  for a text that is damaged, of another format or version of sivid, or of
///                      another problem
[[nodiscard]] SIVID_DECL identification_state parse_checkpoint(std::string_view text,
                                                               std::string const& file,
                                                               std::string const& problem);

/// @throws input_error  as above, or when there is no such file
[[nodiscard]] SIVID_DECL identification_state read_checkpoint(std::filesystem::path const& file,
                                                              std::string const& problem);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/checkpoint_reader.ipp>
#endif

#endif // SIVID_IO_CHECKPOINT_READER_HPP
