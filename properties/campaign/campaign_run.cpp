#include "properties/campaign/campaign_run.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <utility>

#include "cases/files.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;

/// Maximum time for which results stay unwritten while tasks end.
constexpr std::chrono::seconds kMostUnwritten{1};
/// News is written sooner, but writing takes at most about one part in this many of the run.
constexpr int kShareOfWriting = 16;

bool is_same_failure(const Counterexample& a, const Counterexample& b) {
  const cases::Found& of_a = *a.source.found;
  const cases::Found& of_b = *b.source.found;
  return of_a == of_b && a.origin == b.origin;
}

/// Replaces the counterexample from which a shrunk one was made.
void replace(Findings& findings, const Counterexample& shrunk) {
  for (Counterexample& one : findings.counterexamples) {
    if (is_same_failure(one, shrunk)) one = shrunk;
  }
}

}  // namespace

std::uint64_t violations_of(const Findings& findings) {
  std::uint64_t violations = 0;
  for (const auto& [key, record] : findings.records) violations += record.cases.violations;
  return violations;
}

CampaignRun::CampaignRun(Checkpoint start, std::string directory, std::size_t corpus_size,
                         Warn warn, const KnownByBackend& known)
    : checkpoint_(std::move(start)),
      directory_(std::move(directory)),
      tasks_(tasks_of(checkpoint_, corpus_size, known)),
      warn_(std::move(warn)),
      all_(checkpoint_.findings) {
  checkpoint_.is_done.resize(tasks_.size());
  violations_at_start_ = violations_of(all_);
}

Result<void> CampaignRun::begin() { return write(); }

Result<void> CampaignRun::write() {
  const auto begin = std::chrono::steady_clock::now();
  Result<void> written = cases::write_file(checkpoint_file(directory_), to_json(checkpoint_));
  written_ = std::chrono::steady_clock::now();
  write_time_ = written_ - begin;
  return written;
}

void CampaignRun::save() {
  const Result<void> written = write();
  if (written || has_warned_) return;
  has_warned_ = true;
  Error error = written.error();
  error.reason +=
      "; the run continues, but if it is resumed, what it finds from now on must be found again";
  warn_(error);
}

void CampaignRun::write_if_due(bool is_news) {
  const std::chrono::steady_clock::duration unwritten = std::chrono::steady_clock::now() - written_;
  if (unwritten >= kMostUnwritten || (is_news && unwritten >= kShareOfWriting * write_time_)) {
    save();
  }
}

Result<void> CampaignRun::check_cases(const Execute& execute, const Progress& progress) {
  std::vector<std::size_t> places;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    all += tasks_[i].cases();
    if (!checkpoint_.is_done[i]) places.push_back(i);
  }
  // Whenever the run ends, all laws have been checked about equally.
  std::stable_sort(places.begin(), places.end(), [this](std::size_t a, std::size_t b) {
    const auto order = [](const Task& task) {
      return std::pair(task.kind == TaskKind::random, task.first);
    };
    return order(tasks_[a]) < order(tasks_[b]);
  });
  std::vector<Task> open;
  open.reserve(places.size());
  for (const std::size_t place : places) open.push_back(tasks_[place]);
  std::uint64_t done = all - cases_left();
  return execute(open, [&](std::size_t task, Findings found) {
    if (found.fault) {
      merge(all_, std::move(found));
      return false;
    }
    const std::size_t place = places[task];
    const bool may_be_news = !found.counterexamples.empty();
    std::vector<Counterexample> before;
    if (may_be_news) before = checkpoint_.findings.counterexamples;
    merge(all_, found);
    merge(checkpoint_.findings, std::move(found));
    checkpoint_.is_done[place] = true;
    done += tasks_[place].cases();
    if (progress) progress(done, all);
    write_if_due(may_be_news && before != checkpoint_.findings.counterexamples);
    return true;
  });
}

void CampaignRun::add_scene(Findings scene) { merge(all_, std::move(scene)); }

Result<void> CampaignRun::shrink(const Execute& execute, const IsToEnd& is_to_end,
                                 const Progress& progress) {
  const std::vector<Task> tasks = shrink_tasks(all_);
  std::uint64_t done = 0;
  return execute(tasks, [&](std::size_t /*task*/, Findings found) {
    if (found.fault) {
      merge(all_, std::move(found));
      return false;
    }
    const bool is_whole = !is_to_end || !is_to_end();
    for (const Counterexample& shrunk : found.counterexamples) {
      replace(all_, shrunk);
      if (is_whole) replace(checkpoint_.findings, shrunk);
    }
    if (!is_whole) has_cut_short_ = true;
    if (progress) progress(++done, tasks.size());
    write_if_due(is_whole);
    return true;
  });
}

void CampaignRun::remove() {
  std::error_code ignored;
  std::filesystem::remove(checkpoint_file(directory_), ignored);
}

std::uint64_t CampaignRun::cases_left() const {
  std::uint64_t left = 0;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    if (!checkpoint_.is_done[i]) left += tasks_[i].cases();
  }
  return left;
}

}  // namespace rastercheck::properties
