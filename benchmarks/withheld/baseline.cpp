// SPDX-License-Identifier: MIT
// What anybody would try first: fit every entry of the catalogue by weighted least squares, choose
// by BIC, and add a second effect where one does not suffice. Proves nothing; the scorer shows how
// far this goes.
#include "fit.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <string>

namespace {

using namespace withheld;
using json = nlohmann::json;
using names = std::vector<std::string>;

/// A fit with an inflation up to this is taken for an explanation: least squares does not aim at
/// the smallest inflation, and steps are coarse.
constexpr double good_enough = 1.05;

struct candidate {
    std::vector<effect const*> effects;
    fit_result result;
    std::vector<std::pair<std::string, double>> values;
    double holdout = 0;

    names effect_names() const {
        names all;
        for (auto const* e : effects) all.emplace_back(e->name);
        std::sort(all.begin(), all.end());
        return all;
    }
};

candidate tried(recording const& data, std::vector<effect const*> const& effects,
                std::vector<std::pair<std::string, double>> const& known) {
    fit_problem const problem{data, effects};
    candidate c{effects, fit(problem, effects, known), {}, 0};
    // Near the boundary the largest misfit decides: go for it instead of the sum.
    if (c.result.inflation > 1 && c.result.inflation < 3)
        c.result.inflation = problem.tighten(c.result.x);
    c.values = problem.values(c.result.x);
    c.holdout = problem.inflation(c.result.x, true);
    return c;
}

void sort_by_criterion(std::vector<candidate>& all) {
    std::sort(all.begin(), all.end(), [](candidate const& a, candidate const& b) {
        return a.result.criterion < b.result.criterion;
    });
}

std::vector<candidate> singles(recording const& data) {
    std::vector<candidate> all;
    for (auto const& e : catalogue()) all.push_back(tried(data, {&e}, {}));
    sort_by_criterion(all);
    return all;
}

/// The best few single effects, each with everything else.
std::vector<candidate> pairs(recording const& data, std::vector<candidate> const& first) {
    std::vector<candidate> all;
    std::set<names> seen;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, first.size()); ++i) {
        for (auto const& e : catalogue()) {
            if (&e == first[i].effects[0]) continue;
            candidate c{{first[i].effects[0], &e}, {}, {}, 0};
            if (!seen.insert(c.effect_names()).second) continue;
            all.push_back(tried(data, c.effects, first[i].values));
        }
        sort_by_criterion(all);
        if (all.front().result.inflation <= good_enough) break;
    }
    return all;
}

json interval_up_to(double upper) { return json::array({nullptr, upper}); }

json described(candidate const& c, candidate const& base) {
    json j{{"effects", c.effect_names()},
           {"verdict", "undecided"},
           {"inflation", interval_up_to(c.result.inflation)}};
    for (auto const& [name, value] : c.values)
        if (name.find('.') != std::string::npos) j["parameters"][name] = {value, value};
    for (auto const& [name, value] : c.values) {
        auto const colon = name.find(':');
        if (colon == std::string::npos)
            j["witness"]["parameters"][name] = value;
        else
            j["witness"]["initial"][name.substr(0, colon)][name.substr(colon + 1)] = value;
    }
    j["holdout"] = {{"inflation_before", {base.holdout, base.holdout}},
                    {"inflation_after", {c.holdout, c.holdout}}};
    return j;
}

/// Where the effect acts; the first is named.
json place_of(std::string const& effect) {
    static std::map<std::string, std::pair<char const*, char const*>> const places{
        {"wind", {"equation", "surge"}},
        {"ground_slope", {"equation", "surge"}},
        {"payload", {"equation", "surge"}},
        {"battery_sag", {"equation", "surge"}},
        {"motor_lag", {"equation", "surge"}},
        {"thrust_loss_with_speed", {"equation", "surge"}},
        {"linear_surge_damping", {"equation", "surge"}},
        {"friction_anisotropy", {"equation", "sway"}},
        {"gyro_bias", {"sensor", "r"}},
        {"heading_bias", {"sensor", "psi"}},
        {"position_scale", {"sensor", "x"}},
        {"position_latency", {"sensor", "x"}}};
    auto const place = places.find(effect);
    if (place == places.end()) return {{"kind", "equation"}, {"name", "yaw"}, {"proved", false}};
    return {{"kind", place->second.first}, {"name", place->second.second}, {"proved", false}};
}

json answer_of(std::vector<candidate> const& all, bool explained_without) {
    json other = json::array();
    if (explained_without)
        return {{"kind", "none"}, {"effects", names{}}, {"indistinguishable", other}};
    auto const& best = all.front();
    if (best.result.inflation > good_enough)
        return {{"kind", "unexplained"}, {"effects", names{}}, {"indistinguishable", other}};
    for (auto const& c : all)
        if (&c != &best && c.effects.size() == best.effects.size() && other.size() < 3 &&
            c.result.inflation <= good_enough && c.result.criterion < best.result.criterion + 6)
            other.push_back(c.effect_names());
    return {{"kind", "effects"}, {"effects", best.effect_names()}, {"indistinguishable", other}};
}

double shrink(double before, double after) {
    return 1 - std::max(0.0, after - 1) / std::max(1e-9, before - 1);
}

json diagnosed(recording const& data) {
    auto const begin = std::chrono::steady_clock::now();
    auto const base = tried(data, {}, {});
    bool const explained = base.result.inflation <= good_enough;
    std::vector<candidate> all;
    if (!explained) {
        all = singles(data);
        if (all.front().result.inflation > good_enough) {
            auto const more = pairs(data, all);
            all.insert(all.end(), more.begin(), more.end());
            sort_by_criterion(all);
        }
        // A base fit that is nearly good and that no effect beats clearly is none.
        if (base.result.criterion <= all.front().result.criterion) all.insert(all.begin(), base);
    }
    bool const none = explained || all.front().effects.empty();
    json j{
        {"format", "sivid-diagnosis-1"},
        {"dataset", data.id},
        {"gap", {{"verdict", "undecided"}, {"inflation", interval_up_to(base.result.inflation)}}},
        {"relations", json::array()},
        {"where", json::array()},
        {"causes", json::array()},
        {"answer", answer_of(all, none)},
        {"shrink", {{"fit", nullptr}, {"holdout", nullptr}}},
        {"next", nullptr}};
    for (auto const& c : all)
        if (!c.effects.empty()) j["causes"].push_back(described(c, base));
    for (auto const& name : j["answer"]["effects"])
        j["where"].push_back(place_of(name.get<std::string>()));
    if (j["answer"]["kind"] == "effects") {
        double const fit = shrink(base.result.inflation, all.front().result.inflation);
        j["shrink"]["fit"] = {fit, fit};
        if (base.holdout > 1) {
            double const held = shrink(base.holdout, all.front().holdout);
            j["shrink"]["holdout"] = {held, held};
        }
    }
    std::chrono::duration<double> const taken = std::chrono::steady_clock::now() - begin;
    j["seconds"] = taken.count();
    return j;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Diagnoses campaigns by least squares and BIC."};
    std::vector<std::string> folders;
    std::string out;
    app.add_option("dataset", folders, "folders of data sets")->required();
    app.add_option("--out", out, "results: <out>/<name of the data set's folder>/diagnosis.json")
        ->required();
    CLI11_PARSE(app, argc, argv);
    try {
        for (std::filesystem::path folder : folders) {
            if (folder.filename().empty()) folder = folder.parent_path();
            auto const answer = diagnosed(withheld::read_recording(folder));
            auto const to = std::filesystem::path{out} / folder.filename();
            std::filesystem::create_directories(to);
            std::ofstream file{to / "diagnosis.json"};
            file << answer.dump(2) << '\n';
            if (!file.flush()) throw std::runtime_error("cannot write " + to.string());
        }
    } catch (std::exception const& e) {
        std::cerr << e.what() << '\n';
        return 2;
    }
    return 0;
}
