// SPDX-License-Identifier: MIT
// Machines in MuJoCo, each with something that its model of twelve lines does not have.
#ifndef SIVID_BENCHMARKS_SIMULATOR_MACHINES_HPP
#define SIVID_BENCHMARKS_SIMULATOR_MACHINES_HPP

#include <array>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace simulator {

using values = std::vector<double>;

/// Uniform in [lower, upper], the same on every machine.
inline double uniform(std::mt19937_64& random, double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// How something that is withheld comes into a machine.
enum class way {
    by_file,    ///< in the file for MuJoCo
    by_input,   ///< one input acts late
    by_channel, ///< one channel shows what was
    by_rubber   ///< a spring beyond a place of the first joint, which no part of a file is
};

/// What is withheld: its name in the catalogue of the model, and its size. Empty: nothing is.
struct withheld {
    std::string name{};
    double size = 0;
    bool in_catalogue = true;
    way by = way::by_file;
    std::size_t where = 0; ///< the input or channel
};

/// A robot: what it is in MuJoCo, and what its user knows of it.
struct machine {
    std::string name;
    std::vector<std::string> states; ///< positions, then speeds: those of MuJoCo, in its order
    std::vector<std::string> inputs, channels; ///< channels: the first so many positions
    values noise, step;                        ///< of channels: uniform, half-width; quantisation
    std::string model;                         ///< sivid-model-1, with a catalogue
    std::string parameters;                    ///< JSON of the data set: names and priors
    /// The file for MuJoCo, with what is withheld.
    std::function<std::string(values const& constants, withheld const&)> mjcf;
    /// Draws the true constants.
    std::function<values(std::mt19937_64&)> draw;
    /// Kinds of what may be withheld, and the range of each.
    struct kind {
        std::string name;
        double lower, upper;
        way by = way::by_file;
        std::size_t where = 0;
        bool in_catalogue = true;
    };
    std::vector<kind> kinds;
    /// The command at a time, from what the sensors say: a law of the user's.
    std::function<values(double t, values const& positions, values const& speeds,
                         values const& drawn)>
        law;
    std::array<double, 2> start;        ///< range of the first position; the others begin at 0
    double stop = 0;                    ///< where rubber is, if it is: of the first position
    std::vector<std::string> constants; ///< in the order of `draw`
};

[[nodiscard]] machine lever();
[[nodiscard]] machine arm();
[[nodiscard]] machine rover();
[[nodiscard]] machine turning_arm();

} // namespace simulator

#endif
