#include "rasterizer/internal/standard_pattern.h"

#include <array>

namespace rastercheck::rasterizer {
namespace {

constexpr SampleOffset sixteenths(int x, int y) { return {x / 16.0, y / 16.0}; }

constexpr std::array kOne{sixteenths(8, 8)};
constexpr std::array kTwo{sixteenths(12, 12), sixteenths(4, 4)};
constexpr std::array kFour{sixteenths(6, 2), sixteenths(14, 6), sixteenths(2, 10),
                           sixteenths(10, 14)};
constexpr std::array kEight{sixteenths(9, 5),   sixteenths(7, 11), sixteenths(13, 9),
                            sixteenths(5, 3),   sixteenths(3, 13), sixteenths(1, 7),
                            sixteenths(11, 15), sixteenths(15, 1)};
constexpr std::array kSixteen{
    sixteenths(9, 9),  sixteenths(7, 5),   sixteenths(5, 10),  sixteenths(12, 7),
    sixteenths(3, 6),  sixteenths(10, 13), sixteenths(13, 11), sixteenths(11, 3),
    sixteenths(6, 14), sixteenths(8, 1),   sixteenths(4, 2),   sixteenths(2, 12),
    sixteenths(0, 8),  sixteenths(15, 4),  sixteenths(14, 15), sixteenths(1, 0)};

}  // namespace

std::span<const SampleOffset> standard_pattern(int samples) {
  switch (samples) {
    case 1:
      return kOne;
    case 2:
      return kTwo;
    case 4:
      return kFour;
    case 8:
      return kEight;
    case 16:
      return kSixteen;
    default:
      return {};
  }
}

}  // namespace rastercheck::rasterizer
