// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_RELATION_FINDING_HPP
#define SIVID_PAVING_RELATION_RELATION_FINDING_HPP

#include <sivid/number/interval.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// A time window of an experiment.
struct relation_window {
    std::string scenario;
    double from = 0, to = 0;

    friend bool operator==(relation_window const&, relation_window const&) = default;
};

/// What would have to be added to an equation on the average over a window for it to hold there.
struct missing_rate {
    relation_window window;
    interval value;   ///< certified over the whole prior
    std::string unit; ///< of the state, per time
};

/// The assumption that the rate of a state varies by at most so much within a time.
struct assumed_variation {
    std::string scenario;
    std::size_t state = 0;
    double period = 0;    ///< [time]
    double variation = 0; ///< in the state's unit per time
};

/// What is proved of an equation itself, and not of it or its sensors.
struct proved_place {
    std::vector<std::string> assumptions; ///< those of the relation, and what sensors may do
    std::optional<missing_rate> missing;  ///< without 0
};

/// What was found out about one state equation together with the sensors in its row.
struct relation_finding {
    std::size_t equation = 0;
    std::string name;                  ///< of the state whose rate it is
    bool definition = false;           ///< a function of states alone, in which no constant acts
    std::vector<std::string> channels; ///< the sensors in the row, if proved
    std::vector<std::size_t> further;  ///< equations that the proof rests on, too
    /// For no parameter of the prior and no start do the equation and all bounds of these sensors
    /// hold, if the assumptions do. Nothing is said about which of them fails.
    bool proved = false;
    std::vector<std::string> assumptions;
    std::vector<assumed_variation> variations; ///< the same of the rates, in numbers
    std::vector<relation_window> windows;      ///< that carry the proof, at most coefficients + 1
    /// Certified: no parameter fulfils all windows even if each may be off by so many times half of
    /// what the bounds leave open in it. Not above 0: nothing is proved.
    double margin = 0;
    /// If the sensors are right, of the window in which it is clearest; it may contain 0.
    std::optional<missing_rate> missing;
    std::string reason;                ///< why nothing could be tried
    std::optional<proved_place> place; ///< where no sensor can be what is wrong
};

/// How relations are examined. Windows are at most as long as the record.
struct relation_options {
    double shortest_gaps = 3;     ///< the shortest window: so many gaps between samples,
    double shortest_share = 0.01; ///< and no less than this share of the record
    /// A proof by less than this is not reported: reserve against assumptions that are met barely.
    double least_margin = 0.02;
    std::size_t cells_per_gap = 6;    ///< cells between two samples
    std::size_t most_windows = 20000; ///< for one equation
    /// Asked now and then; from false on no equation is proved broken any more. May be empty.
    std::function<bool()> go_on{};
};

} // namespace sivid

#endif
