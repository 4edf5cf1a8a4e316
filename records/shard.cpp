#include "records/shard.h"

#include <fmt/format.h>

namespace rastercheck::records {

std::string to_string(const ShardNumber& number) {
  return fmt::format("{} of {}", number.index, number.count);
}

}  // namespace rastercheck::records
