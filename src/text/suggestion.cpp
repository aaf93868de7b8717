#include "text/suggestion.h"

#include <algorithm>
#include <numeric>

#include "text/letters.h"

namespace drover::text {
namespace {

/// Edits (insert, delete, replace) that make one word of the other.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const auto replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  const auto meant = in_small_letters(word);  // device names stand in capitals on their labels
  std::string best;
  std::size_t least = std::max<std::size_t>(word.size() / 2, 2) + 1;
  for (const auto& candidate : candidates) {
    // "max_speed" for "max_speed_mps" is the usual slip: a forgotten unit.
    const auto written = in_small_letters(candidate);
    const bool begun = meant.size() >= 2 && written.starts_with(meant);
    const auto edits = begun ? std::size_t{written != meant} : distance(meant, written);
    if (edits < least) {
      least = edits;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const auto best = nearest(word, candidates);
  return best.empty() ? "" : "did you mean \"" + best + "\"?";
}

}  // namespace drover::text
