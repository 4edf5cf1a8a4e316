#include "records/plan.h"

#include <fmt/format.h>

#include "cases/names.h"

namespace rastercheck::records {
namespace {

/// Collects the command-line words for all settings that differ from their defaults.
class Words {
 public:
  void flag(bool is_given, const char* name) {
    if (is_given) all_.emplace_back(name);
  }
  void value(bool is_given, const char* name, const std::string& text) {
    if (is_given) all_.insert(all_.end(), {name, text});
  }
  std::vector<std::string> take() && { return std::move(all_); }

 private:
  std::vector<std::string> all_;
};

void add_contract(Words& words, const Plan& plan) {
  if (plan.contract) words.value(true, "--contract", plan.contract->file);
  if (plan.promise) words.value(true, "--promise", std::string(to_string(*plan.promise)));
}

void add_draw_by(Words& words, const Plan& plan) {
  if (plan.draw_by) {
    words.value(true, "--draw-by", std::string(cases::name_of(*plan.draw_by)));
  }
}

void add_known(Words& words, const Plan& plan) {
  words.flag(plan.ignores_known, "--no-known");
  for (const std::string& source : plan.known) words.value(true, "--known", source);
}

void add_timeout(Words& words, const Plan& plan) {
  words.value(plan.timeout != Plan().timeout, "--timeout", fmt::format("{}", plan.timeout));
}

}  // namespace

std::optional<cases::ContractTerms> terms_of(const Plan& plan) {
  std::optional<cases::ContractTerms> terms;
  if (plan.contract) terms = plan.contract->terms;
  return with_promise(std::move(terms), plan.promise);
}

std::optional<cases::ContractTerms> with_promise(std::optional<cases::ContractTerms> terms,
                                                 std::optional<cases::DriverPromise> promise) {
  if (!promise) return terms;
  if (!terms) terms.emplace();
  terms->promise = promise;
  return terms;
}

const cases::Capabilities& capabilities_of(const Plan& plan, const std::string& backend) {
  static const cases::Capabilities kEverything;
  const auto found = plan.capabilities.find(backend);
  return found == plan.capabilities.end() ? kEverything : found->second;
}

Plan frozen(const Plan& plan) {
  Plan frozen;
  frozen.seed = plan.seed;
  frozen.cases_per_law = plan.cases_per_law;
  frozen.backends = {};
  frozen.capabilities = plan.capabilities;
  frozen.properties = plan.properties;
  frozen.contract = plan.contract;
  frozen.promise = plan.promise;
  frozen.draw_by = plan.draw_by;
  frozen.corpus = plan.corpus;
  frozen.hunted = plan.hunted;
  frozen.known = plan.known;
  frozen.ignores_known = plan.ignores_known;
  frozen.power = plan.power;
  return frozen;
}

std::vector<std::string> option_words(const Plan& plan) {
  const Plan usual;
  Words words;
  for (const std::string& pattern : plan.properties) words.value(true, "--property", pattern);
  words.value(!plan.scene.empty() && plan.scene_size != usual.scene_size, "--scene-size",
              std::to_string(plan.scene_size));
  add_contract(words, plan);
  add_draw_by(words, plan);
  words.value(!plan.corpus.empty(), "--corpus", plan.corpus);
  add_known(words, plan);
  words.value(plan.shrinking.tries != usual.shrinking.tries, "--shrink-tries",
              std::to_string(plan.shrinking.tries));
  if (plan.shrinking.seconds) {
    words.value(true, "--shrink-seconds", fmt::format("{}", *plan.shrinking.seconds));
  }
  words.value(plan.power != usual.power, "--power", std::to_string(plan.power));
  words.value(plan.require_cases.has_value(), "--require-cases",
              std::to_string(plan.require_cases.value_or(0)));
  words.flag(plan.keeps_cases, "--keep-cases");
  add_timeout(words, plan);
  return std::move(words).take();
}

std::vector<std::string> contract_words(const Plan& plan) {
  Words words;
  add_contract(words, plan);
  return std::move(words).take();
}

std::vector<std::string> replay_words(const Plan& plan) {
  Words words;
  add_contract(words, plan);
  // A case drawn by `frame` was saved with its depth test, so it needs no option.
  if (plan.draw_by != cases::DrawBy::frame) add_draw_by(words, plan);
  add_known(words, plan);
  add_timeout(words, plan);
  return std::move(words).take();
}

}  // namespace rastercheck::records
