#include "reports/commands.h"

#include <fmt/format.h>

#include <string_view>

namespace rastercheck::reports {
namespace {

/// Quotes a word so that a shell reads back the same word.
std::string shell_word(std::string_view word) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=:,./@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(word);
  }
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string words(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& word : all) text += " " + shell_word(word);
  return text;
}

}  // namespace

std::string run_command(const records::Run& run) {
  std::string command = "rastercheck run";
  const records::Plan& plan = run.plan;
  for (const std::string& backend : plan.backends) command += " --backend " + shell_word(backend);
  command += fmt::format(" --cases {} --seed {}", plan.cases_per_law, plan.seed);
  if (!plan.scene.empty()) command += " --scene " + shell_word(plan.scene);
  command += words(records::option_words(plan));
  if (!plan.shard) return command;
  return command + fmt::format(" --shard {}/{}", plan.shard->index, plan.shard->count);
}

std::string replay_command(const records::Run& run, const std::string& file) {
  return "rastercheck replay " + shell_word(file) + words(records::replay_words(run.plan));
}

std::string replay_command(const records::Run& run, const std::string& file,
                           const std::string& backend) {
  return fmt::format("rastercheck replay {} --backend {}", shell_word(file), shell_word(backend)) +
         words(records::replay_words(run.plan));
}

std::string explain_command(const records::Run& run, const std::string& file,
                            const records::WorstError& place) {
  std::string command = fmt::format(
      "rastercheck explain {} --pixel {},{} --sample {} --triangle {}", shell_word(file),
      place.place.x, place.place.y, place.place.sample, place.place.triangle);
  return command + words(records::contract_words(run.plan));
}

std::string command_line(const std::vector<std::string>& all) { return words(all).substr(1); }

}  // namespace rastercheck::reports
