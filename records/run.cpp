#include "records/run.h"

#include <fmt/format.h>

#include <string_view>

namespace rastercheck::records {
namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Characters of a case's name in a file name: names may be whole sentences, and file systems allow
/// 255 bytes. The index still tells two long names apart.
constexpr std::size_t kMostOfName = 64;

/// ASCII only, whatever the locale: a file name that every system and archive takes as it is.
std::string file_word(std::string_view text) {
  std::string word;
  for (const char c : text) word += is_letter_or_digit(c) ? c : '-';
  return word;
}

}  // namespace

std::string unreached_sentence(const UnreachedLabel& label) {
  return fmt::format("Not reached: {} on {}: '{}' in {} of {} cases, where at least {} had to.",
                     label.law, label.backend, label.label, label.reached, label.checked,
                     label.least);
}

std::string file_of(const Counterexample& counterexample) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  const std::string& name = counterexample.source.name;
  return fmt::format("counterexamples/{}-{}{}-{}.json", file_word(found.law),
                     file_word(found.backend),
                     name.empty() ? "" : "-" + file_word(name).substr(0, kMostOfName), found.index);
}

}  // namespace rastercheck::records
