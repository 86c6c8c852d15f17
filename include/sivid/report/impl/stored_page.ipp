// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_STORED_PAGE_IPP
#define SIVID_REPORT_IMPL_STORED_PAGE_IPP

#include <sivid/report/stored_page.hpp>

#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/report/detail/stored_values.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/identification_page.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <tuple>

namespace sivid::report {

namespace detail {

template <class T>
struct unread {
    T value{};
};
template <>
struct unread<gain_set> {
    gain_set value{{}, {subpaving(box())}};
};

/// The page that `make` makes of what is stored.
template <class... Shown>
stored_page made_by(stored_page (*make)(Shown const&...), value_reader const& in) {
    std::tuple<unread<Shown>...> all;
    return std::apply(
        [&](auto&... each) {
            in.list(each.value...);
            return make(each.value...);
        },
        all);
}

} // namespace detail

SIVID_DECL stored_page stored(identification_view const& v) {
    return detail::stored_as("identification", "report", identification_page(v), v);
}

SIVID_DECL stored_page stored(diagnosis_view const& v) {
    return detail::stored_as("diagnosis", "report", diagnosis_page(v), v);
}

SIVID_DECL stored_page read_page(std::filesystem::path const& file) {
    auto const text = read_text(file);
    auto const json = read_json(file);
    if (json.at("format").string() != "sivid-page-1")
        json.fail("this is no page in the format sivid-page-1", "give a file *.page.json");
    auto const kind = json.at("page").string();
    auto const at = text.find(detail::before_shown);
    auto shown = at == std::string::npos ? std::string{} : text.substr(at);
    shown.erase(0, detail::before_shown.size());
    if (shown.ends_with("}\n")) shown.resize(shown.size() - 2);
    if (sha256(kind + "\n" + shown) != json.at("sha256").string())
        json.fail("the file was changed after it was written (SHA-256)",
                  "run the command again that wrote it");
    detail::value_reader const in(json.at("shows"));
    if (kind == "identification") return detail::made_by<identification_view>(stored, in);
    if (kind == "diagnosis") return detail::made_by<diagnosis_view>(stored, in);
    if (kind == "prediction") return detail::made_by(prediction_page, in);
    if (kind == "verification") return detail::made_by(verification_page, in);
    if (kind == "control") return detail::made_by(control_page, in);
    if (kind == "design") return detail::made_by(design_page, in);
    if (kind == "ranking") return detail::made_by(ranking_page, in);
    json.at("page").fail("unknown page " + in_quotes(kind),
                         "make it by the version that wrote the file");
}

} // namespace sivid::report

#endif
