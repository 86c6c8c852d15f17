// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_IMPL_DATASET_DIGEST_IPP
#define SIVID_IO_DATASET_IMPL_DATASET_DIGEST_IPP

#include <sivid/io/dataset/dataset_digest.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/sha256.hpp>

#include <filesystem>
#include <string>

namespace sivid {

SIVID_DECL std::string dataset_digest(std::filesystem::path const& folder) {
    std::string all;
    auto const add = [&all](std::string const& name, std::string const& text) {
        all += name + "\n" + std::to_string(text.size()) + "\n" + text;
    };
    auto const main = folder / "dataset.json";
    add("dataset.json", read_text(main));
    auto const root = read_json(main);
    for (auto const& scenario : root.at("scenarios").elements()) {
        for (auto const* key : {"inputs", "measurements"}) {
            auto const* name = scenario.find(key);
            if (name == nullptr) continue; // a model without inputs
            add(name->string(), read_text(path_inside(folder, name->string(), name->place())));
        }
    }
    return sha256(all);
}

} // namespace sivid

#endif
