#include "records/plan_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cases/capabilities_json.h"
#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/contract_json.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<ContractFile> T>
void members(Archive& archive, T& contract) {
  archive.required("file", contract.file);
  archive.required("terms", contract.terms);
}

template <typename Archive, cases::Either<ShardNumber> T>
void members(Archive& archive, T& number) {
  archive.required("index", number.index);
  archive.required("count", number.count);
  archive.check([&](const cases::JsonNode& node) {
    if (number.count > kMostShards) {
      node["count"].refuse(fmt::format("must be at most {}", kMostShards));
    } else if (number.index == 0 || number.index > number.count) {
      node["index"].refuse(fmt::format("must be from 1 to {}", number.count));
    }
  });
}

template <typename Archive, cases::Either<Plan> T>
void members(Archive& archive, T& plan) {
  const Plan usual;
  archive.required("seed", plan.seed);
  archive.required("cases_per_property", plan.cases_per_law);
  archive.optional("backends", plan.backends);
  archive.optional("capabilities", plan.capabilities);
  archive.optional("properties", plan.laws);
  archive.optional("property_patterns", plan.properties);
  archive.optional("scene", plan.scene);
  archive.optional("scene_size", plan.scene_size, usual.scene_size);
  archive.optional("contract", plan.contract);
  archive.optional("promise", plan.promise);
  archive.optional("draw_by", plan.draw_by);
  archive.optional("corpus", plan.corpus);
  archive.optional("hunted", plan.hunted);
  archive.optional("known", plan.known);
  archive.optional("ignores_known", plan.ignores_known);
  archive.optional("shrink_tries", plan.shrinking.tries, usual.shrinking.tries);
  archive.optional("shrink_seconds", plan.shrinking.seconds);
  archive.optional("power", plan.power, usual.power);
  archive.optional("require_cases", plan.require_cases);
  archive.optional("keeps_cases", plan.keeps_cases);
  archive.optional("timeout", plan.timeout, usual.timeout);
  archive.optional("shard", plan.shard);
  archive.check([&](const cases::JsonNode& node) {
    if (plan.scene_size < 1 || plan.scene_size > cases::kMaxSize) {
      node["scene_size"].refuse("must be from 1 to " + std::to_string(cases::kMaxSize));
    }
    if (plan.contract && plan.contract->file.empty()) {
      node["contract"]["file"].refuse("must be a file");
    }
  });
}

void write_value(nlohmann::json& to, const Plan& plan) { cases::write_members(to, plan); }
void read_value(const cases::JsonNode& node, Plan& plan) { cases::read_members(node, plan); }

}  // namespace rastercheck::records
