// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_DIAGNOSE_HPP
#define SIVID_CLUSTER_DIAGNOSE_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/packing.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace boost::serialization {

template <class Archive>
void serialize(Archive& a, sivid::approximate_fit& fit, unsigned) {
    a& fit.parameters& fit.inflation& fit.squares& fit.starts& fit.residuals;
}

} // namespace boost::serialization

namespace sivid::cluster {

namespace diagnose_detail {

/// A fit that is wanted: of these effects, from that of a part of them, if there is one.
struct fit_request {
    std::vector<std::size_t> effects;
    bool from_part = false;
    std::vector<std::size_t> part;
    approximate_fit fit;

    template <class Archive>
    void serialize(Archive& a, unsigned) {
        a& effects& from_part& part& fit;
    }
};

/// Fits candidates as they are asked for.
class candidate_server {
public:
    candidate_server(identification_problem const& base, std::vector<effect> const& catalogue)
        : candidates_(base, catalogue), effects_(candidates_.catalogue().size()) {}

    /// @returns  packed: the fit, and whether the candidate is silent
    /// @throws std::invalid_argument  for effects or a fit of something else
    [[nodiscard]] std::string answer(std::string_view request,
                                     std::function<bool()> const& wanted) const {
        auto const asked = unpacker(request).take<fit_request>();
        require_known(asked.effects);
        require_known(asked.part);
        wanted_fit w{asked.effects};
        std::optional<screened> part;
        if (asked.from_part) {
            part = candidates_.posed(asked.part);
            part->fit = asked.fit;
            require_fit_of(*part);
            w.part = &*part;
        }
        auto const made = candidates_.make(w, wanted);
        return packed(made.fit, made.silent);
    }

private:
    void require_known(std::vector<std::size_t> const& effects) const {
        for (auto const e : effects)
            if (e >= effects_) throw std::invalid_argument("an effect that no catalogue has");
    }
    static void require_fit_of(screened const& s) {
        bool same = s.fit.parameters.size() == s.problem.prior.size() &&
                    s.fit.starts.size() == s.problem.experiments.size() &&
                    s.fit.residuals.size() == s.problem.experiments.size();
        for (std::size_t e = 0; same && e < s.problem.experiments.size(); ++e) {
            auto const& x = s.problem.experiments[e];
            same = s.fit.starts[e].size() == x.initial.size() &&
                   s.fit.residuals[e].size() == x.measurements.size();
        }
        if (!same) throw std::invalid_argument("a fit of another problem");
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
                fit_request r{w.effects, w.part != nullptr, {}, {}};
                if (w.part != nullptr) {
                    r.part = w.part->figures.effects;
                    r.fit = w.part->fit;
                }
                return packed(r);
            }});
        }
        worker_pool::manner how;
        how.ahead = 1; // fits take from a tenth of a second to a minute
        auto const said = all.helpers().ask(tasks, go_on, how);
        std::vector<std::optional<made_fit>> made(said.size());
        for (std::size_t k = 0; k < said.size(); ++k) {
            if (!said[k]) continue;
            unpacker in(said[k]->body);
            made[k].emplace();
            made[k]->fit = in.take<approximate_fit>();
            made[k]->silent = in.take<bool>();
            made[k]->cut_short = said[k]->cut_short;
        }
        return made;
    };
    auto run = sivid::diagnose(problem, catalogue, std::move(options));
    if (spent != nullptr) *spent = all.helpers().traffic();
    return run;
}

/// Fits candidates for the one who diagnoses this problem, until the diagnosis is over.
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
