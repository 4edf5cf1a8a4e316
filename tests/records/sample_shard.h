#pragma once

// A shard in which every member is set.

#include "records/shard.h"

namespace rastercheck::records {

inline Shard sample_shard() {
  Shard shard;
  shard.is_whole = false;
  shard.corpus_digest = "0123456789abcdef";
  shard.known_digest = "fedcba9876543210";
  shard.scene_digest = "00000000000000ff";
  shard.promises = {{"cpu", false, {}, true, {}},
                    {"gl", true, cases::DriverPromise::ieee, false, {"a law", "b"}}};
  cases::Case& saved = shard.saved.emplace_back();
  saved.framebuffer = {8, 8, 1};
  saved.viewport = {0, 0, 8, 8, 0, 1};
  saved.positions = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  saved.triangles = {{0, 1, 2}};
  saved.found = cases::Found{"a law", "cpu", "missing", 3, 4};
  return shard;
}

}  // namespace rastercheck::records
