// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DIAGNOSIS_READER_IPP
#define SIVID_IO_IMPL_DIAGNOSIS_READER_IPP

#include <sivid/io/diagnosis_reader.hpp>

#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/result/detail/stored_values.hpp>
#include <sivid/io/text/json_document.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// Reads one diagnosis part by part.
class diagnosis_parser {
public:
    [[nodiscard]] stored_diagnosis operator()(json_value const& root) {
        mapping_entries::require_format(root, "sivid-diagnosis-1");
        root.allow_only({"format", "dataset", "source", "problem", "time_unit", "gap", "relations",
                         "where", "causes", "answer", "shrink", "remainder", "next", "unobservable",
                         "assumptions", "withdrawn", "interrupted", "seconds", "by_clock"});
        stored_diagnosis result;
        result.dataset = root.at("dataset").any_string();
        if (auto const* source = root.find("source")) {
            result.source.folder = source->at("folder").any_string();
            result.source.digest = source->at("sha256").string();
        }
        if (auto const* problem = root.find("problem")) result.source.problem = problem->string();
        auto& d = result.claims;
        d.time_unit = root.at("time_unit").string();
        gap(root.at("gap"), d);
        for (auto const& r : root.at("relations").elements()) d.relations.push_back(relation(r));
        d.where = places(root.at("where"));
        for (auto const& c : root.at("causes").elements()) d.causes.push_back(cause_of(c));
        answer(root.at("answer"), d);
        auto const& shrink = root.at("shrink");
        d.shrink_fit = maybe_range(shrink.at("fit"));
        d.shrink_holdout = maybe_range(shrink.at("holdout"));
        d.shrink_over_fits = maybe_range(shrink.at("holdout_over_fits"));
        if (auto const& rest = root.at("remainder"); !is_null(rest)) {
            d.remainder = unexplained_remainder{
                texts(rest.at("effects")), outward(rest.at("inflation")), places(rest.at("where"))};
            for (auto const& n : rest.at("disturbances").elements())
                d.remainder->disturbances.push_back(disturbance(n));
        }
        d.unobservable = texts(root.at("unobservable"));
        d.assumptions = texts(root.at("assumptions"));
        d.interrupted = root.at("interrupted").boolean();
        d.seconds = nearest_number(root.at("seconds"));
        if (auto const* late = root.find("by_clock")) d.by_clock = late->boolean();
        return result;
    }

private:
    [[nodiscard]] static bool is_null(json_value const& entry) {
        return entry.type() == json_value::kind::null;
    }
    [[nodiscard]] static std::optional<interval> maybe_range(json_value const& entry) {
        return is_null(entry) ? std::nullopt : std::optional{outward(entry)};
    }
    [[nodiscard]] static std::string maybe_text(json_value const& entry) {
        return is_null(entry) ? std::string{} : entry.string();
    }
    /// The members of an object, in the order of the file.
    template <class Of>
    [[nodiscard]] static std::vector<named_estimate> estimates(json_value const& object,
                                                               Of const& fill) {
        std::vector<named_estimate> all;
        for (std::size_t k = 0; k < object.members().size(); ++k) {
            named_estimate next{object.name_of(k), {}};
            fill(next, object.members()[k]);
            all.push_back(std::move(next));
        }
        return all;
    }
    [[nodiscard]] static std::vector<named_estimate> hulls(json_value const& object) {
        return estimates(object, [](named_estimate& to, json_value const& entry) {
            to.hull = maybe_range(entry);
        });
    }
    [[nodiscard]] static std::vector<named_estimate> values(json_value const& object) {
        return estimates(object, [](named_estimate& to, json_value const& entry) {
            to.value = nearest_number(entry);
        });
    }
    /// Times or constants: each with value, hull and prior.
    [[nodiscard]] static std::vector<named_estimate> told(json_value const& object) {
        return estimates(object, [](named_estimate& to, json_value const& entry) {
            to.value = nearest_number(entry.at("value"));
            to.hull = maybe_range(entry.at("hull"));
            to.prior = maybe_range(entry.at("prior"));
        });
    }
    [[nodiscard]] static std::optional<named_witness> witness(json_value const& entry) {
        if (is_null(entry)) return std::nullopt;
        named_witness result{values(entry.at("parameters")), {}};
        auto const& initial = entry.at("initial");
        for (std::size_t k = 0; k < initial.members().size(); ++k)
            result.starts.push_back({initial.name_of(k), values(initial.members()[k])});
        return result;
    }
    [[nodiscard]] static named_witness sure_witness(json_value const& entry) {
        return witness(entry).value_or(named_witness{});
    }

    static void gap(json_value const& entry, diagnosis& d) {
        entry.allow_only(
            {"verdict", "inflation", "witness", "scenarios", "channels", "confined", "reach"});
        d.gap = one_of(entry.at("verdict"),
                       {gap_verdict::none, gap_verdict::certified, gap_verdict::undecided});
        d.inflation = outward(entry.at("inflation"));
        d.witness = witness(entry.at("witness"));
        d.scenario_inflation = hulls(entry.at("scenarios"));
        d.channel_inflation = hulls(entry.at("channels"));
        for (auto const& c : entry.at("confined").elements()) d.confined.push_back(confined(c));
    }
    [[nodiscard]] static confined_gap confined(json_value const& entry) {
        confined_gap result;
        result.channel = maybe_text(entry.at("channel"));
        result.scenarios = texts(entry.at("scenarios"));
        result.factor = outward(entry.at("factor"));
        result.witness = sure_witness(entry.at("witness"));
        result.assumptions = texts(entry.at("assumptions"));
        if (auto const& g = entry.at("grows"); !is_null(g)) {
            using with = noise_growth::with;
            result.grows =
                noise_growth{g.at("with").is_second_of("value", "rate") ? with::rate : with::value,
                             outward(g.at("coefficient")), nearest_number(g.at("likelier")),
                             sure_witness(g.at("witness")), sure_witness(g.at("shown"))};
        }
        if (auto const& s = entry.at("steps"); !is_null(s))
            result.steps = reading_steps{nearest_number(s.at("size")), s.at("unit").any_string(),
                                         s.at("cut_off").boolean()};
        return result;
    }
    [[nodiscard]] static time_window window(json_value const& entry) {
        return {entry.at("scenario").any_string(), nearest_number(entry.at("from")),
                nearest_number(entry.at("to"))};
    }
    [[nodiscard]] static needed_disturbance disturbance(json_value const& entry) {
        needed_disturbance result;
        result.equation = entry.at("equation").string();
        result.unit = entry.at("unit").any_string();
        result.size = outward(entry.at("size"));
        for (auto const& w : entry.at("reached").elements()) result.reached.push_back(window(w));
        for (auto const& w : entry.at("strongest").elements())
            result.strongest.push_back(window(w));
        result.regime = entry.at("regime").any_string();
        result.seconds = nearest_number(entry.at("seconds"));
        return result;
    }
    [[nodiscard]] static broken_relation_report relation(json_value const& entry) {
        broken_relation_report result{entry.at("equation").string(),
                                      texts(entry.at("sensors")),
                                      entry.at("proved").boolean(),
                                      texts(entry.at("assumptions")),
                                      {},
                                      entry.at("definition").boolean()};
        for (auto const& w : entry.at("windows").elements()) result.windows.push_back(window(w));
        return result;
    }
    [[nodiscard]] static std::vector<suspected_place> places(json_value const& list) {
        std::vector<suspected_place> all;
        for (auto const& entry : list.elements()) {
            suspected_place p;
            p.kind = entry.at("kind").string();
            p.name = entry.at("name").string();
            p.proved = entry.at("proved").boolean();
            p.where = window(entry);
            p.missing = maybe_range(entry.at("missing"));
            if (auto const& e = entry.at("estimate"); !is_null(e)) p.estimate = nearest_number(e);
            p.unit = entry.at("unit").any_string();
            p.law = maybe_text(entry.at("law"));
            p.regime = maybe_text(entry.at("regime"));
            p.alternatives = texts(entry.at("alternatives"));
            p.assumptions = texts(entry.at("assumptions"));
            all.push_back(std::move(p));
        }
        return all;
    }
    [[nodiscard]] static cause cause_of(json_value const& entry) {
        entry.allow_only({"effects", "verdict", "inflation", "fitted_inflation", "score",
                          "parameters", "estimates", "onsets", "ends", "witness", "assumptions",
                          "untouched", "excluded_by", "holdout"});
        cause c;
        c.effects = texts(entry.at("effects"));
        c.verdict = one_of(entry.at("verdict"), {cause_verdict::explains, cause_verdict::excluded,
                                                 cause_verdict::undecided});
        c.inflation = outward(entry.at("inflation"));
        c.parameters = hulls(entry.at("parameters"));
        auto const fitted = values(entry.at("estimates"));
        auto const name = &named_estimate::name;
        if (!std::ranges::equal(fitted, c.parameters, {}, name, name))
            entry.fail("hulls and estimates of different parameters", "diagnose the data anew");
        for (std::size_t k = 0; k < fitted.size(); ++k) c.parameters[k].value = fitted[k].value;
        c.onsets = told(entry.at("onsets"));
        c.ends = told(entry.at("ends"));
        c.witness = witness(entry.at("witness"));
        c.assumptions = texts(entry.at("assumptions"));
        c.untouched = texts(entry.at("untouched"));
        c.excluded_by = maybe_text(entry.at("excluded_by"));
        if (auto const& h = entry.at("holdout"); !is_null(h)) {
            c.holdout.emplace();
            c.holdout->inflation_before = outward(h.at("inflation_before"));
            c.holdout->inflation_after = outward(h.at("inflation_after"));
            c.holdout->over_fits_before = maybe_range(h.at("over_fits_before"));
            c.holdout->over_fits_after = maybe_range(h.at("over_fits_after"));
        }
        return c;
    }
    static void answer(json_value const& entry, diagnosis& d) {
        entry.allow_only({"kind", "effects", "tried", "constants", "combinations", "journal",
                          "formulas", "symbols", "verified", "at_ends", "indistinguishable"});
        d.answer = one_of(entry.at("kind"), {answer_kind::none, answer_kind::effects,
                                             answer_kind::unexplained, answer_kind::open});
        d.effects = texts(entry.at("effects"));
        d.constants = told(entry.at("constants"));
        for (auto const& c : entry.at("combinations").elements()) {
            named_combination next;
            next.about = {c.at("formula").string(), c.at("unit").any_string(),
                          nearest_number(c.at("value")), maybe_range(c.at("hull")),
                          maybe_range(c.at("prior"))};
            next.is_sum = c.find("factors") == nullptr;
            auto const& parts = c.at(next.is_sum ? "terms" : "factors");
            for (std::size_t k = 0; k < parts.members().size(); ++k)
                next.parts.push_back(
                    {parts.name_of(k), static_cast<int>(nearest_number(parts.members()[k]))});
            d.combinations.push_back(std::move(next));
        }
        d.change.lines = texts(entry.at("formulas"));
        auto const& symbols = entry.at("symbols");
        for (std::size_t k = 0; k < symbols.members().size(); ++k)
            d.change.symbols[symbols.name_of(k)] = symbols.members()[k].any_string();
        d.constants_verified = entry.at("verified").boolean();
        for (auto const& other : entry.at("indistinguishable").elements())
            d.indistinguishable.push_back(texts(other));
    }
};

} // namespace io_detail

SIVID_DECL stored_diagnosis read_diagnosis(std::filesystem::path const& folder) {
    return io_detail::diagnosis_parser{}(read_json(folder / "diagnosis.json"));
}

} // namespace sivid

#endif
