// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_TEXT_FILE_HPP
#define SIVID_IO_TEXT_TEXT_FILE_HPP

#include <sivid/io/input_error.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace sivid {

/// A file that could not be written.
class output_error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Larger files are refused: they would not fit beside what is made of them.
inline constexpr std::uintmax_t largest_text = 1'000'000'000; ///< [byte]

/// The whole of a regular file, without its UTF-8 byte-order mark.
/// @throws input_error when there is no such file, or it is too large or cannot be read
[[nodiscard]] inline std::string read_text(std::filesystem::path const& file) {
    std::error_code fault;
    auto const fail = [&](std::string problem, std::string remedy) {
        throw input_error{{.file = file.string()}, std::move(problem), std::move(remedy)};
    };
    auto const status = std::filesystem::status(file, fault);
    if (!std::filesystem::exists(status)) fail("no such file", "check the path");
    if (!std::filesystem::is_regular_file(status))
        fail("not a regular file", "give the path of a file");
    if (auto const size = std::filesystem::file_size(file, fault); !fault && size > largest_text)
        fail("larger than 1 GB", "give a part of it, or fewer samples a second");
    std::ifstream in{file, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{in}, std::istreambuf_iterator<char>{}};
    if (!in) fail("cannot be read", "check the permissions");
    if (std::string_view{text}.substr(0, 3) == "\xEF\xBB\xBF") text.erase(0, 3);
    return text;
}

/// The path of a file that a data set names, made safe: relative, and inside the folder even when
/// links are followed.
/// @param place  where the name stands, for the message
/// @throws input_error otherwise; that the file exists is for the reader to find out
[[nodiscard]] inline std::filesystem::path path_inside(std::filesystem::path const& folder,
                                                       std::string const& name,
                                                       input_place const& place) {
    namespace fs = std::filesystem;
    auto const fail = [&](std::string const& problem) {
        throw input_error{place, problem, "name a file inside the folder of the data set"};
    };
    if (name.empty()) fail("the file name is empty");
    if (name.find_first_of(std::string_view{"\0\\", 2}) != std::string::npos)
        fail(in_quotes(name) + " holds a character that has no place in a file name");
    fs::path const relative{name};
    if (relative.is_absolute() || relative.has_root_path())
        fail(in_quotes(name) + " is an absolute path");
    for (auto const& part : relative)
        if (part == "..") fail(in_quotes(name) + " leads out of the folder");

    std::error_code fault;
    auto const root = fs::weakly_canonical(folder, fault);
    if (fault) fail(in_quotes(folder.string()) + " cannot be resolved");
    auto const target = fs::weakly_canonical(root / relative, fault);
    if (fault) fail(in_quotes(name) + " cannot be resolved");
    auto const inside = target.lexically_relative(root);
    if (inside.empty() || *inside.begin() == "..")
        fail(in_quotes(name) + " leads out of the folder through a link");
    return folder / relative;
}

} // namespace sivid

#endif // SIVID_IO_TEXT_TEXT_FILE_HPP
