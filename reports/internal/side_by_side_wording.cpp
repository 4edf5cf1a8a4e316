#include "reports/internal/side_by_side_wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "reports/commands.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {

using records::SideBySide;
using records::SideBySideLaw;

std::string compared_sentence(const SideBySide& pair) {
  const std::uint64_t same = pair.counts.cases();
  std::string text =
      same == 0 ? "Nothing to compare: no case is the same on both and was judged on both."
                : fmt::format("Compared on {}, the same on both.", counted(same, "case", "cases"));
  if (pair.judged_first == same && pair.judged_second == same) return text;
  text += fmt::format(" {} was judged on {} in all, {} on {}", pair.first,
                      counted(pair.judged_first, "case", "cases"), pair.second,
                      grouped(pair.judged_second));
  if (pair.unlike == 0) return text + ".";
  return text + fmt::format("; {} judged on both {} made differently, to fit what each can draw.",
                            grouped(pair.unlike), pair.unlike == 1 ? "was" : "were");
}

std::vector<std::pair<std::string, std::uint64_t>> side_counts(const SideBySide& pair) {
  return {{"both right", pair.counts.both_right},
          {fmt::format("only {} right", pair.first), pair.counts.only_first_right},
          {fmt::format("only {} right", pair.second), pair.counts.only_second_right},
          {"neither right", pair.counts.neither_right}};
}

std::string known_sentence(const SideBySide& pair) {
  std::string text;
  for (const auto& [backend, known] :
       {std::pair(pair.first, pair.known_first), std::pair(pair.second, pair.known_second)}) {
    if (known == 0) continue;
    text += fmt::format("{}{} on {}", text.empty() ? "" : " and ", grouped(known), backend);
  }
  if (text.empty()) return "";
  const bool is_one = pair.known_first + pair.known_second == 1;
  return fmt::format("Of the wrong cases, {} {}.", text,
                     is_one ? "is a known defect" : "are known defects");
}

std::vector<SideBySideLaw> differing_laws(const SideBySide& pair) {
  std::vector<SideBySideLaw> laws;
  std::copy_if(pair.laws.begin(), pair.laws.end(), std::back_inserter(laws),
               [](const SideBySideLaw& law) { return law.counts.differing() > 0; });
  std::stable_sort(laws.begin(), laws.end(), [](const SideBySideLaw& a, const SideBySideLaw& b) {
    return a.counts.differing() > b.counts.differing();
  });
  return laws;
}

std::vector<Disagreement> disagreements_of(const SideBySide& pair, const SideBySideLaw& law) {
  std::vector<Disagreement> all;
  if (law.counts.only_first_right > 0) {
    all.push_back(
        {law.law, pair.first, pair.second, law.counts.only_first_right, law.only_first_right});
  }
  if (law.counts.only_second_right > 0) {
    all.push_back(
        {law.law, pair.second, pair.first, law.counts.only_second_right, law.only_second_right});
  }
  return all;
}

const records::Difference* difference_of(const records::Run& run,
                                         const Disagreement& disagreement) {
  const auto found = std::find_if(
      run.differences.begin(), run.differences.end(), [&](const records::Difference& one) {
        return one.source.found && one.source.found->law == disagreement.law &&
               one.source.found->backend == disagreement.wrong && one.right == disagreement.right;
      });
  return found == run.differences.end() ? nullptr : &*found;
}

std::string places_text(const records::Run& run, const Disagreement& disagreement) {
  const std::vector<records::CasePlace>& places = disagreement.places;
  const records::Difference* first = difference_of(run, disagreement);
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [origin, index] = places[i];
    if (i > 0 && origin == places[i - 1].origin) {
      text += ", ";
    } else {
      const bool is_one = i + 1 == places.size() || places[i + 1].origin != origin;
      text +=
          fmt::format("{}{} {} ", i == 0 ? "" : "; ", to_string(origin), is_one ? "case" : "cases");
    }
    text += std::to_string(index % records::kRedrawn);
    if (index >= records::kRedrawn) text += " (drawn again)";
    if (i == 0 && first != nullptr && !first->source.name.empty()) {
      text += fmt::format(" “{}”", first->source.name);
    }
  }
  return disagreement.cases > places.size() ? text + ", …" : text;
}

std::vector<std::string> look_commands(const records::Run& run, const std::string& file,
                                       const Disagreement& disagreement) {
  return {replay_command(run, file, disagreement.wrong),
          replay_command(run, file, disagreement.right)};
}

}  // namespace rastercheck::reports
