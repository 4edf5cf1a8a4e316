#include "cases/picture_file.h"

namespace rastercheck::cases {

std::vector<std::string> default_channel_names(std::size_t count) {
  switch (count) {
    case 1:
      return {"Y"};
    case 2:
      return {"R", "G"};
    case 3:
      return {"R", "G", "B"};
    case 4:
      return {"R", "G", "B", "A"};
    default:
      break;
  }
  std::vector<std::string> names;
  names.reserve(count);
  for (std::size_t i = 0; i < count; ++i) names.push_back(std::to_string(i));
  return names;
}

}  // namespace rastercheck::cases
