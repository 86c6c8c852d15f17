// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSIS_HPP
#define SIVID_DIAGNOSIS_DIAGNOSIS_HPP

#include <sivid/approximate/candidate/candidate.hpp>
#include <sivid/model/change/changed_formulas.hpp>
#include <sivid/model/prior_end.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/run/run_reach.hpp>
#include <sivid/paving/strategy/contractor.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// Whether some parameter explains the data used for fitting.
enum class gap_verdict {
    none,      ///< proved: one does
    certified, ///< proved: none in the prior does
    undecided
};
[[nodiscard]] constexpr std::string_view to_string(gap_verdict v) {
    return v == gap_verdict::none        ? "none"
           : v == gap_verdict::certified ? "certified"
                                         : "undecided";
}

/// The factor by which all measurement bounds must grow until some parameter explains the data:
///   \f$ \lambda^* = \min_{p, x_0} \max_s \f$ (the (q_s+1)-th largest |y - m|/e in scenario s).
/// As [lower, upper], both proved; upper is infinite where nothing is known.
using inflation_range = interval;

/// Nothing is known of an inflation but that it is not negative.
[[nodiscard]] inline inflation_range unknown_inflation() {
    return interval_traits<interval>::bounds(0, std::numeric_limits<double>::infinity());
}

/// The share of a gap that an effect removes, \f$ 1 - \max(0, after - 1) / \max(0, before - 1) \f$.
/// @returns nothing where there is no gap to shrink (before.upper <= 1); the lower bound is
///          -infinity where `before` may be 1, or `after` is unbounded
[[nodiscard]] inline std::optional<interval> shrink(inflation_range const& before,
                                                    inflation_range const& after) {
    using traits = interval_traits<interval>;
    if (!(before.upper() > 1)) return std::nullopt;
    auto const excess = [](double x, bool up) {
        if (!(x > 1)) return 0.0;
        auto const d = traits::sub(traits::point(x), traits::point(1.0));
        return up ? d.upper() : d.lower();
    };
    auto const infinity = std::numeric_limits<double>::infinity();
    // Smallest and largest quotient of the excesses.
    double most = infinity;
    double const gap_low = excess(before.lower(), false);
    bool undefined = false;
    if (gap_low > 0 && after.upper() < infinity) {
        most = traits::div(traits::point(excess(after.upper(), true)), traits::point(gap_low),
                           undefined)
                   .upper();
    }
    double least = 0;
    if (before.upper() < infinity) {
        least = traits::div(traits::point(excess(after.lower(), false)),
                            traits::point(excess(before.upper(), true)), undefined)
                    .lower();
    }
    auto const quotient = traits::bounds(std::max(0.0, least), most);
    return traits::sub(traits::point(1.0), quotient);
}

/// A stretch of a scenario.
struct time_window {
    std::string scenario;
    double from = 0, to = 0; ///< [time]
};

/// A proof that an equation and sensors cannot hold together, whatever the parameters, if the
/// assumptions hold.
struct broken_relation_report {
    std::string equation;
    std::vector<std::string> sensors;
    bool proved = false;
    std::vector<std::string> assumptions;
    std::vector<time_window> windows;
    bool definition =
        false; ///< no constant acts in the equation: the sensors contradict each other
};

/// A place where model and robot disagree.
struct suspected_place {
    std::string kind; ///< equation, sensor or input
    std::string name;
    bool proved = false; ///< the equation is broken, whatever a sensor does within the assumptions
    time_window where;
    std::optional<interval> missing; ///< proved bounds of the mean missing rate there, without 0
    std::optional<double> estimate;  ///< the same or a sensor's fault, estimated, of that window
    std::string unit;
    std::string law;    ///< the shape of what is missing; empty when none stands out
    std::string regime; ///< where it acts; empty when everywhere
    std::vector<std::string> alternatives{}; ///< places that explain as much
    std::vector<std::string> assumptions{};  ///< that `proved` and `missing` rest on
};

enum class cause_verdict {
    explains, ///< proved, with a witness
    excluded, ///< proved over the prior of the effect's parameters
    undecided
};
[[nodiscard]] constexpr std::string_view to_string(cause_verdict v) {
    return v == cause_verdict::explains   ? "explains"
           : v == cause_verdict::excluded ? "excluded"
                                          : "undecided";
}

/// A number with a name, and what is known of it.
struct named_estimate {
    std::string name;
    std::string unit;
    double value = 0;                ///< of the fit, or of the witness in a `named_witness`
    std::optional<interval> hull{};  ///< proved to contain every value that explains the data
    std::optional<interval> prior{}; ///< what was allowed
};

/// A product of powers of constants, or a sum of them, of which the data tell more than of its
/// parts.
struct named_combination {
    struct part {
        std::string name;
        int number = 1; ///< exponent; 1 or -1 in a sum
        bool operator==(part const&) const = default;
    };
    named_estimate about; ///< its name is a formula, for instance "k/Iz"; its prior that of all
    std::vector<part> parts;
    bool is_sum = false;
    bool of_effects = false; ///< a parameter of an effect is among the parts
};

/// A constant at the end of its prior: what lies beyond was not looked at.
struct constant_at_end {
    std::vector<std::string> effects; ///< of the model whose constant it is; none: as it is
    named_estimate constant;          ///< with its prior
    prior_end end = prior_end::none;
};

/// What parameters and starts were verified.
struct named_witness {
    std::vector<named_estimate> parameters;
    struct start {
        std::string scenario;
        std::vector<named_estimate> states;
    };
    std::vector<start> starts;
};

/// How error bounds of one channel have to grow where what it shows is large, or changes fast.
struct noise_growth {
    enum class with { value, rate };
    with what = with::value;
    /// The least c >= 0 with which bounds e + c |y|, or e + c |dy/dt|, let a parameter explain all
    /// data; y is the output at the fit `shown`, numbers like any, and what is less than a
    /// millionth of the largest counts as 0. Both ends are proved. A channel whose time stamps are
    /// off by up to c has about such errors.
    interval coefficient{0.0};
    /// By how much likelier uniform noise within these bounds is than noise within the bounds that
    /// are so many times as wide (`confined_gap::factor`): natural logarithm, of fits.
    double likelier = 0;
    named_witness witness{}; ///< a validated run proves `coefficient.upper()` there
    named_witness shown{};   ///< the fit whose outputs the bounds grow with; not proved
    std::string unit = "1";  ///< of c: with the rate the model's unit of time
};

/// Errors of a channel that go together instead of being drawn one by one: a slow disturbance of
/// the instrument, or an effect on it. An estimate.
struct error_correlation {
    double of_neighbours = 0; ///< correlation of each error with the next one
    double seconds = 0;       ///< in which it falls to 1/e, in `unit`, the model's unit of time
    std::string unit = "s";
};

/// Readings that are too coarse for their error bounds: whole multiples of a step. With half a step
/// more (rounded), or a whole one (cut off), the bounds of the channel explain all data; proved.
struct reading_steps {
    double size = 0;
    std::string unit{};
    bool cut_off = false; ///< half a step more is not enough
};

/// Measurements that alone stand against the model: one parameter of the prior explains all the
/// others, and these, too, once their error bounds grow.
struct confined_gap {
    std::string channel{};                ///< empty: every channel
    std::vector<std::string> scenarios{}; ///< none: every scenario
    /// The least factor by which the bounds of these measurements alone must grow until a parameter
    /// explains all data; both ends are proved.
    inflation_range factor = unknown_inflation();
    named_witness witness{}; ///< a validated run proves `factor.upper()` there
    std::vector<std::string> assumptions{};
    std::optional<noise_growth> grows{};           ///< where that is much likelier, of a channel
    std::optional<error_correlation> correlated{}; ///< where that is clear, of a channel
    /// Where these explain it, of a channel; then neither of the two above is asked for.
    std::optional<reading_steps> steps{};
};

/// How well hold-out data are met, before and after an effect is joined.
struct holdout_figures {
    inflation_range inflation_before = unknown_inflation();
    inflation_range inflation_after = unknown_inflation();
    /// The same over all parameters that explain the fit data; where none is known to, over all
    /// that do as well on these as the witness.
    std::optional<inflation_range> over_fits_before, over_fits_after;
    std::vector<std::string> channels;
    std::vector<double> rmse_before, rmse_after;  ///< one per channel
    double covered_before = 0, covered_after = 0; ///< share of samples inside the predicted tube
    double width_before = 0, width_after = 0;     ///< mean width of that tube, in error bounds
};

/// One candidate: effects that might be what the model leaves out.
struct cause {
    std::vector<std::string> effects;
    cause_verdict verdict = cause_verdict::undecided;
    inflation_range inflation = unknown_inflation();
    double fitted_inflation = 0; ///< of the best fit found; not proved
    double score = 0;            ///< 3 sum of squares + k ln N of the fit: less is likelier
    std::vector<named_estimate> parameters; ///< of the effects
    std::optional<named_witness> witness;   ///< a validated run proves `inflation.upper()` there
    std::vector<std::string> assumptions;
    std::optional<holdout_figures> holdout;
    std::vector<std::string> untouched{}; ///< refuted equations that it leaves as they are
    std::string excluded_by{}; ///< the refuted equation that excludes it; empty: its whole prior
    /// When the effect begins, by scenario, where it does so later than some of them: the values
    /// explain the data. `hull`: proved, whenever it begins in the others; `prior`: all the
    /// scenario.
    std::vector<named_estimate> onsets{};
    std::vector<named_estimate> ends{}; ///< the same of when it ends
};

enum class answer_kind {
    none,        ///< the model needs no effect
    effects,     ///< these effects explain the data
    unexplained, ///< every candidate of the plan was tried and none explains them
    open         ///< none of those that were tried explains them; some of the plan were not
};
[[nodiscard]] constexpr std::string_view to_string(answer_kind k) {
    return k == answer_kind::none          ? "none"
           : k == answer_kind::effects     ? "effects"
           : k == answer_kind::unexplained ? "unexplained"
                                           : "open";
}

/// How large an unknown function of time beside one equation must be for the model as it is to
/// explain the data (`least_disturbance`).
struct needed_disturbance {
    std::string equation, unit; ///< unit: of its rate
    interval size{0.0};         ///< contains the least one; proved, its upper end by a witness
    /// Proved: disturbances up to the upper size that explain the data reach the lower one
    /// somewhere in these.
    std::vector<time_window> reached;
    std::vector<time_window> strongest; ///< where the witness has nearly its size; others may not
    std::string regime;                 ///< of what is missing in the equation, an estimate; or ""
    double seconds = 0;                 ///< of work that it might take
};

/// What is left of a gap with the candidate that comes closest, when none explains the data.
struct unexplained_remainder {
    std::vector<std::string> effects; ///< of that candidate
    inflation_range inflation = unknown_inflation();
    std::vector<suspected_place> where; ///< of the model with these effects; estimates
    /// Of the model as it is, each equation disturbed alone.
    std::vector<needed_disturbance> disturbances{};
};

/// A manoeuvre that would tell candidates apart.
struct next_experiment {
    std::string manoeuvre;
    std::vector<named_estimate> settings; ///< of a manoeuvre that was optimised
    double separation = 0; ///< predicted: largest difference of the outputs in error bounds
    bool recorded = false; ///< one of the manoeuvres at hand, made again with finer bounds
};

/// A claim that something else in the same diagnosis contradicts, or did.
struct withdrawn_claim {
    std::string claim, reason;
};

/// Where model and robot disagree, which effect it is, and how far the gap shrinks.
/// Everything that is called proved, certified, excluded or explained is a theorem under the
/// assumptions listed; the rest is an estimate.
struct diagnosis {
    std::string time_unit = "s"; ///< the model's
    gap_verdict gap = gap_verdict::undecided;
    inflation_range inflation = unknown_inflation();
    std::optional<named_witness> witness; ///< a validated run proves `inflation.upper()` there
    std::vector<named_estimate> scenario_inflation, channel_inflation;
    std::vector<confined_gap> confined; ///< parts of the data that alone stand against the model
    std::vector<run_reach> reach;       ///< where the gap is undecided: what holds runs back
    contraction_journal journal{};      ///< what was tried to bound the answer's parameters
    std::vector<broken_relation_report> relations;
    std::vector<suspected_place> where; ///< most important first
    std::vector<cause> causes;          ///< best first
    answer_kind answer = answer_kind::none;
    tried_candidates tried;
    std::vector<std::string> effects; ///< the answer
    changed_formulas change{};        ///< that it makes to the model, for a simulator
    /// Every constant of the model with the answer's effects (of the closest candidate where none
    /// explains the data): the values of the verified witness where there is one, else of the fit.
    std::vector<named_estimate> constants;
    std::vector<named_combination> combinations{}; ///< of constants; with hulls
    bool constants_verified = false;      ///< they are a witness that explains the data (proved)
    std::vector<constant_at_end> at_ends; ///< of the answer, and of the model as it is
    std::vector<std::vector<std::string>> indistinguishable;
    std::vector<std::string> unobservable; ///< effects that these channels and scenarios never show
    std::optional<interval> shrink_fit, shrink_holdout;
    /// That on held-out data, whatever parameters of the answer explain the fit data.
    std::optional<interval> shrink_over_fits;
    std::optional<unexplained_remainder> remainder; ///< of an unexplained gap
    std::optional<next_experiment> next;
    std::vector<std::string> assumptions; ///< all that anything proved rests on
    std::vector<withdrawn_claim> withdrawn;
    double seconds = 0;
    bool by_clock = false; ///< as in `identification`
    bool interrupted = false;
};

} // namespace sivid

#endif
