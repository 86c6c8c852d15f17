// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <sstream>

namespace withheld {

namespace {

struct counted {
    std::size_t hits = 0, of = 0;
    void add(bool hit) {
        hits += hit ? 1U : 0U;
        ++of;
    }
    std::string text() const {
        if (of == 0) return "-";
        char buffer[48];
        std::snprintf(buffer, sizeof buffer, "%zu/%zu %3.0f%%", hits, of,
                      100.0 * static_cast<double>(hits) / static_cast<double>(of));
        return buffer;
    }
};

struct tally {
    std::size_t campaigns = 0, open = 0, false_proofs = 0, proofs = 0, contradictions = 0;
    std::vector<double> seconds;
    counted right, place, gap, relation, explained, baseline;

    void add(judgement const& j, judgement const* base) {
        ++campaigns;
        false_proofs += j.false_proofs.size();
        proofs += j.proofs;
        contradictions += j.contradictions.size();
        if (j.seconds) seconds.push_back(*j.seconds);
        if (j.open)
            ++open;
        else
            right.add(j.right);
        if (j.place_right || j.missing) place.add(j.place_right.value_or(false));
        if (!j.absorbed) {
            gap.add(j.gap_certified);
            relation.add(j.relation_proved);
        }
        if (j.truth_explains) explained.add(*j.truth_explains);
        if (base != nullptr) baseline.add(base->right);
    }
};

std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text + ' ';
}

std::string number_text(std::optional<double> const& x, char const* format = "%.6g") {
    if (!x) return "";
    char buffer[48];
    std::snprintf(buffer, sizeof buffer, format, *x);
    return buffer;
}

/// "wind.wx 0.02 of 0.01": what the hull leaves of its prior, and what the data allow.
std::string hulls_text(std::vector<hull_width> const& hulls) {
    std::string text;
    for (auto const& h : hulls)
        text += (text.empty() ? "" : "; ") + h.name + ' ' + number_text(h.of_prior) + " of " +
                (h.allowed ? number_text(h.allowed) : "?");
    return text;
}

constexpr std::size_t name_width = 11, cell_width = 12;

std::string row(std::string const& name, tally& t) {
    std::string line = padded(name, name_width);
    for (auto const& cell : {t.right.text(), std::to_string(t.open), t.baseline.text(),
                             t.place.text(), t.explained.text(), t.gap.text(), t.relation.text()})
        line += padded(cell, cell_width);
    std::string middle = "-";
    if (auto& all = t.seconds; !all.empty()) {
        std::sort(all.begin(), all.end());
        middle = number_text(all[all.size() / 2], "%.1f");
    }
    line += padded(middle, 7) + padded(std::to_string(t.contradictions), 14);
    return line + std::to_string(t.false_proofs) + " of " + std::to_string(t.proofs) + '\n';
}

/// "median (least .. greatest) of n"
std::string spread(std::vector<double> all) {
    if (all.empty()) return "-";
    std::sort(all.begin(), all.end());
    char buffer[128];
    std::snprintf(buffer, sizeof buffer, "median %.4g (%.4g .. %.4g) of %zu", all[all.size() / 2],
                  all.front(), all.back(), all.size());
    return buffer;
}

} // namespace

std::string family_table(std::vector<judgement> const& all,
                         std::vector<judgement> const& baseline) {
    std::map<std::string, tally> by_family;
    tally total;
    for (std::size_t i = 0; i < all.size(); ++i) {
        auto const* base = baseline.empty() ? nullptr : &baseline[i];
        by_family[all[i].family].add(all[i], base);
        total.add(all[i], base);
    }
    std::string text = padded("family", name_width);
    for (auto const* head :
         {"right", "open", "baseline", "place", "explained", "gap proved", "relation"})
        text += padded(head, cell_width);
    text += padded("s", 7) + padded("contradictions", 14) + "false proofs\n";
    for (auto& [name, t] : by_family) text += row(name, t);
    return text + row("all", total);
}

std::string confusion(std::vector<judgement> const& all) {
    std::map<std::string, std::map<std::string, std::size_t>> counts;
    for (auto const& j : all) ++counts[j.truth][j.answer];
    std::string text;
    for (auto const& [truth, answers] : counts) {
        text += padded(truth, 46) + "->";
        for (auto const& [answer, n] : answers) text += "  " + answer + " x" + std::to_string(n);
        text += '\n';
    }
    return text;
}

std::string complaints(std::vector<judgement> const& all) {
    std::map<std::string, std::size_t> false_kinds, contradicting_kinds;
    std::string text;
    auto const add = [&](char const* head, judgement const& j, std::vector<finding> const& found,
                         std::map<std::string, std::size_t>& kinds) {
        for (auto const& f : found) {
            ++kinds[f.kind];
            text += head + j.id + "  " + f.kind + "  " + f.about + "  (" + j.family + ", " +
                    j.truth + ")\n";
        }
    };
    for (auto const& j : all) {
        add("FALSE PROOF  ", j, j.false_proofs, false_kinds);
        add("CONTRADICTION  ", j, j.contradictions, contradicting_kinds);
        if (j.missing) text += "missing      " + j.id + "  " + j.trouble + '\n';
        if (!j.right && !j.missing)
            text += (j.open ? "open         " : "wrong        ") + j.id + "  " + j.family + "  " +
                    j.truth + " -> " + j.answer + '\n';
    }
    auto const tell = [&](char const* head, std::map<std::string, std::size_t> const& kinds) {
        text += head;
        if (kinds.empty()) text += " none";
        for (auto const& [kind, n] : kinds) text += "  " + kind + ' ' + std::to_string(n);
        text += '\n';
    };
    tell("false proofs by kind:", false_kinds);
    tell("contradictions by kind:", contradicting_kinds);
    return text;
}

std::string measures(std::vector<judgement> const& all) {
    std::vector<double> width, slack, shrink, shrink_error, seconds, onsets;
    counted relations, certified, sound, shrink_held, parts, tenth, allowed_tenth, twice, ratio,
        allowed_ratio, covered;
    std::vector<double> of_prior, of_allowed, ratios, of_attained;
    std::size_t witnesses = 0, rates = 0, hulls = 0, intervals = 0, hold = 0, contradictory = 0,
                withdrawn = 0;
    for (auto const& j : all) {
        witnesses += j.witnesses_checked;
        rates += j.rates_checked;
        hulls += j.hulls_checked;
        contradictory += j.contradictions.empty() ? 0U : 1U;
        withdrawn += j.withdrawn;
        intervals += j.intervals;
        hold += j.intervals_hold;
        for (auto const& w : j.hull_widths) {
            of_prior.push_back(w.of_prior);
            tenth.add(w.of_prior <= 0.1);
            if (!w.allowed) continue;
            if (*w.allowed <= 0.1) allowed_tenth.add(w.of_prior <= 0.1);
            of_allowed.push_back(w.of_allowed);
            twice.add(w.of_allowed <= 2);
        }
        if (j.holdout_ratio) {
            ratios.push_back(*j.holdout_ratio);
            ratio.add(*j.holdout_ratio <= 1.5);
        }
        if (j.holdout_ratio && j.holdout_attained && *j.holdout_attained > 0) {
            of_attained.push_back(*j.holdout_ratio * *j.holdout_witness / *j.holdout_attained);
            if (*j.holdout_attained <= 1.5 * *j.holdout_witness)
                allowed_ratio.add(*j.holdout_ratio <= 1.5);
        }
        if (j.tube_coverage) covered.add(*j.tube_coverage >= 1);
        if (j.part_right) parts.add(*j.part_right);
        onsets.insert(onsets.end(), j.onset_windows.begin(), j.onset_windows.end());
        if (j.seconds) seconds.push_back(*j.seconds);
        if (j.inflation_lower && j.inflation_upper && *j.inflation_lower > 0)
            width.push_back(*j.inflation_upper / *j.inflation_lower);
        if (j.inflation_lower && j.inflation_bound) {
            sound.add(*j.inflation_lower <= *j.inflation_bound + 1e-3);
            slack.push_back(*j.inflation_lower / *j.inflation_bound);
        }
        if (!j.absorbed && j.truth_explains && j.family != "pose" && j.family != "outliers") {
            relations.add(j.relation_proved);
            certified.add(j.gap_certified);
        }
        if (j.shrink_lower && j.shrink_upper) {
            shrink.push_back((*j.shrink_lower + *j.shrink_upper) / 2);
            if (!j.shrink_true) continue;
            shrink_error.push_back(shrink.back() - *j.shrink_true);
            shrink_held.add(*j.shrink_lower <= *j.shrink_true + 1e-3 &&
                            *j.shrink_upper >= *j.shrink_true - 1e-3);
        }
    }
    std::ostringstream text;
    text << "full channels, no outliers, an effect of the catalogue: gap certified "
         << certified.text() << ", a relation proved " << relations.text() << '\n'
         << "inflation, lower <= least known: " << sound.text() << '\n'
         << "inflation, upper/lower:          " << spread(width) << '\n'
         << "inflation, lower/least known:    " << spread(slack) << '\n'
         << "hold-out shrink reported:        " << spread(shrink) << '\n'
         << "hold-out shrink - true shrink:   " << spread(shrink_error)
         << ", true one held: " << shrink_held.text() << '\n'
         << "seconds a campaign:              " << spread(seconds) << ", in all "
         << std::accumulate(seconds.begin(), seconds.end(), 0.0) << '\n'
         << "witnesses simulated:             " << witnesses << '\n'
         << "missing rates simulated:         " << rates << '\n'
         << "explaining values held to hulls: " << hulls << '\n'
         << "the part that stands alone found: " << parts.text() << '\n'
         << "windows of onsets / scenario:    " << spread(onsets) << '\n'
         << "hull of an effect / its prior:   " << spread(of_prior)
         << ", at most a tenth: " << tenth.text()
         << ", of those where the data allow it: " << allowed_tenth.text() << '\n'
         << "hull / what the data allow:      " << spread(of_allowed)
         << ", at most twice: " << twice.text() << '\n'
         << "hold-out, all fits / witness:    " << spread(ratios)
         << ", at most 1.5: " << ratio.text()
         << ", of those where no more is attained: " << allowed_ratio.text() << '\n'
         << "hold-out, all fits / attained:   " << spread(of_attained) << '\n'
         << "tubes that hold all held-out samples: " << covered.text() << '\n'
         << "files that contradict themselves: " << contradictory << " of " << all.size() << '\n'
         << "claims that the program withdrew: " << withdrawn << '\n'
         << "effect parameters in their intervals: " << hold << '/' << intervals << '\n';
    return text.str();
}

std::string csv(std::vector<judgement> const& all) {
    std::string text =
        "case,family,truth,answer,right,place,absorbed,false_proofs,proofs,gap_certified,"
        "relation_proved,truth_explains,inflation_lower,inflation_upper,"
        "inflation_bound,shrink_lower,shrink_upper,shrink_true,seconds,missing,open,"
        "contradictions,hulls,holdout_ratio,holdout_witness,holdout_attained\n";
    auto const flag = [](bool b) { return b ? "1" : "0"; };
    auto const maybe = [&](std::optional<bool> const& b) { return b ? flag(*b) : ""; };
    for (auto const& j : all) {
        auto const kinds = [](std::vector<finding> const& all_of_them) {
            std::string list;
            for (auto const& f : all_of_them) list += (list.empty() ? "" : " ") + f.kind;
            return list;
        };
        text += j.id + ',' + j.family + ',' + j.truth + ',' + j.answer + ',' + flag(j.right) + ',' +
                maybe(j.place_right) + ',' + flag(j.absorbed) + ',' + kinds(j.false_proofs) + ',' +
                std::to_string(j.proofs) + ',' + flag(j.gap_certified) + ',' +
                flag(j.relation_proved) + ',' + maybe(j.truth_explains) + ',' +
                number_text(j.inflation_lower) + ',' + number_text(j.inflation_upper) + ',' +
                number_text(j.inflation_bound) + ',' + number_text(j.shrink_lower) + ',' +
                number_text(j.shrink_upper) + ',' + number_text(j.shrink_true) + ',' +
                number_text(j.seconds, "%.3f") + ',' + flag(j.missing) + ',' + flag(j.open) + ',' +
                kinds(j.contradictions) + ',' + hulls_text(j.hull_widths) + ',' +
                number_text(j.holdout_ratio) + ',' + number_text(j.holdout_witness) + ',' +
                number_text(j.holdout_attained) + '\n';
    }
    return text;
}

} // namespace withheld
