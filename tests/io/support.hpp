// SPDX-License-Identifier: MIT
// A temporary folder, the names of the hovercraft, and a small valid data set to be spoilt.
#ifndef SIVID_TESTS_IO_SUPPORT_HPP
#define SIVID_TESTS_IO_SUPPORT_HPP

#include <sivid/io/dataset/model_names.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

namespace io_support {

namespace fs = std::filesystem;

/// Removed with its content at the end of its scope.
class temporary_folder {
public:
    temporary_folder() {
        std::random_device random;
        do
            path_ = fs::temp_directory_path() /
                    std::string{"sivid_io_"}.append(std::to_string(random()));
        while (!fs::create_directory(path_));
    }
    ~temporary_folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    temporary_folder(temporary_folder const&) = delete;
    temporary_folder& operator=(temporary_folder const&) = delete;

    [[nodiscard]] fs::path const& path() const { return path_; }
    void write(std::string const& name, std::string_view text) const {
        fs::create_directories((path_ / name).parent_path());
        fs::remove(path_ / name); // truncating an old file would wait for the disk on ext4
        std::ofstream{path_ / name, std::ios::binary} << text;
    }
    [[nodiscard]] std::string read(std::string const& name) const {
        std::ifstream in{path_ / name, std::ios::binary};
        return {std::istreambuf_iterator<char>{in}, {}};
    }

private:
    fs::path path_;
};

inline sivid::model_names hovercraft_names() {
    sivid::model_names names;
    names.name = "hovercraft";
    names.constants = {{"m", "kg"},        {"Iz", "kg m^2"}, {"rho", "kg/m^3"}, {"Cd", ""},
                       {"CL", "1/rad"},    {"Cdelta", ""},   {"D", "m"},        {"Su", "m^2"},
                       {"Sv", "m^2"},      {"Sg", "m^2"},    {"A", "m^2"},      {"L", "m"},
                       {"Ff", "N"},        {"eps", "m/s"},   {"D11", "kg/s"},   {"D22", "kg/s"},
                       {"D33", "kg m^2/s"}};
    names.states = {{"u", "m/s"}, {"v", "m/s"}, {"r", "rad/s"},
                    {"x", "m"},   {"y", "m"},   {"psi", "rad"}};
    names.channels = names.states;
    names.inputs = {{"W", "1/s"}, {"delta", "rad"}};
    names.state_ranges = {{-8, 8}, {-8, 8}, {-6, 6}, {-50, 50}, {-50, 50}, {-10, 10}};
    return names;
}

inline constexpr std::string_view small_json = R"({
  "format": "sivid-dataset-1", "id": "small", "model": "hovercraft",
  "parameters": { "Sv": {"prior": [0.20, 0.25], "unit": "m^2"}, "Cd": {"prior": [0.5, 0.7]} },
  "fixed": { "m": 1.297 },
  "max_outlier_fraction": 0.29,
  "scenarios": [
    { "name": "S1", "role": "fit", "duration": 1, "inputs": "S1.inputs.csv", "interpolation": "linear",
      "measurements": "S1.measurements.csv", "initial": { "u": [0.1, 0.3], "v": [0, 0] } },
    { "name": "H1", "role": "holdout", "duration": 0.5, "inputs": "H1.inputs.csv", "interpolation": "hold",
      "measurements": "H1.measurements.csv", "initial": {} } ]
}
)";
inline constexpr std::string_view small_inputs = "t,W,delta\n0,250,0\n0.5,200,0.1\n1,250,0\n";
inline constexpr std::string_view small_measurements = "t,u,u_err,psi,psi_err\n"
                                                       "0.1,2.038474,0.02,-0.005986,0.03\n"
                                                       "0.2,,0.02,0.1,0.03\n"
                                                       "1,3,0.02,,\n";

/// Writes the small valid data set.
inline void write_small(temporary_folder const& folder) {
    folder.write("dataset.json", small_json);
    folder.write("S1.inputs.csv", small_inputs);
    folder.write("S1.measurements.csv", small_measurements);
    folder.write("H1.inputs.csv",
                 "t,delta,delta_err,W\n-0.1,0,0.01,100\n0.25,,,120\n0.6,0.2,0.02,130\n");
    folder.write("H1.measurements.csv", "t,r,r_err\n0.5,0.1,1e-3\n");
}

/// `text` with the first occurrence of `from` replaced; throws when there is none, so that no case
/// tests nothing.
inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
    std::string result{text};
    auto const at = result.find(from);
    if (at == std::string::npos) throw std::logic_error{"not in the text: " + std::string{from}};
    return result.replace(at, from.size(), to);
}

} // namespace io_support

#endif // SIVID_TESTS_IO_SUPPORT_HPP
