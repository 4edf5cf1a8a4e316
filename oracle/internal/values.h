#pragma once

// The exact values of a triangle's fragments (RULES §1, §3, §4): depth and attributes, as the range
// the contract leaves open, mostly a single value.

#include <optional>
#include <vector>

#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/ulp_error.h"

namespace rastercheck::oracle {

/// A value as a function of the window position: the ratio of two functionals.
struct Reading {
  Line numerator;
  Line denominator;

  /// The denominator may be <= 0: then there is no value.
  template <typename AnyPoint>
  Fraction at(const AnyPoint& p) const {
    return {numerator.at(p), denominator.at(p)};
  }
};

/// A value with three per-vertex numbers n_i: Σ E_i n_i over Σ E_i where it is perspective (smooth
/// attributes, n = r), over |det M| where it is affine in window space (noperspective, n = r w;
/// depth).
struct Quantity {
  std::array<Ring, 3> numerators;
  bool is_perspective = false;

  /// The value on a map at a point; nothing where a perspective value has no D > 0 there, or where
  /// the map has no orientation.
  std::optional<Field> at(const ProjectiveMap& map, const Point& p) const;

  /// The value on a map that has an orientation.
  Reading on(const ProjectiveMap& map) const;
};

/// A value as the rules leave it. `is_open`: the rules leave it open by their kind (unspecified
/// snapping or basis, centroid, a cut triangle), so that it is shown as a range even where both
/// ends are equal.
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

  /// The depth of a fragment; nothing where it is undefined.
  std::optional<OpenValue> depth(int x, int y, int sample) const;
  /// An attribute of a fragment; nothing where it is undefined.
  std::optional<OpenValue> attribute(std::size_t index, int x, int y, int sample) const;

  const Quantity& depth_quantity() const { return depth_; }
  /// What the contract claims of an attribute: what derivatives, conditioning and errors take
  /// apart.
  Quantity quantity(std::size_t attribute) const;
  /// What the rules say of a smooth attribute, whatever is claimed.
  Quantity perspective_quantity(std::size_t attribute) const;
  /// The exact vertex values of an attribute, and the largest of their magnitudes.
  std::array<Ring, 3> vertex_values(std::size_t attribute) const;
  Ring vertex_magnitude(std::size_t attribute) const;
  /// The least and the greatest value at a vertex, between which those of samples lie: of an
  /// attribute, and, of shape placed, of the depth.
  FractionRange ends(std::size_t attribute) const;
  const FractionRange& depth_ends() const { return depth_ends_; }
  /// Whether the rules define the attribute at its location p: not at a centre with 1/w <= 0 there.
  bool is_defined_at(std::size_t attribute, const Point& p) const;
  /// The point an attribute of a fragment is evaluated at; for a centroid that is a range of
  /// points: the sample.
  Point location(std::size_t attribute, int x, int y, int sample) const;
  /// Where D3D lets a centroid be: at the centre where all samples are covered, else at the first
  /// that is. Several of these where coverage is open.
  struct CentroidSamples {
    std::vector<int> firsts;
    bool has_center = false;
  };
  CentroidSamples centroid_samples(int x, int y) const;
  /// The map that the contract's basis evaluates; nothing where it leaves several.
  const ProjectiveMap* single_map() const;

  /// A region on which a map has 1/w > 0, and some or all values that a quantity has there.
  struct Region {
    const ProjectiveMap* map = nullptr;
    ConvexRegion points;

    /// Whether 1/w <= 0 at a corner.
    bool has_pole() const;
    /// Whether the quantity is `computed` somewhere in it.
    bool attains(const Reading& reading, const Ring& computed) const;
  };
  /// Where rules that name no place for centroids (OpenGL, Vulkan) let an attribute be evaluated:
  /// in a pixel. A triangle that is snapped may be evaluated elsewhere, too. The map has an
  /// orientation.
  const Region& centroid_region(int x, int y) const;
  /// Shape cut: where the exact triangle has the values that the moved one may have at p.
  const Region& cut_region(const Point& p) const;

 private:
  std::optional<FractionRange> value_at(const Quantity& quantity, const FractionRange& ends,
                                        const Point& p, Place place) const;
  std::optional<FractionRange> placed_value(const Quantity& quantity, const FractionRange& ends,
                                            const Point& p, Place place) const;
  std::optional<FractionRange> cut_value(const Quantity& quantity, const Point& p,
                                         Place place) const;
  /// Where the exact triangle may be evaluated for a sample p of an open viewport.
  Region shown_region(const Point& p) const;
  std::optional<OpenValue> centroid_sample(const Quantity& quantity, const FractionRange& ends,
                                           int x, int y) const;
  std::optional<FractionRange> centroid_range(const Quantity& quantity, int x, int y) const;

  const TriangleSetup* triangle_;
  Quantity depth_;
  FractionRange depth_ends_;

  /// The regions that were asked for last: several samples and attributes ask for the same.
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
