// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_FILE_SET_HPP
#define SIVID_IO_FILE_SET_HPP

#include <sivid/io/text/detail/disk.hpp>
#include <sivid/io/text/durable_file.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/io/text/text_file.hpp>

#include <charconv>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid {

/// The files of one result, written together: a folder holds the old result or the new one, never
/// parts of both.
///   `add` writes a neighbour of the file, to the disk; a disk that is full shows here, and the old
///   result is whole. `commit` gives all of them their names: the file that was added last, which
///   tells readers that the result is complete, leaves first and comes last, so that a process that
///   is killed in between leaves no mixture that reads as a result.
/// The neighbours bear the number of the process, so that two processes do not disturb each other;
/// what is not committed is removed at the end of this object's life, and what a
/// killed process has left behind by the next one that commits the same names.
class file_set {
public:
    /// @throws output_error  when the folder is not there and cannot be created
    explicit file_set(std::filesystem::path folder) : folder_{std::move(folder)} {
        std::error_code fault;
        std::filesystem::create_directories(folder_, fault);
        if (!std::filesystem::is_directory(folder_)) {
            throw output_error{printable_path(folder_.string()) + ": cannot be created" +
                               (fault ? ": " + fault.message() : std::string{})};
        }
    }
    file_set(file_set const&) = delete;
    file_set& operator=(file_set const&) = delete;
    ~file_set() {
        for (auto const& f : files_) io_detail::disk::remove(f.temporary);
    }

    /// @param name  within the folder
    /// @throws output_error  when it cannot be written; nothing has changed then
    void add(std::string const& name, std::string_view text) {
        auto target = folder_ / name;
        if (std::error_code fault; std::filesystem::is_directory(target, fault)) {
            throw output_error{printable_path(target.string()) +
                               ": cannot be written: a folder has this name"};
        }
        auto temporary = target;
        temporary += ".part" + std::to_string(io_detail::disk::own_process());
        io_detail::write_to_disk(temporary, target, text);
        files_.push_back({std::move(target), std::move(temporary)});
    }
    /// Removes a file of an earlier result with the next commit.
    void drop(std::string const& name) { dropped_.push_back(folder_ / name); }

    /// Gives all files their names.
    /// @throws output_error  when one cannot be renamed
    void commit() {
        if (files_.size() > 1) io_detail::disk::remove(files_.back().target);
        for (auto const& file : dropped_) io_detail::disk::remove(file);
        for (auto const& f : files_) {
            if (auto const fault = io_detail::disk::rename(f.temporary, f.target))
                throw output_error{printable_path(f.target.string()) +
                                   ": cannot be written: " + fault.message()};
        }
        remove_leftovers();
        files_.clear();
        dropped_.clear();
        io_detail::disk::sync_folder(folder_);
    }

private:
    struct pending {
        std::filesystem::path target, temporary;
    };

    /// Of processes that were killed while they wrote files of these names.
    void remove_leftovers() const {
        std::error_code fault;
        for (auto const& entry : std::filesystem::directory_iterator{folder_, fault}) {
            auto const name = entry.path().filename().string();
            for (auto const& f : files_) {
                auto const begin = f.target.filename().string() + ".part";
                if (!name.starts_with(begin)) continue;
                int process = 0;
                auto const* const end = name.data() + name.size();
                auto const read = std::from_chars(name.data() + begin.size(), end, process);
                bool const ours = read.ec == std::errc{} && read.ptr == end && process > 0;
                if (ours && io_detail::disk::has_ended(process))
                    io_detail::disk::remove(entry.path());
            }
        }
    }

    std::filesystem::path folder_;
    std::vector<pending> files_;
    std::vector<std::filesystem::path> dropped_;
};

} // namespace sivid

#endif // SIVID_IO_FILE_SET_HPP
