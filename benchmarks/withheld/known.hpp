// SPDX-License-Identifier: MIT
// Inflations that are attained: whatever a diagnosis proves must leave room for them.
#ifndef WITHHELD_KNOWN_HPP
#define WITHHELD_KNOWN_HPP

#include "labels.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace withheld {

/// Effects with parameters at which the data need this inflation.
struct known_fit {
    std::set<std::string> effects;
    double inflation = 0;
    std::map<std::string, double> values; // "Sv", "wind.wx"; may be empty
};

class known_fits {
public:
    /// The model without effects, at the true constants and by the label's fit; the truth, where
    /// a candidate holds it. `baseline`: every fit in it.
    explicit known_fits(label const& truth, nlohmann::json const& baseline = {});

    std::vector<known_fit> const& all() const { return all_; }
    /// The least inflation attained with these effects. More of them need no more: their neutral
    /// values lie in the priors.
    std::optional<double> least(std::set<std::string> const& effects) const;

private:
    std::vector<known_fit> all_;
};

} // namespace withheld

#endif
