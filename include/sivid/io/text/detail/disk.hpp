// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_DETAIL_DISK_HPP
#define SIVID_IO_TEXT_DETAIL_DISK_HPP

/// @file
/// What files need of the operating system beyond the standard library: POSIX, or Windows.

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>

#if defined(_WIN32)
#include <algorithm>

#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <sys/stat.h>
#else
#include <csignal>
#include <cstdio>

#include <fcntl.h>
#include <unistd.h>
#endif

namespace sivid::io_detail::disk {

#if defined(_WIN32)

inline int create(std::filesystem::path const& file) {
    return ::_wopen(file.c_str(), _O_WRONLY | _O_CREAT | _O_TRUNC | _O_BINARY | _O_NOINHERIT,
                    _S_IREAD | _S_IWRITE);
}
/// Bytes written of the text's beginning; negative with errno.
inline std::ptrdiff_t write(int handle, std::string_view text) {
    return ::_write(handle, text.data(),
                    static_cast<unsigned>(std::min<std::size_t>(text.size(), 1u << 30)));
}
inline int sync(int handle) { return ::_commit(handle); }
inline int close(int handle) { return ::_close(handle); }
inline void remove(std::filesystem::path const& file) noexcept { (void)::_wunlink(file.c_str()); }
/// Replaces what has the name.
inline std::error_code rename(std::filesystem::path const& from, std::filesystem::path const& to) {
    std::error_code fault;
    std::filesystem::rename(from, to, fault);
    return fault;
}
/// The names of a folder cannot be synced.
inline void sync_folder(std::filesystem::path const&) {}
inline int own_process() { return ::_getpid(); }
/// Not known here: what a killed process left behind stays.
inline bool has_ended(int) { return false; }

#else

inline int create(std::filesystem::path const& file) {
    return ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}
/// Bytes written of the text's beginning; negative with errno.
inline std::ptrdiff_t write(int handle, std::string_view text) {
    return ::write(handle, text.data(), text.size());
}
inline int sync(int handle) { return ::fsync(handle); }
inline int close(int handle) { return ::close(handle); }
inline void remove(std::filesystem::path const& file) noexcept { (void)::unlink(file.c_str()); }
/// Replaces what has the name.
inline std::error_code rename(std::filesystem::path const& from, std::filesystem::path const& to) {
    if (::rename(from.c_str(), to.c_str()) == 0) return {};
    return {errno, std::generic_category()};
}
/// Names on the disk, too; file systems that cannot sync a folder have none to lose.
inline void sync_folder(std::filesystem::path const& folder) {
    int const names = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (names < 0) return;
    (void)::fsync(names);
    ::close(names);
}
inline int own_process() { return ::getpid(); }
inline bool has_ended(int process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

#endif

} // namespace sivid::io_detail::disk

#endif
