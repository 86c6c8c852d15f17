// SPDX-License-Identifier: MIT
// One diagnosis against one label.
#ifndef WITHHELD_JUDGE_HPP
#define WITHHELD_JUDGE_HPP

#include "labels.hpp"
#include "recorded.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace withheld {

struct judgement {
    std::string id, family, truth, answer;
    bool missing = false;  // no diagnosis, or none that can be read
    std::string trouble;   // what was wrong with the file
    bool absorbed = false; // the model without the effect explains the data as well
    bool right = false;
    std::optional<bool> place_right; // of the first place; without effect: that there is none
    std::vector<std::string> false_proofs;
    std::size_t proofs = 0; // claims that could have been false: gap, relations, places, causes
    bool gap_certified = false, relation_proved = false;
    std::optional<bool> truth_explains; // is the truth among the causes proved to explain?
    std::optional<double> inflation_lower, inflation_upper, inflation_bound; // bound: by the truth
    std::optional<double> shrink_lower, shrink_upper, shrink_true;           // on hold-out data
    std::size_t witnesses_checked = 0;
    std::size_t intervals = 0, intervals_hold = 0; // of the true effects' parameters
    std::optional<double> seconds;
};

judgement judge(label const& truth, nlohmann::json const& diagnosis);

/// Reads <results>/<case>/diagnosis.json and, where it is, <results>/<case>/seconds.txt; with a
/// folder of data sets, proved witnesses are simulated too.
judgement judge_case(label const& truth, std::filesystem::path const& results,
                     std::filesystem::path const& data);

/// Simulates the witnesses of all causes that are said to be proved to explain the data.
void check_witnesses(recording const& data, nlohmann::json const& diagnosis, judgement& j);

} // namespace withheld

#endif
