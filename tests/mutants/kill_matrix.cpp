// Finds which mutants a law kills, and the first case that kills each:
//
//   rastercheck_kill_matrix LAW CASES MUTANT…
//
// prints a line of JSON for each mutant, {"property", "mutant", "kill", "says"}. "kill" is the
// index of the first case, among the law's first CASES cases of seed 1, on which the law finds
// violations by the mutant but none by the backend without the defect; null if no case does. "says"
// is true if the law applies to any of the cases. scripts/kill-matrix runs this program.
//
// Mutants are judged side by side: each case is generated once, and the backend without a defect is
// checked on it once. A mutant that gives the same answers to the law's questions, to the bit, is
// not checked.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "properties/campaign/check_case.h"
#include "properties/law.h"
#include "tests/mutants/mutant_backend.h"
#include "tests/mutants/recording_backend.h"

namespace rastercheck::mutants {
namespace {

constexpr std::uint64_t kSeed = 1;

struct Mutant {
  std::string name;
  std::unique_ptr<backends::Backend> backend;
  bool is_spoken_of = false;  ///< true if the law has applied to a case so far
  std::optional<std::uint64_t> killed_at;
};

/// A backend without a defect, and its mutants.
struct Group {
  std::unique_ptr<backends::Backend> unharmed;
  std::vector<Mutant> mutants;

  bool is_alive() const {
    return std::any_of(mutants.begin(), mutants.end(),
                       [](const Mutant& mutant) { return !mutant.killed_at; });
  }
};

Result<std::vector<Group>> groups_of(const std::vector<std::string>& names) {
  std::map<std::string, Group> groups;
  for (const std::string& name : names) {
    const std::string of = header_of(name).of;
    Group& group = groups[of];
    if (!group.unharmed) {
      auto unharmed = backends::make_backend(of);
      if (!unharmed) return tl::unexpected(unharmed.error());
      group.unharmed = *std::move(unharmed);
    }
    auto mutant = backends::make_backend("mutant:" + name);
    if (!mutant) return tl::unexpected(mutant.error());
    group.mutants.push_back({name, *std::move(mutant), false, std::nullopt});
  }
  std::vector<Group> all;
  all.reserve(groups.size());
  for (auto& [of, group] : groups) all.push_back(std::move(group));
  return all;
}

/// Checks a case. A fault of the oracle or the harness is an error here.
Result<properties::Check> checked(const properties::Law& law, const cases::Case& c,
                                  backends::Backend& backend, std::uint64_t index) {
  properties::Check done = properties::check_or_note(law, c, backend, index);
  if (done.fault) return tl::unexpected(Error{"case " + std::to_string(index), "", *done.fault});
  return done;
}

/// Checks the surviving mutants of a group on one case. A case on which the backend without the
/// defect violates the law as well, as textbook methods do on some, kills no mutant.
Result<void> judge(const properties::Law& law, const cases::Case& c, std::uint64_t index,
                   Group& group) {
  RecordingBackend recording(*group.unharmed);
  const auto unharmed = checked(law, c, recording, index);
  if (!unharmed) return tl::unexpected(unharmed.error());
  if (unharmed->violation_count > 0) return {};
  for (Mutant& mutant : group.mutants) {
    if (mutant.killed_at) continue;
    mutant.is_spoken_of = mutant.is_spoken_of || unharmed->is_applicable;
    if (recording.is_answered_alike_by(*mutant.backend)) continue;
    const auto harmed = checked(law, c, *mutant.backend, index);
    if (!harmed) return tl::unexpected(harmed.error());
    mutant.is_spoken_of = mutant.is_spoken_of || harmed->is_applicable;
    if (harmed->violation_count > 0) mutant.killed_at = index;
  }
  return {};
}

Result<void> run(const properties::Law& law, std::uint64_t cases, std::vector<Group>& groups) {
  std::erase_if(groups, [&law](const Group& group) {
    return !properties::is_promised(law, *group.unharmed);
  });
  for (std::uint64_t index = 0; index < cases; ++index) {
    std::optional<properties::Generated> generated;
    for (Group& group : groups) {
      if (!group.is_alive()) continue;
      if (!generated) {
        properties::Draw draw = draw_of(law, kSeed, index);
        generated = law.generate(draw);
      }
      const Result<void> judged = judge(law, generated->source, index, group);
      if (!judged) return judged;
    }
    if (!generated) break;
  }
  return {};
}

void print(const properties::Law& law, const std::vector<std::string>& names,
           const std::vector<Group>& groups) {
  std::map<std::string, const Mutant*> judged;
  for (const Group& group : groups) {
    for (const Mutant& mutant : group.mutants) judged[mutant.name] = &mutant;
  }
  for (const std::string& name : names) {
    nlohmann::json line{{"property", law.id}, {"mutant", name}, {"kill", nullptr}, {"says", false}};
    if (const auto found = judged.find(name); found != judged.end()) {
      line["says"] = found->second->is_spoken_of;
      if (found->second->killed_at) line["kill"] = *found->second->killed_at;
    }
    std::cout << line.dump() << '\n';
  }
}

int main_of(const std::vector<std::string>& arguments) {
  std::uint64_t cases = 0;
  const properties::Law* law =
      arguments.size() < 3 ? nullptr : properties::find_law(arguments.front());
  if (law != nullptr) {
    const std::string& number = arguments[1];
    std::from_chars(number.data(), number.data() + number.size(), cases);
  }
  if (law == nullptr || cases == 0) {
    std::cerr << "usage: rastercheck_kill_matrix LAW CASES MUTANT…\n";
    return 2;
  }
  const std::vector<std::string> names(arguments.begin() + 2, arguments.end());
  auto groups = groups_of(names);
  const Result<void> done = groups ? run(*law, cases, *groups)  //
                                   : Result<void>(tl::unexpected(groups.error()));
  if (!done) {
    std::cerr << law->id << ": " << to_string(done.error()) << '\n';
    return 1;
  }
  print(*law, names, *groups);
  return 0;
}

}  // namespace
}  // namespace rastercheck::mutants

int main(int argc, char** argv) {
  return rastercheck::mutants::main_of(std::vector<std::string>(argv + 1, argv + argc));
}
