// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_PROVED_MEMBER_HPP
#define SIVID_APP_DETAIL_PROVED_MEMBER_HPP

#include <sivid/app/commands.hpp>
#include <sivid/app/console.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/program.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/diagnosis_reader.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/result/same_problem.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid::app::detail {

/// A result in which nothing is proved to explain the data, and the program's exit code for that.
struct no_member : std::runtime_error {
    no_member(int exit_code, std::string const& words)
        : std::runtime_error(words), code{exit_code} {}
    int code;
};

/// A parameter that is proved to explain the data, among all that a result leaves.
struct proved_member {
    identification_problem problem; ///< with the effects of the result
    std::string dataset;
    std::vector<std::string> effects, assumptions;
    std::vector<double> point; ///< the parameter
    box hull;                  ///< holds every parameter that explains the data, as the result says
};

/// Reads a result's member, and proves it anew: files are not trusted.
class member_reader {
public:
    member_reader(robot const& r, export_command const& c) : of_{r}, command_{c} {}

    /// @throws no_member, input_error, bad_request
    [[nodiscard]] proved_member read() {
        std::error_code fault;
        bool const diagnosed = std::filesystem::exists(command_.result / "diagnosis.json", fault);
        if (diagnosed && std::filesystem::exists(command_.result / "result.json", fault))
            throw bad_request(command_.result.string() +
                              " has an identification and a diagnosis: give a folder with one");
        prove(diagnosed ? diagnosis() : identification());
        return std::move(result_);
    }

private:
    [[nodiscard]] dataset data_of(std::string const& stated, std::string const& digest) {
        auto const folder = data_of_result(command_.result, command_.dataset, stated);
        if (dataset_digest(folder) != digest)
            throw input_error{{.file = folder.string()},
                              "this is not the data set of the result (SHA-256)",
                              "give the right one by --dataset, or work it out anew"};
        auto data = read_data(of_, folder);
        result_.dataset = data.id;
        return data;
    }
    void require_problem(std::string const& digest) {
        if (digest != problem_digest(result_.problem))
            throw input_error{{.file = command_.result.string()},
                              "the result is of another model than this one",
                              "give the model that it was made with, or work it out anew"};
    }

    [[nodiscard]] named_witness identification() {
        auto const stored = read_identification(command_.result);
        if (stored.verdict == verdict::inconsistent)
            throw no_member(inconsistent, "no parameter explains the data (proved); diagnose "
                                          "them, and export that");
        if (stored.verdict != verdict::consistent)
            throw no_member(undecided, "no parameter is proved to explain the data; identify with "
                                       "more --budget, or diagnose them");
        auto const data = data_of(stored.source_folder, stored.source_digest);
        std::optional<remembering_problem> remembering;
        auto& p = result_.problem;
        p = posed(of_, data, stored.effects, stored.disturbances, std::nullopt, &remembering);
        require_same_problem(p, stored, command_.result / "result.json");
        for (auto& e : p.experiments) e.outliers = stored.budget.at(e.name);
        require_problem(stored.problem);
        result_.effects = stored.effects;
        result_.assumptions = stored.assumptions;
        result_.hull = p.prior;
        for (std::size_t j = 0; j < p.prior.size(); ++j)
            result_.hull[j] = stored.parameters[j].range;
        return stored.witness ? witness_of(*stored.witness) : middle_of_inside(stored.rows);
    }
    [[nodiscard]] static named_witness
    witness_of(stored_identification::witness_point const& stored) {
        auto const named = [](std::map<std::string, double> const& values) {
            std::vector<named_estimate> list;
            for (auto const& [name, x] : values) list.push_back({name, {}, x});
            return list;
        };
        named_witness w{named(stored.parameters), {}};
        for (auto const& [name, start] : stored.initial) w.starts.push_back({name, named(start)});
        return w;
    }
    /// Of a box that is proved inside, where no point was verified by itself.
    [[nodiscard]] named_witness middle_of_inside(std::vector<paved_box> const& rows) const {
        auto const at = std::ranges::find(rows, box_verdict::inside, &paved_box::verdict);
        if (at == rows.end())
            throw no_member(undecided, "the result names no parameter that explains the data; "
                                       "identify by the contracting algorithm, with more --budget");
        auto const& p = result_.problem;
        named_witness w;
        for (std::size_t j = 0; j < at->set.size(); ++j)
            w.parameters.push_back({p.choice.unknown[j], {}, mid(at->set[j])});
        for (auto const& e : p.experiments) {
            w.starts.push_back({e.name, {}});
            for (std::size_t k = 0; k < e.initial.size(); ++k)
                w.starts.back().states.push_back(
                    {p.model.about.states[k].name, {}, mid(e.initial[k])});
        }
        return w;
    }

    [[nodiscard]] named_witness diagnosis() {
        auto const stored = read_diagnosis(command_.result);
        auto const& d = stored.claims;
        auto const at = std::ranges::find(d.causes, d.effects, &cause::effects);
        bool const answered = d.answer == answer_kind::effects && at != d.causes.end();
        auto const& w = answered ? at->witness : d.witness;
        if (!w || !(answered ? at->verdict == cause_verdict::explains
                             : d.answer == answer_kind::none && d.gap == gap_verdict::none))
            throw no_member(undecided, "nothing is proved to explain the data (the answer is " +
                                           std::string{to_string(d.answer)} +
                                           "); diagnose with more --budget, or with an effect of "
                                           "your own");
        auto const data = data_of(stored.source.folder, stored.source.digest);
        auto& p = result_.problem;
        p = problem_from_dataset(data, of_.model);
        require_problem(stored.source.problem);
        p = affected(p, effects_of(of_, data, d.effects));
        result_.effects = d.effects;
        result_.assumptions = d.assumptions;
        result_.hull = p.prior;
        for (std::size_t j = 0; j < p.prior.size(); ++j)
            for (auto const& known : d.constants)
                if (known.name == p.choice.unknown[j] && known.hull) result_.hull[j] = *known.hull;
        return *w;
    }

    void prove(named_witness const& w) {
        auto const at = io_detail::point_of(result_.problem, w);
        if (!at) throw no_member(refuted, "the witness is no point of the prior and the starts");
        feasibility_test_options how;
        how.keep_going = wanted;
        auto const proved = verify_at(result_.problem, *at, how);
        result_.point = at->parameters;
        if (proved.range.lower() > 1 || !subset(point_box(result_.point), result_.hull))
            throw no_member(refuted, "the result is not what its data prove: what it calls a "
                                     "witness does not explain them, or lies outside its ranges");
        if (!(proved.range.upper() <= 1))
            throw no_member(undecided, "it is not proved anew that the result's witness explains "
                                       "the data; see `check`, and identify anew");
        for (auto const& a : proved.assumptions)
            if (std::ranges::find(result_.assumptions, a) == result_.assumptions.end())
                result_.assumptions.push_back(a);
    }

    robot const& of_;
    export_command const& command_;
    proved_member result_;
};

} // namespace sivid::app::detail

#endif
