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
#include <string_view>

namespace sivid::report {

namespace detail {

inline constexpr std::string_view before_shown = "\"shows\": ";

/// What a page of a kind shows, with a digest: its writer alone knows what fits together.
template <class... Shown>
std::string data_of(char const* kind, Shown const&... all) {
    value_writer out;
    out.list(all...);
    auto const shown = out.text();
    return "{\n  \"format\": \"sivid-page-1\",\n  \"page\": \"" + std::string{kind} +
           "\",\n  \"sha256\": \"" + sha256(kind + ("\n" + shown)) + "\",\n  " +
           std::string{before_shown} + shown + "}\n";
}

template <class T>
std::optional<T> value_of(T const* x) {
    return x == nullptr ? std::nullopt : std::optional<T>(*x);
}
template <class T>
T const* pointer_to(std::optional<T> const& x) {
    return x ? &*x : nullptr;
}

/// The page of a kind of a decision, of what it shows.
inline stored_page decision_page(std::string const& kind, value_reader const& shown) {
    stored_prediction about;
    requirement asked;
    verification answer;
    std::optional<prediction> tubes;
    decision_page_options o;
    if (kind == "prediction") {
        prediction found;
        shown.list(about, found, o);
        return stored_prediction_page(about, found, o);
    }
    if (kind == "verification") {
        prediction found;
        shown.list(about, asked, answer, found, o);
        return stored_verification_page(about, asked, answer, found, o);
    }
    if (kind == "control") {
        gain_set found{{}, {subpaving(box())}};
        std::optional<verification> proof;
        shown.list(about, asked, found, proof, tubes, o);
        return stored_control_page(about, asked, found, pointer_to(proof), pointer_to(tubes), o);
    }
    design_answer found;
    shown.list(about, found, tubes, o);
    return stored_design_page(about, found, pointer_to(tubes), o);
}

} // namespace detail

SIVID_DECL stored_page stored(identification_view const& v) {
    return {"report.html", identification_page(v).str(), detail::data_of("identification", v)};
}

SIVID_DECL stored_page stored(diagnosis_view const& v) {
    return {"report.html", diagnosis_page(v).str(), detail::data_of("diagnosis", v)};
}

SIVID_DECL stored_page stored_prediction_page(stored_prediction const& about,
                                              prediction const& found,
                                              decision_page_options const& o) {
    return {"prediction.html", prediction_page(about, found, o).str(),
            detail::data_of("prediction", about, found, o)};
}

SIVID_DECL stored_page stored_verification_page(stored_prediction const& about,
                                                requirement const& asked, verification const& found,
                                                prediction const& tubes,
                                                decision_page_options const& o) {
    return {"verification.html", verification_page(about, asked, found, tubes, o).str(),
            detail::data_of("verification", about, asked, found, tubes, o)};
}

SIVID_DECL stored_page stored_control_page(stored_prediction const& about, requirement const& asked,
                                           gain_set const& found, verification const* proof,
                                           prediction const* tubes,
                                           decision_page_options const& o) {
    return {"control.html", control_page(about, asked, found, proof, tubes, o).str(),
            detail::data_of("control", about, asked, found, detail::value_of(proof),
                            detail::value_of(tubes), o)};
}

SIVID_DECL stored_page stored_design_page(stored_prediction const& about, design_answer const& a,
                                          prediction const* tubes, decision_page_options const& o) {
    return {"design.html", design_page(about, a, tubes, o).str(),
            detail::data_of("design", about, a, detail::value_of(tubes), o)};
}

SIVID_DECL stored_page stored_ranking_page(identification_problem const& about,
                                           ranking const& found, decision_page_options const& o,
                                           measurement_ranking const* measurements) {
    return {"ranking.html", ranking_page(about, found, o, measurements).str(),
            detail::data_of("ranking", about, found, o, detail::value_of(measurements))};
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
    if (kind == "identification") {
        identification_view v;
        in.list(v);
        return stored(v);
    }
    if (kind == "diagnosis") {
        diagnosis_view v;
        in.list(v);
        return stored(v);
    }
    if (kind == "ranking") {
        identification_problem about{};
        ranking found;
        decision_page_options o;
        std::optional<measurement_ranking> measurements;
        in.list(about, found, o, measurements);
        return stored_ranking_page(about, found, o, detail::pointer_to(measurements));
    }
    for (auto const* known : {"prediction", "verification", "control", "design"})
        if (kind == known) return detail::decision_page(kind, in);
    json.at("page").fail("unknown page " + in_quotes(kind),
                         "make it by the version that wrote the file");
}

} // namespace sivid::report

#endif
