// SPDX-License-Identifier: MIT
// A robot as small as can be, and its program run within this process.
#ifndef SIVID_TESTS_APP_CUP_HPP
#define SIVID_TESTS_APP_CUP_HPP

#include "io/support.hpp"

#include <sivid/app/app.hpp>
#include <sivid/app/program.hpp>
#include <sivid/model/effects.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace app_test {

namespace fs = std::filesystem;

/// A cup that cools and is heated: T' = h - k T.
struct cooling {
    static constexpr auto name = "cup";
    static constexpr auto states = sivid::states({{"T", "K", 1000}});
    static constexpr auto inputs = sivid::inputs({{"h", "K/s"}});
    static constexpr auto channels = sivid::channels({{"T", "K"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1/s", 0.5_dec}, {"gain", "1", 1_dec}});
    }();
    template <class T>
    sivid::states_of<cooling, T> rate(T const&, sivid::states_of<cooling, T> const& x,
                                      sivid::constants_of<cooling, T> const& c,
                                      sivid::inputs_of<cooling, T> const& u) const {
        return {c[1] * u[0] - c[0] * x[0]};
    }
    template <class T>
    sivid::channels_of<cooling, T> observe(T const&, sivid::states_of<cooling, T> const& x,
                                           sivid::constants_of<cooling, T> const&,
                                           sivid::inputs_of<cooling, T> const&) const {
        return x;
    }
};

inline sivid::app::robot cup() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    auto r = sivid::app::robot_of("cup", "A cup of tea", cooling{},
                                  {any::constant_rate("draught", "T", "K/s", {-2_dec, 2_dec}),
                                   any::sensor_bias("bias", "T", "K", {-1_dec, 1_dec})});
    r.scenarios = {{"tea", R"({"format": "sivid-scenario-1", "name": "tea", "duration": 2,
                               "initial": {"T": 60}, "inputs": {"h": {"shape": "constant",
                               "value": 2}}})"}};
    r.prior = {{"k", sivid::app::decimal_of("0.2", ""), sivid::app::decimal_of("1", "")}};
    return r;
}

struct finished {
    int code;
    std::string out, err;
};

/// What the program prints goes to texts; progress, which goes to the terminal, is left out.
inline finished run(std::vector<std::string> words, sivid::app::robot const& r = cup()) {
    words.insert(words.begin(), r.name);
    std::vector<char*> argv;
    for (auto& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    std::ostringstream out, err;
    int const code = sivid::app::run(r, static_cast<int>(words.size()), argv.data(), {out, err});
    return {code, out.str(), err.str()};
}

/// A folder with a data set of the cup's, made by the program.
class served {
public:
    served() {
        made = run({"generate", "--scenario", "tea", "--absolute", "0.2", "--rate", "5", "--out",
                    data(), "--quiet"});
    }
    [[nodiscard]] std::string data() const { return at("data"); }
    [[nodiscard]] std::string at(std::string const& name) const {
        return (folder_.path() / name).string();
    }
    io_support::temporary_folder const& folder() const { return folder_; }
    finished made{};

private:
    io_support::temporary_folder folder_;
};

} // namespace app_test

#endif
