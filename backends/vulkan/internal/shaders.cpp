#include "backends/vulkan/internal/shaders.h"

#include <array>

#include "backends/vulkan/shaders/append_0.h"
#include "backends/vulkan/shaders/append_1.h"
#include "backends/vulkan/shaders/append_2.h"
#include "backends/vulkan/shaders/append_3.h"
#include "backends/vulkan/shaders/append_4.h"
#include "backends/vulkan/shaders/append_5.h"
#include "backends/vulkan/shaders/append_6.h"
#include "backends/vulkan/shaders/append_7.h"
#include "backends/vulkan/shaders/centers_0.h"
#include "backends/vulkan/shaders/centers_1.h"
#include "backends/vulkan/shaders/centers_2.h"
#include "backends/vulkan/shaders/centers_3.h"
#include "backends/vulkan/shaders/centers_4.h"
#include "backends/vulkan/shaders/centers_5.h"
#include "backends/vulkan/shaders/centers_6.h"
#include "backends/vulkan/shaders/centers_7.h"
#include "backends/vulkan/shaders/fragment_0.h"
#include "backends/vulkan/shaders/fragment_1.h"
#include "backends/vulkan/shaders/fragment_2.h"
#include "backends/vulkan/shaders/fragment_3.h"
#include "backends/vulkan/shaders/fragment_4.h"
#include "backends/vulkan/shaders/fragment_5.h"
#include "backends/vulkan/shaders/fragment_6.h"
#include "backends/vulkan/shaders/fragment_7.h"
#include "backends/vulkan/shaders/picture_0_0_0.h"
#include "backends/vulkan/shaders/picture_0_0_1.h"
#include "backends/vulkan/shaders/picture_0_1_0.h"
#include "backends/vulkan/shaders/picture_0_1_1.h"
#include "backends/vulkan/shaders/picture_1_0_0.h"
#include "backends/vulkan/shaders/picture_1_0_1.h"
#include "backends/vulkan/shaders/picture_1_1_0.h"
#include "backends/vulkan/shaders/picture_1_1_1.h"
#include "backends/vulkan/shaders/picture_2_0_0.h"
#include "backends/vulkan/shaders/picture_2_0_1.h"
#include "backends/vulkan/shaders/picture_2_1_0.h"
#include "backends/vulkan/shaders/picture_2_1_1.h"
#include "backends/vulkan/shaders/picture_3_0_0.h"
#include "backends/vulkan/shaders/picture_3_0_1.h"
#include "backends/vulkan/shaders/picture_3_1_0.h"
#include "backends/vulkan/shaders/picture_3_1_1.h"
#include "backends/vulkan/shaders/picture_4_0_0.h"
#include "backends/vulkan/shaders/picture_4_0_1.h"
#include "backends/vulkan/shaders/picture_4_1_0.h"
#include "backends/vulkan/shaders/picture_4_1_1.h"
#include "backends/vulkan/shaders/picture_5_0_0.h"
#include "backends/vulkan/shaders/picture_5_0_1.h"
#include "backends/vulkan/shaders/picture_5_1_0.h"
#include "backends/vulkan/shaders/picture_5_1_1.h"
#include "backends/vulkan/shaders/picture_6_0_0.h"
#include "backends/vulkan/shaders/picture_6_0_1.h"
#include "backends/vulkan/shaders/picture_6_1_0.h"
#include "backends/vulkan/shaders/picture_6_1_1.h"
#include "backends/vulkan/shaders/picture_7_0_0.h"
#include "backends/vulkan/shaders/picture_7_0_1.h"
#include "backends/vulkan/shaders/picture_7_1_0.h"
#include "backends/vulkan/shaders/picture_7_1_1.h"
#include "backends/vulkan/shaders/point_0.h"
#include "backends/vulkan/shaders/point_1.h"
#include "backends/vulkan/shaders/point_8.h"
#include "backends/vulkan/shaders/samples.h"
#include "backends/vulkan/shaders/vertex_0.h"
#include "backends/vulkan/shaders/vertex_1.h"
#include "backends/vulkan/shaders/vertex_8.h"

namespace rastercheck::backends::vulkan {
namespace {

using Words = std::span<const std::uint32_t>;

const std::array<Words, 8> kFragment{spirv_fragment_0, spirv_fragment_1, spirv_fragment_2,
                                     spirv_fragment_3, spirv_fragment_4, spirv_fragment_5,
                                     spirv_fragment_6, spirv_fragment_7};
const std::array<Words, 8> kCenters{spirv_centers_0, spirv_centers_1, spirv_centers_2,
                                    spirv_centers_3, spirv_centers_4, spirv_centers_5,
                                    spirv_centers_6, spirv_centers_7};

const std::array<Words, 8> kAppend{spirv_append_0, spirv_append_1, spirv_append_2, spirv_append_3,
                                   spirv_append_4, spirv_append_5, spirv_append_6, spirv_append_7};
/// Index 4 · slots + 2 · centres + textured.
const std::array<Words, 32> kPicture{
    spirv_picture_0_0_0, spirv_picture_0_0_1, spirv_picture_0_1_0, spirv_picture_0_1_1,
    spirv_picture_1_0_0, spirv_picture_1_0_1, spirv_picture_1_1_0, spirv_picture_1_1_1,
    spirv_picture_2_0_0, spirv_picture_2_0_1, spirv_picture_2_1_0, spirv_picture_2_1_1,
    spirv_picture_3_0_0, spirv_picture_3_0_1, spirv_picture_3_1_0, spirv_picture_3_1_1,
    spirv_picture_4_0_0, spirv_picture_4_0_1, spirv_picture_4_1_0, spirv_picture_4_1_1,
    spirv_picture_5_0_0, spirv_picture_5_0_1, spirv_picture_5_1_0, spirv_picture_5_1_1,
    spirv_picture_6_0_0, spirv_picture_6_0_1, spirv_picture_6_1_0, spirv_picture_6_1_1,
    spirv_picture_7_0_0, spirv_picture_7_0_1, spirv_picture_7_1_0, spirv_picture_7_1_1};

}  // namespace

std::size_t shader_clip_distances(std::size_t of_case) { return of_case <= 1 ? of_case : 8; }

Words vertex_shader(std::size_t clip_distances, bool is_of_points) {
  if (clip_distances == 0) return is_of_points ? Words(spirv_point_0) : Words(spirv_vertex_0);
  if (clip_distances == 1) return is_of_points ? Words(spirv_point_1) : Words(spirv_vertex_1);
  return is_of_points ? Words(spirv_point_8) : Words(spirv_vertex_8);
}
Words fragment_shader(std::size_t slots, bool has_centers) {
  return has_centers ? kCenters[slots] : kFragment[slots];
}
Words appending_shader(std::size_t slots) { return kAppend[slots]; }
Words picture_shader(std::size_t slots, bool has_centers, bool is_textured) {
  return kPicture[4 * slots + (has_centers ? 2U : 0U) + (is_textured ? 1U : 0U)];
}
Words samples_shader() { return spirv_samples; }

}  // namespace rastercheck::backends::vulkan
