// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_CERTIFICATE_IPP
#define SIVID_VERIFIER_IMPL_CERTIFICATE_IPP

#include <sivid/verifier/certificate.hpp>

#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/verifier/claim/detail/certificate_equations.hpp>
#include <sivid/verifier/proof/detail/certificate_cover.hpp>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace sivid {

namespace io_detail {

/// One certificate while it is written.
class certificate_writer {
public:
    certificate_writer(identification_problem const& problem, dataset const& data,
                       stored_identification const& stored, certificate_source const& source,
                       certificate_limits const& limits)
        : problem_(&problem), data_(&data), stored_(&stored), source_(&source), limits_(&limits) {}

    [[nodiscard]] certificate operator()() {
        problem_->require_valid();
        require_known_kind();
        line("sivid-certificate-1");
        line("title", data_->id, problem_->model.about.time_unit);
        block("model", source_->model_name, source_->model_text);
        write_data();
        write_model();
        bool const explained = write_experiments();
        write_claims(explained);
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
        auto const& m = problem_->model;
        if (m.has_memory()) not_certifiable("the model has delays, plays or rate limits");
        if (!m.added_states.empty())
            not_certifiable("states begin where parameters say, or effects added them");
        if (m.stated) not_certifiable("the model's equations are implicit");
        if (m.about.states.size() + problem_->prior.size() > 12 || m.about.inputs.size() > 12 ||
            problem_->experiments.size() > 20)
            not_certifiable("the checker takes 12 states and parameters, 12 inputs, 20 "
                            "experiments at most");
        for (auto const& e : problem_->experiments) {
            for (auto const& u : e.inputs)
                if (is_uncertain(u) || !std::holds_alternative<sampled_signal>(u))
                    not_certifiable("experiment '" + e.name +
                                    "' has an input with error bounds, or a switch");
            if (e.begin != 0 || e.constraint || scenario_of(e) == nullptr)
                not_certifiable("experiment '" + e.name + "' is no scenario of the data set");
        }
    }
    [[nodiscard]] scenario const* scenario_of(experiment const& e) const {
        for (auto const& s : data_->scenarios)
            if (s.name == e.name && s.role == scenario_role::fit) return &s;
        return nullptr;
    }

    void write_data() {
        auto const root = read_json(source_->folder / "dataset.json");
        auto const digest = dataset_digest(source_->folder);
        if (digest != stored_->source_digest)
            throw input_error({.file = (source_->folder / "dataset.json").string()},
                              "these are not the data of the result",
                              "identify the data anew, or name those that were identified");
        require_own_units(root);
        block("file", "dataset.json", read_text(source_->folder / "dataset.json"));
        for (auto const& s : root.at("scenarios").elements()) {
            for (auto const* key : {"inputs", "measurements"}) {
                auto const* name = s.find(key);
                if (name == nullptr) continue;
                auto const text =
                    read_text(path_inside(source_->folder, name->string(), name->place()));
                if (text.rfind("t", 0) != 0 || text.find_first_of(" \t#") != std::string::npos)
                    not_certifiable(name->string() + " is no plain table: take out comments, "
                                                     "blanks and marks, and identify it anew");
                block("file", name->string(), text);
                tables_[s.at("name").string()][key] = name->string();
            }
        }
        line("data", digest, sha256(read_text(source_->result)));
    }
    /// The checker reads the tables as they are.
    void require_own_units(json_value const& root) const {
        auto const& about = problem_->model.about;
        auto const require = [](std::string const& what, json_value const* stated,
                                std::string const& own) {
            if (stated != nullptr && stated->string() != own)
                not_certifiable("the tables have " + what + " in " + stated->string() +
                                ", the model in " + own + ": import them in the model's units");
        };
        require("the time", root.find("time_unit"), about.time_unit);
        auto const all = [&](char const* key, auto const& items) {
            auto const* const units = root.find(key);
            for (auto const& i : items)
                if (units != nullptr) require(i.name, units->find(i.name), i.unit);
        };
        all("channel_units", about.channels);
        all("input_units", about.inputs);
    }

    /// A range as the data set states it, if it is that; else decimals around it.
    [[nodiscard]] static std::pair<std::string, std::string> ends(interval const& x,
                                                                  stated_range const* stated) {
        if (stated != nullptr && stated->enclosure.lower() == x.lower() &&
            stated->enclosure.upper() == x.upper())
            return {stated->lower.text(), stated->upper.text()};
        return {to_decimal_lower(x.lower()), to_decimal_upper(x.upper())};
    }
    void write_model() {
        auto const& about = problem_->model.about;
        certificate_equations const equations(problem_->model, problem_->choice);
        for (auto const& s : about.states) line("state", s.name, s.unit);
        for (auto const& u : about.inputs) line("input", u.name, u.unit);
        for (std::size_t j = 0; j < problem_->prior.size(); ++j) {
            auto const& name = problem_->choice.unknown[j];
            stated_range const* stated = nullptr;
            for (auto const& p : data_->parameters)
                if (p.name == name) stated = &p.prior;
            prior_.push_back(ends(problem_->prior[j], stated));
            auto const& c = about.constants[index_of(about.constants, name, "constant")];
            line("parameter", name, c.unit, prior_[j].first, prior_[j].second);
        }
        result_.text += equations.text();
    }

    /// @returns  whether the witness is proved
    bool write_experiments() {
        auto const& about = problem_->model.about;
        auto const& w = stored_->witness;
        bool const explained = w && witness_holds();
        for (auto const& e : problem_->experiments) {
            auto const& s = *scenario_of(e);
            auto const& u =
                e.inputs.empty() ? sampled_signal() : std::get<sampled_signal>(e.inputs[0]);
            bool const hold = u.kind() == interpolation::hold;
            line("experiment", e.name, tables_[e.name]["measurements"], tables_[e.name]["inputs"],
                 hold ? "hold" : "linear", std::to_string(e.outliers));
            for (std::size_t i = 0; i < e.initial.size(); ++i) {
                auto const& stated = s.initial[i].stated;
                auto const [low, high] = ends(e.initial[i], stated ? &*stated : nullptr);
                if (!explained) {
                    line("begins", about.states[i].name, low, high);
                    continue;
                }
                double const from = w->initial.at(e.name).at(about.states[i].name);
                line("begins", about.states[i].name, low, high,
                     low == high ? low : nearest_text(from));
            }
        }
        for (auto const& name : problem_->choice.unknown)
            if (explained) line("witness", name, nearest_text(w->parameters.at(name)));
        return explained;
    }
    /// By runs of first order from the point, in doubles.
    [[nodiscard]] bool witness_holds() const {
        box p(problem_->prior.size());
        for (std::size_t j = 0; j < p.size(); ++j) {
            auto const at = stored_->witness->parameters.find(problem_->choice.unknown[j]);
            if (at == stored_->witness->parameters.end()) return false;
            p[j] = interval(at->second);
            if (!subset(p[j], problem_->prior[j])) return false;
        }
        auto const& states = problem_->model.about.states;
        for (auto const& e : problem_->experiments) {
            auto const own = stored_->witness->initial.find(e.name);
            if (own == stored_->witness->initial.end()) return false;
            box from = e.initial;
            for (std::size_t i = 0; i < from.size(); ++i) {
                auto const at = own->second.find(states[i].name);
                if (at == own->second.end()) return false;
                if (width(from[i]) > 0) from[i] = intersect(from[i], interval(at->second));
            }
            if (is_empty(from)) return false;
            plain_run<interval> run(problem_->model, problem_->choice, e, certificate_options());
            if (decide(run(from, p), run.samples(), p, e.outliers) != run_finding::explained)
                return false;
        }
        return true;
    }

    /// The box that is kept: the hull and a margin, with faces of few digits.
    [[nodiscard]] std::optional<box> kept_box() const {
        box result = problem_->prior;
        for (std::size_t j = 0; j < result.size(); ++j) {
            auto const& name = problem_->choice.unknown[j];
            for (auto const& p : stored_->parameters) {
                if (p.name != name) continue;
                if (is_empty(p.range)) return std::nullopt;
                double const wider = limits_->margin * width(p.range) + 1e-6 * width(result[j]);
                auto const near = [&](double from, double to) {
                    return certificate_cover::face(interval(from, to));
                };
                auto const& h = p.range;
                result[j] =
                    intersect(result[j], interval(near(h.lower() - 2 * wider, h.lower() - wider),
                                                  near(h.upper() + wider, h.upper() + 2 * wider)));
            }
        }
        if (is_empty(result)) return std::nullopt;
        return result;
    }
    void write_claims(bool explained) {
        bool const none = stored_->verdict == verdict::inconsistent;
        certificate_cover cover(*problem_, limits_->seconds, limits_->boxes, limits_->keep_going);
        auto const hull = none ? std::nullopt : kept_box();
        if (none) cover.all();
        if (hull) cover.around(*hull);
        auto const& kept = cover.hull_of_kept();
        bool const no_tree = cover.excluded() == 0;
        if (!no_tree && kept) write_hull(*kept, hull);
        write_words(explained, none, !no_tree, kept.has_value());
        bool const refuted = none && !no_tree && !kept;
        if (!explained && no_tree)
            not_certifiable("neither a witness nor an excluded box could be proved by simple "
                            "runs; a larger --budget may do");
        line("verdict", std::string(explained ? "consistent"
                                    : refuted ? "inconsistent"
                                              : "undecided"));
        if (!no_tree) result_.text += cover.text();
        result_.excluded = no_tree ? 0 : cover.excluded();
    }
    void write_hull(box const& kept, std::optional<box> const& wanted) {
        bool as_wanted = wanted.has_value();
        for (std::size_t j = 0; j < kept.size(); ++j) {
            auto const& prior = problem_->prior[j];
            auto const low =
                kept[j].lower() == prior.lower() ? prior_[j].first : nearest_text(kept[j].lower());
            auto const high =
                kept[j].upper() == prior.upper() ? prior_[j].second : nearest_text(kept[j].upper());
            line("hull", problem_->choice.unknown[j], low, high);
            as_wanted = as_wanted && subset(kept[j], (*wanted)[j]);
        }
        whole_hull_ = as_wanted;
    }

    /// What is assumed, only tried, and said by the result alone.
    void write_words(bool explained, bool none, bool tree, bool kept) {
        auto const& about = problem_->model.about;
        auto const assume = [this](std::string const& words) { line("assume", words); };
        assume("the equations above hold, with constants that do not change");
        assume("each measurement lies within its error bound, but for the outliers allowed");
        assume("each experiment starts within the stated ranges");
        assume("the parameters lie in their priors: outside of them nothing is claimed");
        if (!about.inputs.empty())
            assume("the inputs are what the tables say, and between samples straight lines or held "
                   "values, as each experiment says");
        for (auto const& words : stored_->assumptions) assume(words);
        line("tried", "the search ended because: " + std::string(to_string(stored_->reason)));
        auto const claim = [this](bool made, std::string const& words) {
            (made ? result_.claimed : result_.unproved).push_back(words);
        };
        if (stored_->verdict == verdict::consistent)
            claim(explained, "the witness explains the measurements");
        if (none) claim(tree && !kept, "no parameter of the prior explains the measurements");
        if (!none && tree)
            claim(true, "no parameter of the prior outside of the hull explains them");
        if (!none && !whole_hull_)
            claim(false, "that all beyond the result's hull and its margin is excluded");
        if (!none) claim(false, "the exact hull of the result: the certified one is wider");
        claim(false, "inside boxes, volumes, combinations and outliers of the result");
        for (auto const& words : result_.unproved) line("unproved", words);
        bool const verdict_made = none                                      ? tree && !kept
                                  : stored_->verdict == verdict::consistent ? explained
                                                                            : true;
        result_.whole = verdict_made && (none || whole_hull_);
    }

    identification_problem const* problem_;
    dataset const* data_;
    stored_identification const* stored_;
    certificate_source const* source_;
    certificate_limits const* limits_;
    std::map<std::string, std::map<std::string, std::string>> tables_; ///< by scenario and role
    std::vector<std::pair<std::string, std::string>> prior_;
    bool whole_hull_ = false;
    certificate result_;
};

} // namespace io_detail

SIVID_DECL certificate make_certificate(identification_problem const& problem, dataset const& data,
                                        stored_identification const& stored,
                                        certificate_source const& source,
                                        certificate_limits const& limits) {
    return io_detail::certificate_writer(problem, data, stored, source, limits)();
}

} // namespace sivid

#endif
