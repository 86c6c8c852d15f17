// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_REPORT_IPP
#define SIVID_APP_IMPL_REPORT_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/program.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/report/stored_page.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace sivid::app {

SIVID_DECL int run(robot const&, report_command const& c) {
    std::vector<std::filesystem::path> found;
    std::error_code fault;
    for (auto const& file : std::filesystem::directory_iterator(c.result, fault))
        if (file.path().filename().string().ends_with(".page.json")) found.push_back(file.path());
    if (found.empty())
        throw input_error{{.file = c.result.string()},
                          "no page of a result is here (*.page.json)",
                          "give the folder that a command wrote by --out"};
    std::sort(found.begin(), found.end());
    std::vector<report::stored_page> pages;
    for (auto const& file : found) pages.push_back(report::read_page(file));
    auto const& out = c.out.empty() ? c.result : c.out;
    prepare_folder(out);
    file_set files(out);
    for (auto const& page : pages) files.add(page.name, page.html);
    files.commit();
    for (auto const& page : pages)
        result_stream() << "written: " << (out / page.name).string() << "\n";
    result_stream() << "as the result states it: `check` proves it anew\n";
    return done;
}

} // namespace sivid::app

#endif
