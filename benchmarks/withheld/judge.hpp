// SPDX-License-Identifier: MIT
// One diagnosis against one label.
#ifndef WITHHELD_JUDGE_HPP
#define WITHHELD_JUDGE_HPP

#include "known.hpp"
#include "labels.hpp"
#include "recorded.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace withheld {

/// What is wrong with a claim: its kind, for the tables, and the claim itself.
struct finding {
    std::string kind, about;
};

/// Of a parameter of the true effects.
struct hull_width {
    std::string name;              // "wind.wx"
    double of_prior = 0;           // share of the prior that the hull leaves, infinite for no hull
    std::optional<double> allowed; // the share that explains the data, as far as it was found
    double of_allowed = 0;         // the first over the second
};

struct judgement {
    std::string id, family, truth, answer;
    bool missing = false;  // no diagnosis, or none that can be read
    std::string trouble;   // what was wrong with the file
    bool absorbed = false; // the model without the effect explains the data as well
    bool right = false;
    bool open = false; // it says that it did not try everything: neither right nor wrong
    std::optional<bool> place_right; // of the first place; without effect: that there is none
    std::optional<bool> part_right;  // of the first part that stands alone, where one does
    std::vector<finding> false_proofs;
    std::vector<finding> contradictions; // within the file, whatever the truth is
    std::size_t withdrawn = 0;           // claims that the program found in doubt itself
    std::size_t proofs = 0;              // claims that could have been false
    bool gap_certified = false, relation_proved = false;
    std::optional<bool> truth_explains; // is the truth among the causes proved to explain?
    std::optional<double> inflation_lower, inflation_upper, inflation_bound; // bound: by the truth
    std::optional<double> shrink_lower, shrink_upper, shrink_true;           // on hold-out data
    std::size_t witnesses_checked = 0, rates_checked = 0, hulls_checked = 0;
    std::size_t intervals = 0, intervals_hold = 0; // of the true effects' parameters
    std::vector<double> onset_windows;             // widths, in shares of the scenario's time
    std::vector<hull_width> hull_widths;
    std::optional<double> holdout_ratio;    // upper bounds, over all fits to at the witness
    std::optional<double> holdout_witness;  // the second of these
    std::optional<double> holdout_attained; // the largest found at parameters that explain
    std::optional<double> tube_coverage;    // share of the held-out samples within the tube
    std::optional<double> seconds;

    /// Counts a proof, and remembers it when it is false.
    void proof(bool holds, char const* kind, std::string const& about) {
        ++proofs;
        if (!holds) false_proofs.push_back({kind, about});
    }
};

/// `baseline`, a diagnosis by least squares, knows further parameters that explain the data; null
/// for none.
judgement judge(label const& truth, nlohmann::json const& diagnosis,
                nlohmann::json const& baseline = {});

/// Reads <results>/<case>/diagnosis.json and, where it is, <results>/<case>/seconds.txt; with a
/// folder of data sets, claims are checked by simulations of the truth and of witnesses, too.
judgement judge_case(label const& truth, std::filesystem::path const& results,
                     std::filesystem::path const& data, std::filesystem::path const& baseline = {});

/// Simulates the witnesses of all causes: what is proved of them, and on hold-out data.
void check_witnesses(recording const& data, nlohmann::json const& diagnosis, judgement& j);

/// Simulates the truth: missing rates and offsets of sensors over the windows that are named, and
/// hold-out inflations over all fits.
void check_claims(label const& truth, recording const& data, nlohmann::json const& diagnosis,
                  judgement& j);

/// Compares the hulls of the true effects' parameters with what the data allow, and what is said of
/// held-out data for all fits with what is said at the witness.
void measure_widths(label const& truth, recording const& data, nlohmann::json const& diagnosis,
                    judgement& j);

} // namespace withheld

#endif
