#include "records/known.h"

#include <fnmatch.h>

#include <algorithm>

namespace rastercheck::records {
namespace {

bool matches_some(const std::vector<std::string>& patterns, const std::string& name) {
  return std::any_of(patterns.begin(), patterns.end(), [&name](const std::string& pattern) {
    return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  });
}

}  // namespace

bool is_skipped_by(const KnownOfBackend& known, const KnownEntry& entry) {
  return entry.expected == Expected::skip &&
         std::find(known.run_out.begin(), known.run_out.end(), entry.id) == known.run_out.end();
}

bool is_of_law(const KnownEntry& entry, std::string_view law) {
  return entry.laws.empty() || matches_some(entry.laws, std::string(law));
}

bool is_of_backend(const KnownEntry& entry, const std::vector<std::string>& names) {
  return entry.backends.empty() ||
         std::any_of(names.begin(), names.end(), [&entry](const std::string& name) {
           return matches_some(entry.backends, name);
         });
}

}  // namespace rastercheck::records
