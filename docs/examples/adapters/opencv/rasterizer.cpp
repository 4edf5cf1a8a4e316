/*
 * OpenCV's fillConvexPoly(): convex polygons in one colour, with corners in fixed point. It has
 * neither depth nor values between the corners.
 */
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "image.h"

namespace {

/* Bits behind the point of a corner's coordinates; OpenCV has room for 16. */
constexpr int kShift = 8;

/* OpenCV's pixels have their centres at whole numbers. */
int fixed(float clip, float w, uint32_t size) {
  const double pixels = (double{clip} / w + 1) / 2 * size - 0.5;
  return static_cast<int>(std::lrint(pixels * (1 << kShift)));
}

double byte_of(float color) { return std::floor(color * 255 + 0.5F); }

}  // namespace

extern "C" void draw_image(const image_triangle* triangles, uint32_t count, uint32_t width,
                           uint32_t height, uint8_t* rgba) {
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_8UC4, rgba);
  for (uint32_t t = 0; t < count; ++t) {
    std::array<cv::Point, 3> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const float* const p = triangles[t].vertex[i].position;
      corners[i] = {fixed(p[0], p[3], width), fixed(p[1], p[3], height)};
    }
    const float* const color = triangles[t].vertex[0].color;
    const cv::Scalar bytes(byte_of(color[0]), byte_of(color[1]), byte_of(color[2]), 255);
    cv::fillConvexPoly(image, corners.data(), static_cast<int>(corners.size()), bytes, cv::LINE_8,
                       kShift);
  }
}
