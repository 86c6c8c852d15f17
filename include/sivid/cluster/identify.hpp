// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_IDENTIFY_HPP
#define SIVID_CLUSTER_IDENTIFY_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/cluster/box_server.hpp>
#include <sivid/cluster/detail/delegated_test.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/packing.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::cluster {

/// Inverts with the help of others who have the same test (`box_server`).
/// @guarantee  what `invert` with the test itself returns, bit for bit
/// @throws what `worker_pool::ask` throws
template <batch_set_test Test>
[[nodiscard]] inversion invert(worker_pool& helpers, Test& test, box const& prior,
                               inversion_options const& options) {
    delegated_test<Test> handed_out(helpers, test);
    return sivid::invert(handed_out, prior, options);
}

namespace identify_detail {

/// What a worker has to know of a search.
struct search_setting {
    std::vector<std::size_t> outliers; ///< that experiments may have
    bool fitted = false;
    std::vector<double> fit;
    std::vector<std::vector<double>> fitted_starts;
    bool narrowed = false; ///< contractors were asked before; what they left
    box rest;
    std::vector<box> starts;

    template <class Archive>
    void serialize(Archive& a, unsigned) {
        a& outliers& fitted& fit& fitted_starts& narrowed& rest& starts;
    }
};

[[nodiscard]] inline search_setting setting_of(identification_problem const& problem,
                                               std::optional<approximate_fit> const& fit,
                                               std::optional<leftover> const& left) {
    search_setting s;
    for (auto const& e : problem.experiments) s.outliers.push_back(e.outliers);
    s.fitted = fit.has_value();
    if (fit) {
        s.fit = fit->parameters;
        s.fitted_starts = fit->starts;
    }
    s.narrowed = left.has_value();
    if (left) {
        s.rest = left->parameters;
        s.starts = left->starts;
    }
    return s;
}

[[nodiscard]] inline identity identity_of(identification_problem const& problem,
                                          identify_options const& options,
                                          std::string const& also) {
    return {{{"problem", problem_digest(problem, options, also),
              "give all ranks the same command and the same data"}}};
}

/// The test of a search on another machine.
class search_server {
public:
    search_server(identification_problem problem, identify_options options, std::string also)
        : problem_(std::move(problem)), options_(std::move(options)), also_(std::move(also)) {}

    /// Makes the test as `about` says.
    [[nodiscard]] identity take_up(std::string_view about) {
        auto who = identity_of(problem_, options_, also_);
        unpacker in(about);
        // Of another problem nothing else can be read; the coordinator will refuse this one.
        if (in.take<identity>().differing(who) != nullptr) return who;
        auto const setting = in.take<search_setting>();
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e)
            problem_.experiments[e].outliers = setting.outliers.at(e);
        auto const map =
            options_.test.contract ? coordinates_of(problem_) : std::optional<reduction>{};
        asked_.emplace(map ? map->problem() : problem_, options_.test, options_.search,
                       work_limit(0.0));
        std::optional<approximate_fit> fit;
        if (setting.fitted) {
            fit.emplace();
            fit->parameters = setting.fit;
            fit->starts = setting.fitted_starts;
        }
        auto const& prior = asked_->whole().prior;
        if (setting.narrowed) asked_->narrow({setting.rest, setting.starts});
        if (fit) {
            auto const point = point_box(fit->parameters);
            asked_->propose(*fit, map ? map->forward(point) : point);
        }
        boxes_.emplace(asked_->search_test(), prior);
        return who;
    }
    [[nodiscard]] std::string answer(std::string_view request) { return (*boxes_)(request); }

private:
    identification_problem problem_;
    identify_options options_;
    std::string also_;
    std::optional<inquiry> asked_;
    std::optional<box_server<feasibility_test>> boxes_;
};

} // namespace identify_detail

/// `sivid::identify` with the box search shared with others, who call `help_identify` for the same
/// problem and options; this process works, too, in a thread of its own. What comes before the
/// search and what completes the result are done here alone.
/// @guarantee  what `sivid::identify` returns, bit for bit, whoever helps and however many; budgets
///             and `keep_going` end the work of all. A resumed search may have others than before
/// @param others  are referred to
/// @param also    what else must be the same there: the digest of a data set, say
/// @param spent   receives what handing out took, if given
/// @throws worker_mismatch       when a worker runs another program, or has another problem
/// @throws std::runtime_error  for what a worker reports
/// @throws what `sivid::identify` throws; the others are let go in any case
[[nodiscard]] inline identification identify(transport& others,
                                             identification_problem const& problem,
                                             identify_options options, std::string const& also = {},
                                             traffic* spent = nullptr) {
    released_at_end idle(others);
    auto const mine = identify_detail::identity_of(problem, options, also);
    options.invert_by = [&](feasibility_test& test, box const& prior,
                            inversion_options const& search,
                            std::optional<approximate_fit> const& fit,
                            std::optional<leftover> const& left) {
        if (left && is_empty(left->parameters)) return sivid::invert(test, prior, search);
        box_server<feasibility_test> boxes(test, prior);
        working_coordinator all(
            others, packed(mine, identify_detail::setting_of(problem, fit, left)), mine,
            [&boxes](worker&, std::string_view request) { return boxes(request); });
        idle.work_has_come();
        auto found = cluster::invert(all.helpers(), test, prior, search);
        if (spent != nullptr) *spent = all.helpers().traffic();
        return found;
    };
    return sivid::identify(problem, std::move(options));
}

/// Works for the one who identifies this problem, until the search is over.
inline void help_identify(transport& coordinator, identification_problem const& problem,
                          identify_options options, std::string const& also = {}) {
    worker self(coordinator, identity_of_program());
    options.test = limited(std::move(options.test), [&self] { return self.wanted(); });
    identify_detail::search_server server(problem, std::move(options), also);
    self.serve({[&server](std::string_view about) { return server.take_up(about); },
                [&server](std::string_view request) { return server.answer(request); }});
}

} // namespace sivid::cluster

#endif
