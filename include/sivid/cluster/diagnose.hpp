// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_DIAGNOSE_HPP
#define SIVID_CLUSTER_DIAGNOSE_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/wire.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>
#include <sivid/cluster/working_coordinator.hpp>
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::cluster {

namespace diagnose_detail {

inline void put(wire_writer& out, approximate_fit const& fit) {
    out.put(fit.parameters).put(fit.inflation).put(fit.squares);
    for (auto const* lists : {&fit.starts, &fit.residuals}) {
        out.put(std::uint64_t{lists->size()});
        for (auto const& x : *lists) out.put(x);
    }
}
[[nodiscard]] inline approximate_fit take_fit(wire_reader& in) {
    approximate_fit fit;
    fit.parameters = in.reals();
    fit.inflation = in.real();
    fit.squares = in.real();
    for (auto* lists : {&fit.starts, &fit.residuals}) {
        lists->resize(in.count(8));
        for (auto& x : *lists) x = in.reals();
    }
    return fit;
}
inline void put(wire_writer& out, std::vector<std::size_t> const& effects) {
    out.put(std::uint64_t{effects.size()});
    for (auto const e : effects) out.put(std::uint64_t{e});
}

/// Fits candidates as they are asked for.
class candidate_server {
public:
    candidate_server(identification_problem const& base, std::vector<effect> const& catalogue)
        : candidates_(base, catalogue), effects_(candidates_.catalogue().size()) {}

    /// @throws wire_error
    [[nodiscard]] std::string answer(std::string_view request,
                                     std::function<bool()> const& wanted) const {
        wire_reader in(request);
        wanted_fit w{take_effects(in)};
        std::optional<screened> part;
        if (in.flag()) {
            part = candidates_.posed(take_effects(in));
            part->fit = take_fit(in);
            require_fit_of(*part);
            w.part = &*part;
        }
        in.finish();
        auto const made = candidates_.make(w, wanted);
        wire_writer out;
        put(out, made.fit);
        return out.put(made.silent).take();
    }

    /// @throws wire_error  for a fit of something else
    static void require_fit_of(screened const& s) {
        bool same = s.fit.parameters.size() == s.problem.prior.size() &&
                    s.fit.starts.size() == s.problem.experiments.size() &&
                    s.fit.residuals.size() == s.problem.experiments.size();
        for (std::size_t e = 0; same && e < s.problem.experiments.size(); ++e) {
            auto const& x = s.problem.experiments[e];
            same = s.fit.starts[e].size() == x.initial.size() &&
                   s.fit.residuals[e].size() == x.measurements.size();
        }
        wire_reader::require(same, "a fit of another problem");
    }

private:
    [[nodiscard]] std::vector<std::size_t> take_effects(wire_reader& in) const {
        std::vector<std::size_t> effects(in.count(8));
        for (auto& e : effects) e = static_cast<std::size_t>(in.below(effects_));
        return effects;
    }

    screening candidates_;
    std::size_t effects_;
};

[[nodiscard]] inline identity identity_of(identification_problem const& problem,
                                          std::vector<effect> const& catalogue, std::string also) {
    for (auto const& e : catalogue) also += "\n" + e.name;
    return {{{"problem", problem_digest(problem, {}, also),
              "give all ranks the same command and the same data"}}};
}

} // namespace diagnose_detail

/// `sivid::diagnose` with the fits of candidates - the model itself, single effects, pairs - shared
/// with others, who call `help_diagnose` for the same problem and catalogue; this process fits,
/// too. What follows from the fits is proved here.
/// @guarantee  what `sivid::diagnose` returns, bit for bit, unless the time ends it
/// @param others  are referred to
/// @param also    what else must be the same there
/// @param spent   receives what handing out took, if given
/// @throws what `cluster::identify` throws
[[nodiscard]] inline diagnosis_run diagnose(transport& others,
                                            identification_problem const& problem,
                                            std::vector<effect> const& catalogue,
                                            diagnosis_options options, std::string const& also = {},
                                            traffic* spent = nullptr) {
    using namespace diagnose_detail;
    released_at_end idle(others);
    candidate_server const here(problem, catalogue);
    working_coordinator all(others, {}, diagnose_detail::identity_of(problem, catalogue, also),
                            [&here](worker& self, std::string_view request) {
                                return here.answer(request, [&self] { return self.wanted(); });
                            });
    idle.work_has_come();
    options.screening.fit_elsewhere = [&](std::vector<wanted_fit> const& wanted,
                                          std::function<bool()> const& go_on) {
        std::vector<worker_pool::task> tasks;
        for (auto const& w : wanted) {
            tasks.push_back({[&w](std::size_t) {
                wire_writer out;
                put(out, w.effects);
                out.put(w.part != nullptr);
                if (w.part != nullptr) {
                    put(out, w.part->figures.effects);
                    put(out, w.part->fit);
                }
                return out.take();
            }});
        }
        worker_pool::manner how;
        how.ahead = 1; // fits take from a tenth of a second to a minute
        auto const said = all.helpers().ask(tasks, go_on, how);
        std::vector<std::optional<made_fit>> made(said.size());
        for (std::size_t k = 0; k < said.size(); ++k) {
            if (!said[k]) continue;
            wire_reader in(said[k]->body);
            made[k].emplace();
            made[k]->fit = take_fit(in);
            made[k]->silent = in.flag();
            made[k]->cut_short = said[k]->cut_short;
            in.finish();
        }
        return made;
    };
    auto run = sivid::diagnose(problem, catalogue, std::move(options));
    if (spent != nullptr) *spent = all.helpers().traffic();
    return run;
}

/// Fits candidates for the one who diagnoses this problem, until the diagnosis is over.
/// @throws wire_error  for a message that cannot be read
inline void help_diagnose(transport& coordinator, identification_problem const& problem,
                          std::vector<effect> const& catalogue, std::string const& also = {}) {
    diagnose_detail::candidate_server const candidates(problem, catalogue);
    worker self(coordinator, identity_of_program());
    self.serve(
        {[&](std::string_view) { return diagnose_detail::identity_of(problem, catalogue, also); },
         [&](std::string_view request) {
             return candidates.answer(request, [&self] { return self.wanted(); });
         }});
}

} // namespace sivid::cluster

#endif
