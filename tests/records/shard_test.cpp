#include "records/shard.h"

#include <gtest/gtest.h>

namespace rastercheck::records::shard_test {
namespace {

TEST(ShardNumber, IsSaidInWords) { EXPECT_EQ(to_string(ShardNumber{2, 7}), "2 of 7"); }

}  // namespace
}  // namespace rastercheck::records::shard_test
