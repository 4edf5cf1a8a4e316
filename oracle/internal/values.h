#pragma once

// The exact values of a triangle's fragments (RULES §1, §3, §4): depth and attributes, each as the
// range that the contract leaves open, usually a single value.

#include <optional>
#include <vector>

#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/ulp_error.h"

namespace rastercheck::oracle {

/// A value as a function of the window position: the ratio of two functionals.
struct Reading {
  Line numerator;
  Line denominator;

  /// If the denominator is <= 0, p has no value.
  template <typename AnyPoint>
  Fraction at(const AnyPoint& p) const {
    return {numerator.at(p), denominator.at(p)};
  }
};

/// A value given by three per-vertex numbers n_i: Σ E_i n_i over Σ E_i if perspective (smooth
/// attributes, n = r), over |det M| if affine in window space (noperspective, n = r w; depth).
struct Quantity {
  std::array<Ring, 3> numerators;
  bool is_perspective = false;

  /// The value on a map at a point; empty if a perspective value has no D > 0 there, or if the map
  /// has no orientation.
  std::optional<Field> at(const ProjectiveMap& map, const Point& p) const;

  /// The value on a map, which must have an orientation.
  Reading on(const ProjectiveMap& map) const;
};

/// A value, or the range that the rules allow. `is_open` marks a value that the rules leave open by
/// its kind (unspecified snapping or basis, centroid, a cut triangle); it is shown as a range even
/// if both ends are equal.
struct OpenValue {
  FractionRange range;
  bool is_open = false;
};

class TriangleValues {
 public:
  /// Where in a pixel a value is evaluated.
  enum class Place { sample, center };

  /// The setup must outlive the values.
  explicit TriangleValues(const TriangleSetup& triangle);

  /// The depth of a fragment after bias and clamping, before it is stored; empty if undefined.
  std::optional<OpenValue> depth(int x, int y, int sample) const;
  /// An attribute of a fragment; empty if undefined.
  std::optional<OpenValue> attribute(std::size_t index, int x, int y, int sample) const;

  /// The depth without its bias.
  const Quantity& depth_quantity() const { return depth_; }
  /// The attribute as the contract claims it interpolates; used for derivatives, conditioning and
  /// errors.
  Quantity quantity(std::size_t attribute) const;
  /// A smooth attribute as the rules interpolate it, whatever the contract claims.
  Quantity perspective_quantity(std::size_t attribute) const;
  /// The exact vertex values of an attribute, and the largest of their magnitudes.
  std::array<Ring, 3> vertex_values(std::size_t attribute) const;
  Ring vertex_magnitude(std::size_t attribute) const;
  /// The least and the greatest vertex value of an attribute or, for shape placed, of the depth.
  /// Values at samples lie between them.
  FractionRange ends(std::size_t attribute) const;
  const FractionRange& depth_ends() const { return depth_ends_; }
  /// True if single_map() has a value of the attribute at its location p; false at a centre with
  /// 1/w <= 0, or at such a sample of a conservatively covered pixel, where the rules define none.
  bool is_defined_at(std::size_t attribute, const Point& p) const;
  /// The point at which an attribute of a fragment is evaluated. A centroid may have a range of
  /// points; this returns the sample.
  Point location(std::size_t attribute, int x, int y, int sample) const;
  /// The places that D3D allows for a centroid: the centre if all samples are covered, else the
  /// first covered sample. If coverage is open, several places are possible.
  struct CentroidSamples {
    std::vector<int> firsts;
    bool has_center = false;
  };
  CentroidSamples centroid_samples(int x, int y) const;
  /// The map that the contract's basis evaluates; nullptr if the contract allows several.
  const ProjectiveMap* single_map() const;

  /// A map, and a region where values may be evaluated on it. The values that the quantity has
  /// there are some or all of the permitted values.
  struct Region {
    const ProjectiveMap* map = nullptr;
    ConvexRegion points;

    /// True if 1/w <= 0 at a corner.
    bool has_pole() const;
    /// True if the quantity equals `computed` somewhere in the region.
    bool attains(const Reading& reading, const Ring& computed) const;
  };
  /// The points of a pixel at which an attribute may be evaluated if the rules name no place for
  /// centroids (OpenGL, Vulkan). A snapped triangle may also be evaluated elsewhere. The map must
  /// have an orientation.
  const Region& centroid_region(int x, int y) const;
  /// Shape cut: the points at which the exact triangle has the values that the moved one may have
  /// at p.
  const Region& cut_region(const Point& p) const;

 private:
  std::optional<FractionRange> value_at(const Quantity& quantity, const FractionRange& ends,
                                        const Point& p, Place place) const;
  std::optional<FractionRange> placed_value(const Quantity& quantity, const FractionRange& ends,
                                            const Point& p, Place place) const;
  std::optional<FractionRange> cut_value(const Quantity& quantity, const Point& p,
                                         Place place) const;
  /// The points at which the exact triangle may be evaluated for a sample p under an open viewport.
  Region shown_region(const Point& p) const;
  std::optional<OpenValue> centroid_sample(const Quantity& quantity, const FractionRange& ends,
                                           int x, int y) const;
  std::optional<FractionRange> centroid_range(const Quantity& quantity, int x, int y) const;

  const TriangleSetup* triangle_;
  Quantity depth_;
  FractionRange depth_ends_;

  /// Cache of the last regions, because several samples and attributes ask for the same region.
  struct CentroidRegion {
    int x;
    int y;
    Region region;
  };
  struct CutRegion {
    Point p;
    Region region;
  };
  mutable std::optional<CentroidRegion> last_centroid_;
  mutable std::optional<CutRegion> last_cut_;
};

}  // namespace rastercheck::oracle
