// SPDX-License-Identifier: MIT
// Campaigns as folders (sivid-dataset-1) and, apart from them, the line of the labels.
#ifndef WITHHELD_CAMPAIGN_FILES_HPP
#define WITHHELD_CAMPAIGN_FILES_HPP

#include "campaign.hpp"

#include <filesystem>
#include <string>

namespace withheld {

/// Writes dataset.json and the tables into `folder`, which is made; nothing of the truth is in
/// them.
void write_dataset(campaign const& c, std::filesystem::path const& folder);

/// What dataset.json says of a scenario, and its two tables.
std::string scenario_text(scenario const& s);
void write_tables(campaign const& c, measured_scenario const& s,
                  std::filesystem::path const& folder);

/// Tab-separated; the first four columns say what is true, the others help to judge what is
/// reported.
std::string labels_header();
/// `folder` is where the data set was written: the base model is fitted to it.
std::string label_of(campaign const& c, std::filesystem::path const& folder);

} // namespace withheld

#endif
