// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPORT_FILES_HPP
#define SIVID_APP_IMPORT_FILES_HPP

#include <sivid/app/program.hpp>
#include <sivid/importing/import_writer.hpp>
#ifdef SIVID_HAS_MATIO
#include <sivid/importing/matlab_reader.hpp>
#endif

#ifdef SIVID_HAS_URDF
#include <sivid/importing/robot/robot_text.hpp>
#include <sivid/importing/urdf_reader.hpp>
#endif

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sivid::app {

/// Imports the files that a mapping names into a data set of a model, or of any without one, and
/// prints the protocol of what was dropped. @returns an exit code. @throws input_error,
/// output_error
inline int import_files(model_description const& model, std::filesystem::path const& mapping,
                        std::filesystem::path const& out, bool quiet) {
    if (out.empty()) throw output_error("--out is empty: give a folder for the data set");
    import_tools tools;
#ifdef SIVID_HAS_MATIO
    tools.read_matlab = read_matlab;
#endif
    auto const imported = import_dataset(read_import_mapping(mapping), tools);
    auto const names = names_of(model);
    write_import(imported, out, model.channels.empty() ? nullptr : &names);
    if (!quiet) result_stream() << imported.protocol.text();
    return done;
}

/// Whether a file is the description of a robot, by its name.
[[nodiscard]] inline bool is_robot(std::filesystem::path const& file) {
    return file.extension() == ".urdf" || file.extension() == ".xacro";
}

/// How the description of a robot becomes a model.
struct robot_import {
    std::string within = "10%";                          ///< how far inertial constants may be off
    std::vector<std::string> fixed;                      ///< joints that are taken as fixed
    std::vector<std::string> gravity{"0", "0", "-9.81"}; ///< [m/s^2], in the root link
};

/// Writes the robot that a URDF file describes as robot.toml and import.txt, and prints what was
/// decided, and which inertial constants can be known. @returns an exit code
/// @throws bad_request, input_error, output_error
inline int import_robot(std::filesystem::path const& file, std::filesystem::path const& out,
                        [[maybe_unused]] robot_import const& how, [[maybe_unused]] bool quiet) {
    if (out.empty()) throw output_error("--out is empty: give a folder for the model");
    if (file.extension() == ".xacro")
        throw bad_request(in_quotes(file.string()) +
                          " is a template; expand it first: xacro robot.urdf.xacro > robot.urdf");
#ifdef SIVID_HAS_URDF
    bool const percent = how.within.ends_with('%');
    auto const share = decimal_of(how.within.substr(0, how.within.size() - percent), "--within");
    double const within = nearest(share).value_or(-1) / (percent ? 100 : 1);
    if (!(0 <= within && within < 1))
        throw bad_request("--within: " + in_quotes(how.within) + " is not from 0 to below 100%");
    urdf_options options{{how.fixed.begin(), how.fixed.end()}};
    for (std::size_t k = 0; k < 3; ++k) {
        options.gravity[k] = nearest(decimal_of(how.gravity.at(k), "--gravity")).value_or(0);
        if (std::abs(options.gravity[k]) > 1e3)
            throw bad_request("--gravity: beyond 1000 m/s^2; write it in m/s^2");
    }
    auto const text = text_of_robot(read_urdf(file, options), within);
    auto const about =
        "robot.toml, written from " + printable_path(file.filename().string()) + "\n" + text.about;
    file_set files(out);
    files.add("import.txt", about);
    files.add("robot.toml", text.model);
    files.commit();
    if (!quiet) result_stream() << about;
    return done;
#else
    throw bad_request("this program was built without liburdfdom; install liburdfdom-dev and "
                      "build it anew");
#endif
}

} // namespace sivid::app

#endif
