// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_CONTRACTOR_HPP
#define SIVID_PAVING_STRATEGY_CONTRACTOR_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

class inquiry;

/// Contains every parameter that explains the data, and for each experiment every start from which
/// one does.
struct leftover {
    box parameters;            ///< empty sides: proved, there is none
    std::vector<box> starts{}; ///< of each experiment; no entry: nothing new is known of starts
};

/// One line of the journal: what was tried before a search, why, and what came of it.
struct contraction_record {
    enum class outcome {
        gained,
        idle,           ///< it removed nothing
        not_applicable, ///< it was not asked: `why` says why not
        cut_short       ///< its time ended before it removed anything
    };

    std::string by;  ///< `contractor::name`
    std::string why; ///< "runs over what is left reach 12 % of the measurements"
    outcome how = outcome::idle;
    double left = 1; ///< share of the volume of parameters that it was given, at most
    std::size_t integrations = 0;
    double seconds = 0;
    /// What else it did, by name: {"longest window", 1.7}.
    std::vector<std::pair<std::string, double>> figures{};

    /// 0 where there is none of the name.
    [[nodiscard]] double figure(std::string_view name) const {
        for (auto const& [its, value] : figures)
            if (its == name) return value;
        return 0;
    }
    [[nodiscard]] bool asked() const { return how != outcome::not_applicable; }
};
using contraction_journal = std::vector<contraction_record>;

/// Adds what was tried in a further search: one line for each contractor, over all searches.
///   `left` is the least of all, `why` that of the first search in which it was asked.
inline void add(contraction_journal& journal, contraction_journal const& more) {
    using outcome = contraction_record::outcome;
    for (auto const& r : more) {
        auto const line = std::ranges::find(journal, r.by, &contraction_record::by);
        if (line == journal.end()) {
            journal.push_back(r);
        } else if (!line->asked()) {
            *line = r;
        } else if (r.asked()) {
            if (r.how == outcome::gained) line->how = outcome::gained;
            line->left = std::min(line->left, r.left);
            line->integrations += r.integrations;
            line->seconds += r.seconds;
        }
    }
}

[[nodiscard]] constexpr std::string_view to_string(contraction_record::outcome how) {
    using outcome = contraction_record::outcome;
    return how == outcome::gained           ? "gained"
           : how == outcome::idle           ? "idle"
           : how == outcome::not_applicable ? "not applicable"
                                            : "cut short";
}

/// What makes a problem smaller before it is searched, or while it is: a box of parameters and
/// starts in, a smaller one out. Contractors are sound in any order and as often as they are asked.
/// `contains_truth` tests one of your own.
class contractor {
public:
    contractor() = default;
    contractor(contractor const&) = delete;
    contractor& operator=(contractor const&) = delete;
    virtual ~contractor() = default;

    [[nodiscard]] virtual std::string name() const = 0;
    /// Why it has nothing to say of a problem ("the model has delays"); empty: it may have.
    [[nodiscard]] virtual std::string obstacle(identification_problem const&) const { return {}; }
    /// @param asked  its `problem()` has what is left as prior and as starts
    /// @param limit  once it is false, what is proved until then is returned
    /// @param says   receives integrations and figures
    /// @guarantee  keeps every parameter, and every start, that explains the data
    [[nodiscard]] virtual leftover operator()(inquiry& asked, work_limit const& limit,
                                              contraction_record& says) const = 0;

    /// The same, but for contractors of a name among those that it asks in turn; null: it asks
    /// none.
    [[nodiscard]] virtual std::shared_ptr<contractor const> without(std::string_view) const {
        return nullptr;
    }

    /// Tests a part of a prior: outside, or what is left of it; for any thread.
    using part_test = std::function<assessment<>(box const&)>;
    /// The same for the parts of a search, which are many: quick, or nothing.
    /// @param problem  outlives what is returned
    [[nodiscard]] virtual part_test for_parts(identification_problem const& problem,
                                              std::function<bool()> const& keep_going) const {
        static_cast<void>(problem), static_cast<void>(keep_going);
        return nullptr;
    }
};

} // namespace sivid

#endif
