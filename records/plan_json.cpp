#include "records/plan_json.h"

#include <nlohmann/json.hpp>

#include "cases/contract_json.h"
#include "cases/json_members.h"
#include "records/internal/shard_members.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<ContractFile> T>
void members(Archive& archive, T& contract) {
  archive.required("file", contract.file);
  archive.required("terms", contract.terms);
}

template <typename Archive, cases::Either<Plan> T>
void members(Archive& archive, T& plan) {
  const Plan usual;
  archive.required("seed", plan.seed);
  archive.required("cases_per_law", plan.cases_per_law);
  archive.optional("backends", plan.backends);
  archive.optional("laws", plan.laws);
  archive.optional("properties", plan.properties);
  archive.optional("scene", plan.scene);
  archive.optional("scene_size", plan.scene_size, usual.scene_size);
  archive.optional("contract", plan.contract);
  archive.optional("corpus", plan.corpus);
  archive.optional("known", plan.known);
  archive.optional("ignores_known", plan.ignores_known);
  archive.optional("shrink_tries", plan.shrinking.tries, usual.shrinking.tries);
  archive.optional("shrink_seconds", plan.shrinking.seconds);
  archive.optional("keeps_cases", plan.keeps_cases);
  archive.optional("timeout", plan.timeout, usual.timeout);
  archive.optional("shard", plan.shard);
}

nlohmann::json plan_to_json(const Plan& plan) {
  nlohmann::json object;
  cases::write_members(object, plan);
  return object;
}

Plan plan_from_json(const cases::JsonNode& node) {
  const auto plan = cases::read_members<Plan>(node);
  if (node.failed()) return plan;
  if (plan.scene_size < 1 || plan.scene_size > cases::kMaxSize) {
    node["scene_size"].refuse("must be from 1 to " + std::to_string(cases::kMaxSize));
  }
  if (plan.contract && plan.contract->file.empty()) {
    node["contract"]["file"].refuse("must be a file");
  }
  if (plan.shard) check_shard_number(*plan.shard, node["shard"]);
  return plan;
}

}  // namespace rastercheck::records
