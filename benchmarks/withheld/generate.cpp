// SPDX-License-Identifier: MIT
// Writes campaigns whose effect is withheld: data sets into one folder, the labels elsewhere.
#include "campaign_files.hpp"

#include <CLI/CLI.hpp>

#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <future>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    using namespace withheld;
    CLI::App app{"Draws hovercraft campaigns with a withheld effect."};
    std::uint64_t seed = 1;
    std::size_t count = 30;
    std::string out, labels, only;
    app.add_option("--seed", seed, "everything is drawn from it")->capture_default_str();
    app.add_option("--count", count, "number of campaigns")->capture_default_str();
    app.add_option("--out", out, "folder of the data sets")->required();
    app.add_option("--labels", labels, "file of the labels, outside of --out")->required();
    app.add_option("--families", only, "these families only, with commas between them");
    double size = 1;
    std::size_t jobs = 1;
    app.add_option("--size", size, "multiplies the effects, for a harder check")
        ->check(CLI::Range(0.01, 1.0))
        ->capture_default_str();
    app.add_option("--jobs", jobs, "threads")->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    try {
        auto const kinds = families_named(only);
        auto const inside = std::filesystem::weakly_canonical(labels).lexically_relative(
            std::filesystem::weakly_canonical(out));
        if (!inside.empty() && *inside.begin() != "..") {
            std::cerr << "the labels must not lie in the folder of the data sets\n";
            return 2;
        }
        // Campaigns do not depend on each other; the table is in their order.
        std::vector<std::string> lines(count);
        std::atomic<std::size_t> next{0};
        auto const work = [&] {
            for (std::size_t i = next++; i < count; i = next++) {
                campaign c = draw_campaign(seed, i, kinds, size);
                char id[32];
                std::snprintf(id, sizeof id, "w%04zu", i);
                c.id = id;
                auto const folder = std::filesystem::path{out} / id;
                write_dataset(c, folder);
                lines[i] = label_of(c, folder);
            }
        };
        std::vector<std::future<void>> others;
        for (std::size_t k = 1; k < jobs; ++k)
            others.push_back(std::async(std::launch::async, work));
        work();
        for (auto& other : others) other.get();
        std::ofstream table{labels};
        table << labels_header() << '\n';
        for (auto const& line : lines) table << line << '\n';
        table.flush();
        if (!table) throw std::runtime_error("cannot write " + labels);
    } catch (std::invalid_argument const& e) {
        std::cerr << e.what() << '\n';
        return 2;
    } catch (std::exception const& e) {
        std::cerr << e.what() << '\n';
        return 70;
    }
    return 0;
}
