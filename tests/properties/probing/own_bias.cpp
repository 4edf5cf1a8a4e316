#include "tests/properties/probing/own_bias.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "backends/unorm_depth.h"

namespace rastercheck::properties {
namespace {

struct Corner {
  double u, v, z;  ///< window position and depth
};

/// A plane through three corners: value at (u, v), and its derivatives.
struct Plane {
  double along_u = 0;
  double along_v = 0;
  double at_origin = 0;
  explicit Plane(const std::array<Corner, 3>& p) {
    const double bu = p[1].u - p[0].u;
    const double bv = p[1].v - p[0].v;
    const double cu = p[2].u - p[0].u;
    const double cv = p[2].v - p[0].v;
    const double area = bu * cv - bv * cu;
    along_u = ((p[1].z - p[0].z) * cv - (p[2].z - p[0].z) * bv) / area;
    along_v = (bu * (p[2].z - p[0].z) - cu * (p[1].z - p[0].z)) / area;
    at_origin = p[0].z - along_u * p[0].u - along_v * p[0].v;
  }
  double at(double u, double v) const { return at_origin + along_u * u + along_v * v; }
};

std::array<Corner, 3> corners_of(const cases::Case& c, const cases::Triangle& triangle) {
  std::array<Corner, 3> all{};
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& p = c.positions[triangle[i]];
    const double w = double{p.w};
    const double n = double{c.viewport.min_depth};
    const double f = double{c.viewport.max_depth};
    all[i] = {double{c.viewport.x} + (double{p.x} / w + 1) / 2 * double{c.viewport.width},
              double{c.viewport.y} + (double{p.y} / w + 1) / 2 * double{c.viewport.height},
              n + double{p.z} / w * (f - n)};
  }
  return all;
}

/// One triangle of a case.
class Biased {
 public:
  Biased(const cases::Case& c, const OwnBias& wrong, const cases::Triangle& triangle, double drawn)
      : c_(&c), wrong_(&wrong), corners_(corners_of(c, triangle)), plane_(corners_) {
    offset_ = offset(drawn);
  }

  float depth(double u, double v) const {
    using Limit = OwnBias::Limit;
    const double plain = plane_.at(u, v);
    double depth = 0;
    switch (wrong_->limit) {
      case Limit::after:
        depth = limited(plain + offset_);
        break;
      case Limit::before:
        depth = limited(plain) + offset_;
        break;
      case Limit::at_vertices: {
        std::array<Corner, 3> moved = corners_;
        for (Corner& corner : moved) corner.z = limited(corner.z + offset_);
        depth = Plane(moved).at(u, v);
        break;
      }
      case Limit::never:
        depth = plain + offset_;
        break;
    }
    const int bits = cases::unorm_bits(c_->depth_format);
    if (bits == 0) return static_cast<float>(depth);
    const double steps = std::ldexp(1.0, bits) - 1;
    const double exact = std::clamp(depth, 0.0, 1.0) * steps;
    const double k = wrong_->store ? wrong_->store(exact) : std::round(exact);
    return backends::unorm_depth(static_cast<std::uint32_t>(std::clamp(k, 0.0, steps)), bits);
  }

 private:
  double limited(double depth) const {
    if (!c_->depth_clamp) return std::clamp(depth, 0.0, 1.0);
    return std::clamp(depth, double{c_->viewport.min_depth}, double{c_->viewport.max_depth});
  }

  double unit(double drawn) const {
    const int bits = cases::unorm_bits(c_->depth_format);
    if (bits > 0) return std::ldexp(wrong_->unit, -bits);
    const std::array<double, 3> z{corners_[0].z, corners_[1].z, corners_[2].z};
    const double greatest = wrong_->exponent_of ? wrong_->exponent_of(z, drawn)
                                                : std::clamp(*std::max_element(z.begin(), z.end()),
                                                             double{c_->viewport.min_depth},
                                                             double{c_->viewport.max_depth});
    return greatest == 0 ? 0 : std::ldexp(wrong_->float_unit, std::ilogb(greatest) - 23);
  }

  double offset(double drawn) const {
    const cases::DepthBias& bias = c_->depth_bias;
    const double x = std::fabs(plane_.along_u);
    const double y = std::fabs(plane_.along_v);
    const double m = wrong_->slope ? wrong_->slope(x, y) : std::max(x, y);
    const double all = m * double{bias.slope} + unit(drawn) * double{bias.constant};
    const double clamp = double{bias.clamp};
    if (clamp == 0 || bias.is_none()) return all;
    if (wrong_->clamp) return wrong_->clamp(all, clamp);
    return clamp > 0 ? std::min(all, clamp) : std::max(all, clamp);
  }

  const cases::Case* c_;
  const OwnBias* wrong_;
  std::array<Corner, 3> corners_;
  Plane plane_;
  double offset_ = 0;
};

}  // namespace

Result<cases::Fragments> OwnBiasBackend::draw_fragments(const cases::Case& c) {
  if (c.rules != cases::Rules::vulkan) {
    return tl::unexpected(Error{"", "", "not by these rules", Failure::unsupported});
  }
  cases::Case plain = c;
  plain.depth_bias = {};
  plain.depth_format = cases::DepthFormat::float32;
  Result<backends::Drawn> drawn = cpu_->draw(plain);
  if (!drawn) return tl::unexpected(drawn.error());
  cases::Fragments& fragments = drawn->fragments;
  if (c.depth_bias.is_none() && cases::unorm_bits(c.depth_format) == 0) {
    return std::move(fragments);
  }
  std::map<std::uint32_t, double> greatest;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    double& most = greatest[fragments.triangle[i]];
    most = std::max(most, std::fabs(double{fragments.depth[i]}));
  }
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const std::uint32_t t = fragments.triangle[i];
    fragments.depth[i] = Biased(c, wrong_, c.triangles[t], greatest[t])
                             .depth(fragments.x[i] + 0.5, fragments.y[i] + 0.5);
  }
  return std::move(fragments);
}

}  // namespace rastercheck::properties
