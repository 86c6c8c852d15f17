// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_CLASS_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_CLASS_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/series/detail/expansion_tail.hpp>
#include <sivid/enclosure/series/detail/power_sum.hpp>
#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/series/domain_edge.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/enclosure/step/detail/kink_steps.hpp>
#include <sivid/enclosure/step/detail/step_length.hpp>
#include <sivid/enclosure/step/perturbed_step.hpp>
#include <sivid/model/series/detail/twofold_arithmetic.hpp>
#include <sivid/model/series/taylor_arithmetic.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// The centre of a set follows the Taylor series of the solution.
struct taylor_centre {
    static constexpr bool by_formula = false;
    template <class Shape>
    taylor_centre(flow const&, enclosure_options const&, Shape const&, Shape const&) {}

    [[nodiscard]] static enclosure_options const& fit(enclosure_options const& options) {
        return options;
    }
};

/// Carries a family of trajectories as Taylor models in its unknowns (see `parametric_set`), one
/// proved step at a time. Stays tight over boxes in which first-order sets blow up.
///
/// One step from t over h, with s in [0,h], E the reach, \f$ x_k, V_k \f$ the Taylor coefficients
/// in time of the solution through P(q) and of the flow's derivative there (the latter over \f$
/// P(q) \pm E \f$), K and L their orders, and b(q, s) a tube:
///   centre  \f$ x(s; P) \in \sum_{k \le K} s^k x_k + s^{K+1} x_{K+1}(b) \f$
///   flow    \f$ V(s) \in \sum_{k<L} s^k V_k + s^L J_L(b) (1 + [-W, W]) \f$
/// and the tube is proved when both images lie strictly inside it. Smooth steps are first tried
/// without a tube, with what both series leave out from `expansion_tail`. Inputs with error bounds:
/// the step is that of the recorded inputs, and what the others may add (see `perturbed_step`) goes
/// into the generators.
///
/// Where nothing is unknown (a point) and roundings would cost more than the truncation that is
/// asked for, the centre is kept in twice the digits, and so are the lowest orders of its series:
/// see `sharpen`.
///
/// With lanes, W families advance together, each at its own time and with its own step. No lane's
/// proof rests on another; shared are orders, the choice of generators to keep, and which of
/// several bounds is evaluated.
/// @guarantee  after each successful step, for every q and every member of the set before, the
///             solution lies in the set after (same q), and during the step in `swept()`.
/// @tparam Model   of single families, or in lanes
/// @tparam Centre  what it follows: the series above, or a formula (`runge_kutta_centre`)
/// @cost  O(nodes K^2 products of degree D in N variables) a step, as many in N + 1 variables where
///        it needs a tube
/// @ref   Makino and Berz 2003 (Taylor models for flows); Kühn 1998 (zonotopes); Zgliczynski 2002
/// (C1)
template <class Model = taylor_model<double>, class Centre = taylor_centre>
class parametric_flow {
public:
    using C = typename Model::scalar;
    using set_type = parametric_set<Model>;
    using polynomial = Model;
    using column_entry = Model;
    using tube_entry = Model;
    using shape_type = typename Model::shape_type;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    static constexpr std::size_t width = side_by_side::count;

    /// @param variables  at least as many as the unknowns
    /// @param degree     of the polynomials
    parametric_flow(flow const& f, enclosure_options const& options, std::size_t variables,
                    std::size_t degree)
        : flow_(&f),
          options_(Centre::fit(options)),
          shape_(&shape_type::of(variables, degree)),
          column_shape_(&shape_type::of(variables, (degree + 1) / 2)),
          // A formula's local error is that of a difference, which varies within the step.
          tube_shape_(&shape_type::of(variables + 1, degree >= 5                         ? 3
                                                     : degree >= 2 || Centre::by_formula ? 2
                                                                                         : 1)),
          path_of_(*shape_, *tube_shape_),
          method_(f, options_, *shape_, *tube_shape_),
          set_(f.states(), *shape_),
          centre_(f, options_.order + 1, variations::by_state, *shape_),
          derivative_(f, options_.order + 1, variations::by_state, *column_shape_),
          tube_(f, options_.order + 1, variations::by_state, *tube_shape_),
          centre_tail_(f, centre_),
          derivative_tail_(f, derivative_),
          observe_(f.observe(), 0, *shape_),
          parameters_(f.parameters(), Model(*shape_)),
          column_parameters_(f.parameters(), Model(*column_shape_)),
          tube_parameters_(f.parameters(), Model(*tube_shape_)),
          around_(f.states()),
          path_(f.states()),
          tube_box_(f.states()),
          swept_(f.states()),
          room_(f.states()),
          truncation_(f.states()) {
        if (options_.order < 1)
            throw std::invalid_argument("enclosure_options: order must be at least 1");
        if (f.uncertain()) perturbed_.emplace(f, *column_shape_);
        disturbed_.resize(f.states());
    }

    /// Starts the family of one lane; what the other lanes do goes on.
    /// @given  the unknowns have at most as many variables as the flow (checked)
    void begin(std::size_t lane, double time, box const& initial, box const& parameters);
    /// The same in the first, or only, lane.
    void begin(double time, box const& initial, box const& parameters) {
        begin(0, time, initial, parameters);
    }
    /// Goes on from what `set()` was at some step of the same family.
    /// @given  `begin` for that family (trusted)
    void resume(set_type const& set) requires(width == 1) {
        set_ = set;
        flow_order_ = std::max<std::size_t>(flow_order_, options_.order / 2); // one step is all
        stale_ = true;
    }
    /// Ends the family of a lane.
    void end(std::size_t lane) { running_ = running_ & !side_by_side::only(lane); }

    /// Tries one step in every lane that runs and is before its limit. A lane whose step was too
    /// long stays where it is, and will try a shorter one.
    /// @returns  the lanes that moved, none beyond its limit
    [[nodiscard]] mask advance(C const& limit);
    /// One proved step of the only lane, at most to `limit`.
    /// @throws std::invalid_argument when `limit` is not later than `time()`
    [[nodiscard]] bool step(double limit) requires(width == 1) {
        if constexpr (width == 1) { // clang before 16 instantiates it with the class of lanes, too
            if (!(limit > set_.time) && running_)
                throw std::invalid_argument("parametric_flow: a step must go forward, not to " +
                                            nearest_text(limit));
            while (running_) {
                if (advance(limit)) return true;
            }
        }
        return false;
    }

    [[nodiscard]] mask running() const { return running_; }
    [[nodiscard]] double time(std::size_t lane = 0) const {
        return side_by_side::get(set_.time, lane);
    }
    [[nodiscard]] set_type const& set() const { return set_; }
    /// About the largest |x_i| so far: what its errors are compared with.
    [[nodiscard]] C size(std::size_t i) const {
        return side_by_side::max(set_.largest[i], C(flow_->small(i)));
    }
    [[nodiscard]] normalised_unknowns const& unknowns(std::size_t lane = 0) const {
        return *lanes_[lane].unknowns;
    }
    [[nodiscard]] std::optional<enclosure_failure> const& failure(std::size_t lane = 0) const {
        return lanes_[lane].failure;
    }
    [[nodiscard]] std::size_t steps(std::size_t lane = 0) const { return lanes_[lane].steps; }
    /// Variables and degree of the polynomials.
    [[nodiscard]] shape_type const& shape() const { return *shape_; }
    /// Those of the tubes: one variable more, the time within a step.
    [[nodiscard]] shape_type const& tube_shape() const { return *tube_shape_; }
    /// \f$ h (1 + \tau) / 2 \f$, the time since the begin of a step, as a tube has it.
    [[nodiscard]] tube_entry within_step(C const& h) const {
        return tube_entry::variable(*tube_shape_, tube_shape_->variables - 1, h * 0.5, h * 0.5);
    }
    [[nodiscard]] flow const& equations() const { return *flow_; }
    /// The outputs at the lanes' times, as functions of the unknowns.
    [[nodiscard]] std::vector<polynomial> outputs();

    /// A box that contains all states of a lane during its last proved step; without sides before
    /// the first.
    [[nodiscard]] box swept(std::size_t lane = 0) const {
        box result(lanes_[lane].steps == 0 ? 0 : swept_.size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = range(lane_of(swept_[i], lane));
        return result;
    }
    /// The tubes of the last proved steps themselves: for each q and \f$ \tau \in [-1, 1] \f$, the
    /// last variable, the states at \f$ t + h (1 + \tau) / 2 \f$, where h is the step's length
    /// times 1 + 4 units.
    [[nodiscard]] std::vector<tube_entry> const& swept_models() const { return swept_; }

private:
    static constexpr double up = enclosure_detail::sum_up;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// n x n entries, one for each pair of states.
    using square = std::vector<C>;

    struct lane_state {
        std::optional<normalised_unknowns> unknowns;
        std::optional<enclosure_failure> failure;
        enclosure_failure why; ///< of the last rejected attempt
        std::size_t steps = 0;
        std::size_t attempts = 0; ///< since the last accepted step
        double proposed = 0;      ///< length that the coefficients suggested
        double next = 0;          ///< length to try
        double tried = 0;         ///< the last one tried since the last accepted step
        double learned = 1;
        bool free = false;      ///< neither the end of the interval nor `gentle` had a say in it
        bool held = false;      ///< by `gentle`
        bool rough = false;     ///< at a kink: the next attempt is of first order
        bool forced = false;    ///< the shortest step, although the coefficients suggest less
        bool root = false;      ///< the set touches one of 0
        bool cut = false;       ///< by a kink: the length says nothing about smooth steps
        double near = infinity; ///< about the longest step that the neighbourhood of a kink allows
        std::size_t crossing = 0; ///< steps of first order since the last smooth one
    };

    /// A state during a step of first order that the right-hand side holds between bounds.
    struct held_state {
        mask lanes{};
        C lower{}, upper{}; ///< at the end
    };

    [[nodiscard]] C allowed(std::size_t i) const {
        auto const& p = set_.centre[i];
        return size(i) * options_.tolerance +
               (p.spread() + set_.reach[i]) * options_.relative_tolerance;
    }
    /// What a step across a kink may lose: a small share of what the set spans, besides what is
    /// lost anyway since the slopes differ on its two sides.
    [[nodiscard]] C allowed_at_kink(std::size_t i) const {
        auto const& p = set_.centre[i];
        return size(i) * (options_.tolerance * 10) +
               (p.spread() + set_.reach[i]) * enclosure_detail::kink_share(options_);
    }
    [[nodiscard]] double shortest(std::size_t lane) const {
        auto const& l = lanes_[lane];
        return enclosure_detail::shortest_step(
            options_, l.cut && l.crossing < enclosure_detail::crossing_steps);
    }
    void expand(std::size_t order);
    void expand_flow(std::size_t flow_order);
    [[nodiscard]] std::pair<double, std::size_t> estimate(std::size_t lane) const;
    [[nodiscard]] double propose(std::size_t lane, double rest) const;
    [[nodiscard]] double gentle(std::size_t lane, double h) const;
    void adapt_order(mask moved, C const& h, bool clamped);
    void adapt_flow_order(mask moved, std::size_t order, std::size_t flow_order,
                          std::vector<C> const& added);
    [[nodiscard]] mask useful(mask lanes);
    void guess_tube(C const& h, std::size_t order);
    /// Bounds what the series of a step over h leave out from the sizes of their coefficients:
    /// `truncation_`, and |V| beyond the terms below `flow_order` in `derivative_tail_`.
    /// @returns the lanes in which that is proved
    [[nodiscard]] mask bound_tails(C const& h, std::size_t order, std::size_t flow_order);
    /// The lanes of `trying` whose truncation is small enough.
    /// @param slopes  at kinks: h |df_i/dx_c| over the step; empty where no derivative exists
    [[nodiscard]] mask short_enough(mask trying, C const& h, std::size_t order,
                                    std::vector<C> const& truncation, square const& slopes);
    [[nodiscard]] mask carries_well(mask trying, C const& h, std::size_t flow_order);
    /// @returns the lanes of `trying` whose step to `to` is proved
    [[nodiscard]] mask attempt(mask trying, C const& to, std::size_t order, std::size_t flow_order,
                               square& w, mask& jumps);
    /// Of a step of first order: bounds of the states that their own rates hold.
    void hold_states(mask trying, C const& h, tube_entry const& times);
    /// Gives them these bounds.
    void release_states(mask moved, std::vector<polynomial>& next, std::vector<C>& lost);
    void accept(mask moved, C const& to, std::size_t order, std::size_t flow_order, square const& w,
                mask jumps);
    /// How many of the centre's lowest orders are worth twice the digits; a preference.
    [[nodiscard]] std::size_t sharp_orders(C const& length, std::size_t order) const;
    /// Expands the centre of a point in twice the digits, up to `orders` - 1.
    /// @returns whether that is possible
    [[nodiscard]] bool expand_sharply(std::size_t orders);
    /// One state at the end of the step, from the sharp coefficients below `orders` and the others
    /// up to `top`. Writes `next` where that is tighter.
    /// @param beyond  bound of what the series leaves out
    /// @returns what the state has beyond the constant of `next`
    template <class Coefficient>
    [[nodiscard]] C sharpen(std::size_t i, Coefficient const& coefficient, std::size_t top,
                            C const& to, std::size_t orders, C const& beyond, polynomial& next);
    /// A formula: whether its value is proved, and loses what is allowed, where the tube is.
    /// @param w  of the tube
    [[nodiscard]] bool apply_formula(C const& to, square const& w);
    /// Uncertain inputs: the lanes of a proved step for which their share is bounded as well.
    [[nodiscard]] mask perturb(mask moved, C const& to);
    /// The next attempts of these lanes are of first order; those of a formula are shorter.
    void meet_kink(mask lanes);
    void reject(mask lanes, failure_reason reason, C const& shorten);
    void fail(std::size_t lane, enclosure_failure why) {
        complete(why, set_, lane, *lanes_[lane].unknowns);
        lanes_[lane].failure = why;
        running_ = running_ & !side_by_side::only(lane);
    }
    /// What is not defined for some states of a lane.
    template <class Entry>
    [[nodiscard]] std::optional<domain_edge> edge(std::size_t lane, Entry const& times,
                                                  std::vector<Entry> const& x,
                                                  std::vector<Entry> const& p) const;
    /// Notes for the lanes the state whose row of a matrix is largest.
    void note_steepest(mask lanes, square const& m);

    flow const* flow_;
    enclosure_options options_;
    shape_type const *shape_, *column_shape_, *tube_shape_;
    polynomials_in_time<C> path_of_;
    Centre method_;
    set_type set_;
    expansion<polynomial> centre_;
    expansion<column_entry> derivative_;
    expansion<tube_entry> tube_;
    expansion_tail<polynomial> centre_tail_;
    expansion_tail<column_entry> derivative_tail_;
    series<polynomial> observe_;
    std::optional<perturbed_step<column_entry>> perturbed_; ///< where inputs are uncertain
    /// About how much of the reach they cause; a preference, no proof rests on it.
    std::vector<C> disturbed_;
    std::optional<expansion<twofold>> sharp_; ///< of a point, where it was needed
    bool sharp_ready_ = false;                ///< it knows the parameters
    bool sharp_pays_ = true;                  ///< it was tighter when it was last tried
    std::vector<polynomial> parameters_;
    std::vector<column_entry> column_parameters_;
    std::vector<tube_entry> tube_parameters_;
    std::vector<column_entry> around_;
    std::vector<column_entry> image_; ///< of a generator; its memory is used again
    std::vector<tube_entry> path_, tube_box_, swept_;
    std::vector<C> room_, truncation_;
    std::vector<held_state> held_; ///< of the last step of first order; else empty
    bool tails_ = false;           ///< the last attempt was proved by the tails of the series alone
    C ratio_{};                    ///< of the last attempt's truncation to what is allowed
    std::array<lane_state, width> lanes_;
    mask running_{};
    bool stale_ = true;          ///< the expansions are not those of the present sets
    bool smooth_ = true;         ///< the expansions are of full order
    std::size_t order_ = 6;      ///< K
    std::size_t flow_order_ = 3; ///< L
    std::size_t expanded_ = 0;   ///< L of `derivative_`
};

#ifdef SIVID_COMPILED // its members are compiled once
extern template class parametric_flow<taylor_model<double>>;
extern template class parametric_flow<taylor_model<lanes<8>>>;
#endif

} // namespace sivid

#endif
