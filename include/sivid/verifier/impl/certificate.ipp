// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_CERTIFICATE_IPP
#define SIVID_VERIFIER_IMPL_CERTIFICATE_IPP

#include <sivid/verifier/certificate.hpp>

#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/dataset/stated_unit.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/verifier/claim/detail/certificate_equations.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>
#include <sivid/verifier/proof/detail/certificate_cover.hpp>

#include <map>
#include <optional>
#include <utility>
#include <variant>

namespace sivid {

namespace io_detail {

/// One certificate while it is written.
class certificate_writer {
public:
    certificate_writer(identification_problem const& problem, dataset const& data,
                       stored_identification const& stored, certificate_source const& source)
        : problem_(problem), data_(data), stored_(stored), source_(source) {}

    [[nodiscard]] certificate operator()(certificate_limits const& limits) {
        problem_.require_valid();
        require_known_kind();
        line("sivid-certificate-1");
        auto const root = read_json(source_.folder / "dataset.json");
        auto const& time = problem_.model.about.time_unit;
        auto const [from, to] = factor(root.find("time_unit"), time);
        line("title", data_.id, time, from, to);
        block("model", source_.model_name, source_.model_text);
        write_data(root);
        write_model(root);
        bool const explained = stored_.witness && witness_holds();
        write_experiments(explained);
        write_claims(limits, explained);
        result_.text += "end\t" + sha256(result_.text) + "\n";
        return std::move(result_);
    }

private:
    template <class... Fields>
    void line(std::string const& first, Fields const&... fields) {
        result_.text += first;
        ((result_.text += "\t" + certificate_field(fields)), ...);
        result_.text += "\n";
    }
    void block(std::string const& kind, std::string const& name, std::string const& text) {
        for (char const c : text)
            if ((static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t') || c == 127)
                not_certifiable(name + " has control characters, or lines that end as in DOS");
        line(kind, name, std::to_string(text.size()));
        result_.text += text + "\n";
    }

    void require_known_kind() const {
        auto const& m = problem_.model;
        if (m.has_memory()) not_certifiable("the model has delays, plays or rate limits");
        if (!m.added_states.empty()) not_certifiable("effects added states with own starts");
        if (m.stated) not_certifiable("the model's equations are implicit");
        if (m.about.states.size() + problem_.prior.size() > 12 || m.about.inputs.size() > 12 ||
            problem_.experiments.size() > 20)
            not_certifiable("more than 12 states and parameters, 12 inputs or 20 experiments");
        for (auto const& e : problem_.experiments) {
            if (e.begin != 0 || e.constraint || scenario_of(e) == nullptr)
                not_certifiable("'" + e.name + "' is no scenario of the data set");
            for (auto const& u : e.inputs)
                if (is_uncertain(u) || !std::holds_alternative<sampled_signal>(u))
                    not_certifiable("inputs of '" + e.name + "' have error bounds or switches");
        }
    }
    [[nodiscard]] scenario const* scenario_of(experiment const& e) const {
        for (auto const& s : data_.scenarios)
            if (s.name == e.name && s.role == scenario_role::fit) return &s;
        return nullptr;
    }

    void write_data(json_value const& root) {
        auto const main = source_.folder / "dataset.json";
        auto const digest = dataset_digest(source_.folder);
        if (digest != stored_.source_digest)
            throw input_error({.file = main.string()}, "these are not the data of the result",
                              "identify them anew, or name those that were identified");
        block("file", "dataset.json", read_text(main));
        for (auto const& s : root.at("scenarios").elements()) {
            for (auto const* key : {"inputs", "measurements"}) {
                auto const* at = s.find(key);
                if (at == nullptr) continue;
                auto const& name = at->string();
                auto const text = read_text(path_inside(source_.folder, name, at->place()));
                if (!text.starts_with('t') || text.find_first_of(" \t#") != std::string::npos)
                    not_certifiable(name + " has comments or blanks: take them out, identify anew");
                block("file", name, text);
                tables_[s.at("name").string()][key] = name;
            }
        }
        line("data", digest, sha256(read_text(source_.result)));
    }
    /// What a number of a table is multiplied by to be in the model's unit, between two decimals.
    [[nodiscard]] static std::pair<std::string, std::string> factor(json_value const* stated,
                                                                    std::string const& own) {
        auto const one = exact_decimal::shortest(1);
        if (stated == nullptr) return {"1", "1"};
        auto const range = stated_unit(*stated, own, "a table").range(one, one);
        return {range.value().lower.text(), range.value().upper.text()};
    }

    /// A range as the data set states it, if it is that; else decimals around it.
    [[nodiscard]] static std::pair<std::string, std::string> ends(interval const& x,
                                                                  stated_range const* stated) {
        if (stated != nullptr && stated->enclosure.lower() == x.lower() &&
            stated->enclosure.upper() == x.upper())
            return {stated->lower.text(), stated->upper.text()};
        return {to_decimal_lower(x.lower()), to_decimal_upper(x.upper())};
    }
    void write_model(json_value const& root) {
        auto const& about = problem_.model.about;
        auto const* const of_channels = root.find("channel_units");
        auto const* const of_inputs = root.find("input_units");
        std::vector<std::string> units;
        for (auto const& y : about.channels) {
            auto const [from, to] =
                factor(of_channels != nullptr ? of_channels->find(y.name) : nullptr, y.unit);
            units.push_back(certificate_field(y.unit) + "\t" + from + "\t" + to);
        }
        for (auto const& s : about.states) line("state", s.name, s.unit);
        for (auto const& u : about.inputs) {
            auto const [from, to] =
                factor(of_inputs != nullptr ? of_inputs->find(u.name) : nullptr, u.unit);
            line("input", u.name, u.unit, from, to);
        }
        for (std::size_t j = 0; j < problem_.prior.size(); ++j) {
            auto const& name = problem_.choice.unknown[j];
            stated_range const* stated = nullptr;
            for (auto const& p : data_.parameters)
                if (p.name == name) stated = &p.prior;
            prior_.push_back(ends(problem_.prior[j], stated));
            auto const& c = about.constants[index_of(about.constants, name, "constant")];
            line("parameter", name, c.unit, prior_[j].first, prior_[j].second);
        }
        result_.text += certificate_equations(problem_.model, problem_.choice, units).text();
    }

    /// By runs of first order from the point, in doubles.
    [[nodiscard]] bool witness_holds() const {
        std::string fault;
        auto const at = witness_motion(problem_, stored_, fault);
        for (std::size_t k = 0; at && k < problem_.experiments.size(); ++k) {
            auto const& e = problem_.experiments[k];
            plain_run<interval> run(problem_.model, problem_.choice, e, certificate_options());
            auto const known = run(at->starts[k], at->parameters);
            if (decide(known, run.samples(), at->parameters, e.outliers) != run_finding::explained)
                return false;
        }
        return at.has_value();
    }
    /// @param explained  the witness and its starts, too
    void write_experiments(bool explained) {
        auto const& about = problem_.model.about;
        for (auto const& e : problem_.experiments) {
            auto const& s = *scenario_of(e);
            bool const hold = !e.inputs.empty() &&
                              std::get<sampled_signal>(e.inputs[0]).kind() == interpolation::hold;
            line("experiment", e.name, tables_[e.name]["measurements"], tables_[e.name]["inputs"],
                 std::string(hold ? "hold" : "linear"), std::to_string(e.outliers));
            for (std::size_t i = 0; i < e.initial.size(); ++i) {
                auto const& [name, stated] = std::pair{about.states[i].name, s.initial[i].stated};
                auto const [low, high] = ends(e.initial[i], stated ? &*stated : nullptr);
                if (!explained)
                    line("begins", name, low, high);
                else
                    line("begins", name, low, high,
                         low == high ? low
                                     : nearest_text(stored_.witness->initial.at(e.name).at(name)));
            }
        }
        if (!explained) return;
        for (auto const& name : problem_.choice.unknown)
            line("witness", name, nearest_text(stored_.witness->parameters.at(name)));
    }

    /// The hull of the result and a margin, with faces of few digits.
    [[nodiscard]] box kept_box(double margin) const {
        box result = problem_.prior;
        for (std::size_t j = 0; j < result.size(); ++j) {
            for (auto const& p : stored_.parameters) {
                if (p.name != problem_.choice.unknown[j] || is_empty(p.range)) continue;
                double const by = margin * width(p.range) + 1e-6 * width(result[j]);
                double const low = p.range.lower() - by, high = p.range.upper() + by;
                result[j] =
                    intersect(result[j], interval(certificate_cover::face(low - by, low),
                                                  certificate_cover::face(high, high + by)));
            }
        }
        return result;
    }
    void write_claims(certificate_limits const& limits, bool explained) {
        bool const none = stored_.verdict == verdict::inconsistent;
        certificate_cover cover(problem_, limits.boxes,
                                work_limit(limits.seconds, limits.keep_going));
        auto const wanted = kept_box(limits.margin);
        cover.exclude_all_but(none ? std::nullopt : std::optional{wanted});
        auto const& kept = cover.hull_of_kept();
        bool const tree = cover.excluded() > 0, refuted = tree && !kept;
        bool const as_wanted = none ? refuted : kept && subset(*kept, wanted);
        if (!explained && !tree)
            not_certifiable("simple runs prove neither a witness nor that a box is excluded; a "
                            "larger --budget may help");
        for (std::size_t j = 0; tree && kept && j < kept->size(); ++j) {
            auto const &side = (*kept)[j], &prior = problem_.prior[j];
            line("hull", problem_.choice.unknown[j],
                 side.lower() == prior.lower() ? prior_[j].first : nearest_text(side.lower()),
                 side.upper() == prior.upper() ? prior_[j].second : nearest_text(side.upper()));
        }
        auto const claim = [this](bool made, std::string const& words) {
            (made ? result_.claimed : result_.unproved).push_back(words);
        };
        bool const consistent = stored_.verdict == verdict::consistent;
        if (consistent) claim(explained, "the witness explains the measurements");
        if (none) claim(refuted, "no parameter of the prior explains the measurements");
        if (!refuted)
            claim(tree, "no parameter of the prior outside of the certified hull explains them");
        if (!none) claim(false, "the hull of the result itself, which is narrower");
        claim(false, "inside boxes, volumes, combinations and outliers of the result");
        result_.whole = as_wanted && (explained || !consistent);
        result_.excluded = cover.excluded();
        write_words();
        line("verdict", std::string(explained ? "consistent"
                                    : refuted ? "inconsistent"
                                              : "undecided"));
        if (tree) result_.text += cover.text();
    }
    /// What is assumed, only tried, and said by the result alone.
    void write_words() {
        auto const assume = [this](std::string const& words) { line("assume", words); };
        assume("the equations above hold, with constants that do not change");
        assume("each measurement lies within its error bound, but for the outliers allowed");
        assume("each experiment starts within the stated ranges");
        assume("the parameters lie in their priors: outside of them nothing is claimed");
        if (!problem_.model.about.inputs.empty())
            assume("the inputs are what the tables say, between samples on straight lines or held");
        for (auto const& words : stored_.assumptions) assume(words);
        line("noted", "the search ended: " + std::string(to_string(stored_.reason)));
        for (auto const& words : result_.unproved) line("unproved", words);
    }

    identification_problem const& problem_;
    dataset const& data_;
    stored_identification const& stored_;
    certificate_source const& source_;
    std::map<std::string, std::map<std::string, std::string>> tables_; ///< by scenario and role
    std::vector<std::pair<std::string, std::string>> prior_;
    certificate result_;
};

} // namespace io_detail

SIVID_DECL certificate make_certificate(identification_problem const& problem, dataset const& data,
                                        stored_identification const& stored,
                                        certificate_source const& source,
                                        certificate_limits const& limits) {
    return io_detail::certificate_writer(problem, data, stored, source)(limits);
}

} // namespace sivid

#endif
