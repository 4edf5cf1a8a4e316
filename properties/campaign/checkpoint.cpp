// unfinished.json:
//
//   {"format": "rastercheck-unfinished", "version": 2,
//    "plan": {records/plan_json.h}, "corpus_digest": "…", "known_digest": "…", "program": "0.1.0",
//    "saved": [{a case file}, …],
//    "tasks": 4400, "done": [[0, 17], [19, 20]],
//    "records": […], "counterexamples": […], "unexpected": […]}
//
// "done" lists ranges of tasks, each from the first to one past the last. "known_digest", "cases"
// (records/case_record_json.h), "outcomes" (records/case_outcomes_json.h) and "unexpected" are
// absent if there are none.

#include "properties/campaign/checkpoint.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/json.h"
#include "properties/campaign/internal/findings_members.h"
#include "properties/draw.h"
#include "records/plan_json.h"

namespace rastercheck::properties {
namespace {

using cases::JsonNode;
using nlohmann::json;

constexpr std::uint64_t kVersion = 2;
/// Maximum number of tasks: more than any campaign has (campaign.cpp), and few enough for a list.
constexpr std::uint64_t kMostTasksInAll = std::uint64_t{1} << 28U;

/// The number of tasks. Reading it sizes `is_done`, which DoneRanges then fills.
template <typename T>
struct TaskCount {
  T& is_done;

  friend void write_value(json& to, const TaskCount& tasks) { to = tasks.is_done.size(); }
  friend void read_value(const JsonNode& node, TaskCount& tasks) {
    tasks.is_done.assign(node.count(kMostTasksInAll), false);
  }
};
template <typename T>
TaskCount(T&) -> TaskCount<T>;
template <typename T>
struct DoneRanges {
  T& is_done;

  friend void write_value(json& to, const DoneRanges& done) {
    const std::vector<bool>& tasks = done.is_done;
    to = json::array();
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (!tasks[i]) continue;
      const std::size_t first = i;
      while (i < tasks.size() && tasks[i]) ++i;
      to.push_back({first, i});
    }
  }
  friend void read_value(const JsonNode& node, DoneRanges& done) {
    const std::size_t tasks = done.is_done.size();
    for (const JsonNode& range : node.elements()) {
      const auto [from, to] = range.two_elements("first and last");
      const auto first = from.count<std::size_t>(tasks);
      const auto last = to.count<std::size_t>(tasks);
      for (std::size_t i = first; i < last; ++i) done.is_done[i] = true;
    }
  }
};
template <typename T>
DoneRanges(T&) -> DoneRanges<T>;

}  // namespace

template <typename Archive, cases::Either<Checkpoint> T>
void members(Archive& archive, T& checkpoint) {
  archive.format("rastercheck-unfinished", kVersion);
  archive.required("plan", checkpoint.plan);
  archive.required("corpus_digest", checkpoint.corpus_digest);
  archive.optional("known_digest", checkpoint.known_digest);
  archive.required("program", checkpoint.program);
  archive.required("saved", checkpoint.saved);
  archive.required("tasks", TaskCount{checkpoint.is_done});
  archive.required("done", DoneRanges{checkpoint.is_done});
  members(archive, checkpoint.findings);
  archive.check([&](const JsonNode& node) {
    for (std::size_t i = 0; i < checkpoint.saved.size(); ++i) {
      if (!checkpoint.saved[i].found) node["saved"].elements()[i].refuse("has no 'found'");
    }
  });
}

namespace {

Checkpoint read_checkpoint(const JsonNode& root) {
  auto checkpoint = cases::read_as<Checkpoint>(root);
  if (root.failed()) return checkpoint;
  // A file may list findings in another order, or twice.
  merge(checkpoint.findings, std::exchange(checkpoint.findings, {}));
  return checkpoint;
}

}  // namespace

std::vector<Task> tasks_of(const Checkpoint& checkpoint, std::size_t corpus_size,
                           const KnownByBackend& known) {
  const bool is_held_to_own = !checkpoint.plan.contract && !checkpoint.plan.promise;
  return tasks_of(checkpoint.plan, corpus_size, checkpoint.saved,
                  is_held_to_own ? known : KnownByBackend{});
}

std::string digest_of(const std::vector<cases::Case>& cases) {
  std::string files;  // differ whenever the cases differ
  for (const cases::Case& c : cases) files += cases::to_json(c);
  return fmt::format("{:016x}", fnv1a(files));
}

std::string checkpoint_file(const std::string& directory) {
  return (std::filesystem::path(directory) / "unfinished.json").string();
}

std::string to_json(const Checkpoint& checkpoint) {
  return cases::json_line(cases::json_of(checkpoint)) + "\n";
}

Result<Checkpoint> parse_checkpoint(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &read_checkpoint);
}

}  // namespace rastercheck::properties
