// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_DURABLE_FILE_HPP
#define SIVID_IO_TEXT_DURABLE_FILE_HPP

#include <sivid/io/text/printable_text.hpp>
#include <sivid/io/text/text_file.hpp>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace sivid {

namespace io_detail {

/// Writes a file under another name; when this returns, its content is on the disk.
/// @throws output_error  with the name that it is meant for; nothing is left behind then
inline void write_to_disk(std::filesystem::path const& temporary,
                          std::filesystem::path const& meant_for, std::string_view text) {
    int handle = -1;
    auto const fail = [&](int fault) {
        if (handle >= 0) ::close(handle);
        ::unlink(temporary.c_str());
        throw output_error{printable_path(meant_for.string()) +
                           ": cannot be written: " + std::generic_category().message(fault) +
                           "; check permissions and space"};
    };
    handle = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (handle < 0) fail(errno);
    while (!text.empty()) {
        auto const written = ::write(handle, text.data(), text.size());
        if (written < 0 && errno != EINTR) fail(errno);
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::fsync(handle) != 0) fail(errno);
    int const closed = ::close(handle);
    handle = -1;
    if (closed != 0) fail(errno);
}

/// Names on the disk, too; file systems that cannot sync a folder have none to lose.
inline void sync_folder(std::filesystem::path const& folder) {
    int const names = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (names < 0) return;
    (void)::fsync(names);
    ::close(names);
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
    if (::rename(temporary.c_str(), file.c_str()) != 0) {
        int const fault = errno;
        ::unlink(temporary.c_str());
        throw output_error{printable_path(file.string()) +
                           ": cannot be written: " + std::generic_category().message(fault)};
    }
    io_detail::sync_folder(file.has_parent_path() ? file.parent_path()
                                                  : std::filesystem::path{"."});
}

} // namespace sivid

#endif // SIVID_IO_TEXT_DURABLE_FILE_HPP
