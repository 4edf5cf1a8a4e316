#pragma once

#include "records/plan.h"

namespace rastercheck::records {

/// A plan in which no setting has its default value.
inline Plan sample_plan() {
  Plan plan{7, 12, {"cpu", "plugin:\"x\""}, {"a-law"}, {"*edge*", "--known"}, "bunny.obj", 640};
  plan.contract.emplace().file = "lax.json";
  plan.contract->terms.keeps_constants = false;
  plan.corpus = "a folder";
  cases::Case& worst = plan.hunted.emplace_back();
  worst.name = "a worst case";
  worst.framebuffer = {4, 2};
  worst.viewport.width = 4;
  worst.viewport.height = 2;
  plan.known = {"lists", "mine.json"};
  plan.ignores_known = true;
  plan.shrinking = {5, 2.5};
  plan.power = 5;
  plan.keeps_cases = true;
  plan.timeout = 0.5;
  plan.shard = {2, 7};
  plan.capabilities["cpu"].rules = {cases::Rules::opengl};
  return plan;
}

}  // namespace rastercheck::records
