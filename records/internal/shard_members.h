#pragma once

// A shard's number, for whatever has one.

#include "cases/json_members.h"
#include "records/shard.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<ShardNumber> T>
void members(Archive& archive, T& number) {
  archive.required("index", number.index);
  archive.required("count", number.count);
}

/// Refuses a number that there is not.
void check_shard_number(const ShardNumber& number, const cases::JsonNode& node);

}  // namespace rastercheck::records
