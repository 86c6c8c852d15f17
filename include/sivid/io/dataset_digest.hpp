// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_DIGEST_HPP
#define SIVID_IO_DATASET_DIGEST_HPP

#include <sivid/io/json_document.hpp>
#include <sivid/io/sha256.hpp>
#include <sivid/io/text_file.hpp>

#include <filesystem>
#include <string>

namespace sivid {

/// One digest of all that a data set says: SHA-256 over dataset.json and the tables that it names,
/// in its order, each with its name and length in front.
/// @guarantee  other numbers in any of these files give another digest; where the folder lies and
/// what else it holds does not matter
/// @throws input_error  for a file that is missing or malformed
[[nodiscard]] inline std::string dataset_digest(std::filesystem::path const& folder) {
    std::string all;
    auto const add = [&all](std::string const& name, std::string const& text) {
        all += name + "\n" + std::to_string(text.size()) + "\n" + text;
    };
    auto const main = folder / "dataset.json";
    add("dataset.json", read_text(main));
    auto const root = read_json(main);
    for (auto const& scenario : root.at("scenarios").elements()) {
        for (auto const* key : {"inputs", "measurements"}) {
            auto const& name = scenario.at(key);
            add(name.string(), read_text(path_inside(folder, name.string(), name.place())));
        }
    }
    return sha256(all);
}

} // namespace sivid

#endif // SIVID_IO_DATASET_DIGEST_HPP
