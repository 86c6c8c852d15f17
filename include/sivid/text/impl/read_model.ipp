// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_IMPL_READ_MODEL_IPP
#define SIVID_TEXT_IMPL_READ_MODEL_IPP

#include <sivid/text/read_model.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/text/detail/model_reader.hpp>
#include <sivid/text/detail/model_source.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include <toml++/toml.h>

namespace sivid {

namespace text_detail {

inline auto reader_of(std::string text, std::string const& name) {
    auto const source = std::make_shared<model_source const>(name, std::move(text));
    toml_precheck{*source}();
    try {
        return std::pair{source, toml::parse(source->text())};
    } catch (toml::parse_error const& error) {
        auto const at = error.source().begin;
        source->fail(source->position(at.line, at.column), std::string(error.description()),
                     "this is no TOML: mind quotation marks, brackets, and names that stand twice");
    }
}
inline std::string text_of_file(std::filesystem::path const& file) {
    std::error_code fault;
    if (auto const size = std::filesystem::file_size(file, fault);
        !fault && size > model_source::largest)
        throw model_text_error({.file = file.string()}, "larger than 200 kB",
                               "a model of a robot is shorter: check the path");
    return read_text(file);
}

} // namespace text_detail

SIVID_DECL text_model model_from_text(std::string text, std::string const& name) {
    auto const [source, table] = text_detail::reader_of(std::move(text), name);
    return text_detail::model_reader(source, table).read();
}

SIVID_DECL text_model read_model(std::filesystem::path const& file) {
    return model_from_text(text_detail::text_of_file(file), file.string());
}

SIVID_DECL std::vector<effect> effects_from_text(std::string text, std::string const& name,
                                                 recorded_model const& on) {
    auto const [source, table] = text_detail::reader_of(std::move(text), name);
    return text_detail::model_reader(source, table).read_effects(on);
}

SIVID_DECL std::vector<effect> read_effects(std::filesystem::path const& file,
                                            recorded_model const& on) {
    return effects_from_text(text_detail::text_of_file(file), file.string(), on);
}

} // namespace sivid

#endif
