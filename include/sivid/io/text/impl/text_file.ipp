// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_IMPL_TEXT_FILE_IPP
#define SIVID_IO_TEXT_IMPL_TEXT_FILE_IPP

#include <sivid/io/text/text_file.hpp>

namespace sivid {

SIVID_DECL std::string read_text(std::filesystem::path const& file) {
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

} // namespace sivid

#endif
