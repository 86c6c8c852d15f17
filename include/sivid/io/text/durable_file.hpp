// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_DURABLE_FILE_HPP
#define SIVID_IO_TEXT_DURABLE_FILE_HPP

#include <sivid/io/text/detail/disk.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/io/text/text_file.hpp>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace sivid {

namespace io_detail {

/// Writes a file under another name; when this returns, its content is on the disk.
/// @throws output_error  with the name that it is meant for; nothing is left behind then
inline void write_to_disk(std::filesystem::path const& temporary,
                          std::filesystem::path const& meant_for, std::string_view text) {
    int handle = -1;
    auto const fail = [&](int fault) {
        if (handle >= 0) disk::close(handle);
        disk::remove(temporary);
        throw output_error{printable_path(meant_for.string()) +
                           ": cannot be written: " + std::generic_category().message(fault) +
                           "; check permissions and space"};
    };
    handle = disk::create(temporary);
    if (handle < 0) fail(errno);
    while (!text.empty()) {
        auto const written = disk::write(handle, text);
        if (written < 0 && errno != EINTR) fail(errno);
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    if (disk::sync(handle) != 0) fail(errno);
    int const closed = disk::close(handle);
    handle = -1;
    if (closed != 0) fail(errno);
}

} // namespace io_detail

/// Writes a file whole or not at all, on the disk: when this returns, the new content survives the
/// end of the process and of the machine; until then the old content does.
///   The temporary neighbour always has the same name, FILE.part, so that a killed run leaves at
///   most one behind, which the next run overwrites. One process at a time.
/// @throws output_error when it cannot be written; the old content is then still there
/// @cost  waits for the disk
inline void write_durably(std::filesystem::path const& file, std::string_view text) {
    auto temporary = file;
    temporary += ".part";
    io_detail::write_to_disk(temporary, file, text);
    if (auto const fault = io_detail::disk::rename(temporary, file)) {
        io_detail::disk::remove(temporary);
        throw output_error{printable_path(file.string()) +
                           ": cannot be written: " + fault.message()};
    }
    io_detail::disk::sync_folder(file.has_parent_path() ? file.parent_path()
                                                        : std::filesystem::path{"."});
}

} // namespace sivid

#endif // SIVID_IO_TEXT_DURABLE_FILE_HPP
