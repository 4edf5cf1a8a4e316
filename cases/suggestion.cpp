#include "cases/suggestion.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace rastercheck::cases {
namespace {

/// The optimal string alignment distance: the least number of insertions, deletions, substitutions
/// and swaps of neighbours that turn `a` into `b`.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;
  std::vector<std::size_t> last(b.size() + 1);
  std::iota(last.begin(), last.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row{i};
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchanged = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row.push_back(std::min({last[j] + 1, row[j - 1] + 1, exchanged}));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before = std::exchange(last, std::move(row));
  }
  return last.back();
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::size_t dashes = std::min(word.find_first_not_of('-'), word.size());
  if (word.size() - dashes < 2) return "";  // too short to resemble anything
  constexpr std::size_t kLettersForEachEdit = 3;
  std::size_t least = std::max<std::size_t>(1, word.size() / kLettersForEachEdit) + 1;
  std::string nearest;
  for (const std::string& name : names) {
    const std::size_t edits =
        name.starts_with(word) || word.ends_with(name) ? 0 : edits_between(word, name);
    if (edits < least) {
      least = edits;
      nearest = name;
    }
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace rastercheck::cases
